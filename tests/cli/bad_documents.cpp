#include "bad_inputs.h"

namespace quasimc::test {
namespace {

const std::string kPaths = "paths = 256";

/// x.x.x ... = 1
std::string deep_key(int parts) {
    std::string text = "x";
    for (int i = 0; i < parts; ++i) {
        text += ".x";
    }
    return text + " = 1";
}

std::string many_bands() {
    constexpr int kMany = 100000;
    std::string text = "bands = [\"a\"";
    for (int i = 1; i < kMany; ++i) {
        text += ", \"b" + std::to_string(i) + "\"";
    }
    return text + "]";
}

const std::vector<BadInput> kBadDocuments{
    {"Empty", "", "", "run.toml"},
    {"OnlyBlanks", "", "  \n\n", "run.toml"},
    {"NotToml", "", "this is not a run file\n", "run.toml:1: "},
    {"Binary", "", std::string("\x7F\x45LF\x02\x01\x00\x00\x00", 9), "run.toml:1: "},
    {"NotUtf8", "", "title = \"\xFF\xFE\"\n", "run.toml:1: "},
    {"Utf16", "",
     std::string(
         "\xFF\xFE"
         "b\0a\0n\0d\0s\0",
         12),
     "run.toml:1: is text in UTF-16 (text must be UTF-8); save it as UTF-8"},
    {"Utf16WithoutMark", "", std::string("b\0a\0n\0d\0s\0", 10), "run.toml:1: is text in UTF-16"},
    {"Json", "", "{\"bands\": [\"PAR\"]}", "run.toml:1: "},
    {"TruncatedText", "name = \"third\"", "name = \"third", "run.toml:21: "},
    {"TruncatedList", "corners = [[0, 0, 5], [1, 0, 5], [0, 1, 5]]", "corners = [[0, 0, 5",
     "run.toml:"},
    {"DuplicateKey", kPaths, "paths = 256\npaths = 512", "run.toml:5: "},
    {"DuplicateTable", "[output]", "[run]\n[output]", "run.toml:6: "},
    {"DeepNesting", "format = 1", "x = " + std::string(5000, '[') + std::string(5000, ']'),
     "run.toml:1: "},
    {"DeepTables", "format = 1", deep_key(300), "run.toml:1: a key has too many parts"},
    {"VeryDeepTables", "format = 1", deep_key(50000), "run.toml:1: a key has too many parts"},
    {"VeryDeepHeader", "[run]", "[" + deep_key(50000).substr(0, 100001) + "]",
     "run.toml:3: a key has too many parts"},
    {"VeryManyBands", "bands = [\"PAR\"]", many_bands(),
     "run.toml:2: 100000 bands (a run has 10000"},
    {"Date", "format = 1", "title = 2020-01-01", "run.toml:1: title is a date"},
    {"UnknownKey", "format = 1", "fromat = 1",
     "run.toml:1: unknown key 'fromat'; did you mean 'format'?"},
    {"UnknownSection", "[run]", "[runs]", "unknown key 'runs'; did you mean 'run'?"},
    {"NewerFormat", "format = 1", "format = 2", "run.toml:1: format is 2"},
    {"FormatOfAnotherType", "format = 1", "format = \"one\"", "run.toml:1: format is a text"},
    {"NoBand", "bands = [\"PAR\"]", "bands = []", "no band is given"},
    {"BandOfAnotherType", "bands = [\"PAR\"]", "bands = [1]", "run.toml:2: bands is an integer"},
    {"TwoBandsOfOneName", "bands = [\"PAR\"]", "bands = [\"PAR\", \"PAR\"]", "PAR"},
    {"BandWithAColon", "bands = [\"PAR\"]", "bands = [\"P:R\"]", "a name must not contain ':'"},
    {"UnknownUp", "format = 1", "up = \"x\"", "run.toml:1: up: 'x' is not one of "},
    {"NorthUpwards", "format = 1", "north = [0, 0, 1]",
     "run.toml:1: north is not a horizontal direction"},
    {"NorthOfTwoNumbers", "format = 1", "north = [0, 1]", "run.toml:1: north is a list of 2"},
    {"RunNoTable", "[run]\npaths = 256\nreplicates = 3\n", "run = 3\n",
     "run.toml:3: [run]: is an integer"},
    {"PathsZero", kPaths, "paths = 0", "run.toml:4: [run]: paths: 0 is out of range (1 to 2^30)"},
    {"PathsNegative", kPaths, "paths = -1", "run.toml:4: [run]: paths: -1 is out of range"},
    {"PathsHuge", kPaths, "paths = 9223372036854775807",
     "run.toml:4: [run]: paths: 9223372036854775807 is out of range"},
    {"PathsBeyondInteger", kPaths, "paths = 99999999999999999999", "run.toml:4: "},
    {"PathsReal", kPaths, "paths = 256.5", "run.toml:4: [run]: paths: 256.5 is not a whole number"},
    {"PathsRealHuge", kPaths, "paths = 1e300",
     "run.toml:4: [run]: paths: 1e+300 is not a whole number"},
    {"PathsText", kPaths, "paths = \"many\"",
     "run.toml:4: [run]: paths: 'many' is not a whole number"},
    {"PathsTable", kPaths, "paths = { a = 1 }", "run.toml:4: [run]: paths: it is a table"},
    {"PathsNoPowerOfTwo", kPaths, "paths = 1000\nsampler = \"korobov\"",
     "run.toml:4: paths: 1000 is not a power of two"},
    {"UnknownSampler", kPaths, "sampler = \"sobel\"",
     "run.toml:4: [run]: sampler: 'sobel' is not one of "},
    {"GroupsOfAnUnknownLabel", kPaths, "paths = 256\ngroups = [\"plant\"]",
     "run.toml:5: groups: no organ has a label 'plant' (no organ has any label); give organs "
     "labels"},
    {"LayerHeightsThatDoNotAscend", kPaths, "paths = 256\nlayer_heights = [0, 2, 2]",
     "run.toml:5: layer_heights: 2 follows 2 (heights must be finite and ascending); give them"},
    {"LayersTwice", kPaths, "paths = 256\nlayers = 2\nlayer_heights = [0, 2]",
     "run.toml:5: layers: both layers and layer_heights are given"},
    {"QuantityThatIsNone", "csv = \"out.csv\"", "quantities = [\"absorbed\"]",
     "run.toml:7: [output]: 'absorbed' is not a quantity"},
    {"HoursWithoutTimes", "csv = \"out.csv\"", "time_of_day = [6, 20]",
     "run.toml:7: [output]: time_of_day without [time] (without [time] there are no time steps)"},
    {"UnknownOption", kPaths, "path = 256",
     "run.toml:4: [run]: unknown key 'path'; did you mean 'paths'?"},
    {"TargetNan", kPaths, "target_error = nan",
     "run.toml:4: [run]: target_error: nan is out of range (0 to 1)"},
    {"TargetWithOneReplicate", "replicates = 3", "replicates = 1\ntarget_error = 0.1",
     "at least 2 replicates are needed"},
    {"MaxSecondsInfinite", kPaths, "max_seconds = inf",
     "run.toml:4: [run]: max_seconds: inf is out of range"},
    {"RatioOfUnknownBand", kPaths, "ratios = [\"R:FR\"]",
     "run.toml:4: ratios: 'R' is not a band (bands: PAR)"},
    {"RatioOfOneBand", kPaths, "ratios = [\"PAR\"]", "run.toml:4: ratios: 'PAR' is not a ratio"},
    {"OriginOfNoSource", kPaths, "origins = [\"sun\", \"lamp*\"]",
     "run.toml:4: origins: no source is called 'lamp*' (names are "},
    {"OriginTwice", kPaths, "origins = [\"sky\", \"sky\"]",
     "run.toml:4: origins: 'sky' is given twice; give it once"},
    {"OutputNoText", "csv = \"out.csv\"", "csv = 3", "run.toml:7: [output]: csv is an integer"},
    {"OutputEmpty", "csv = \"out.csv\"", "csv = \"\"", "run.toml:7: [output]: csv is empty"},
    {"OutputIsTheRunFile", "csv = \"out.csv\"", "csv = \"run.toml\"",
     "run.toml:7: [output]: csv = 'run.toml' is an input of this run"},
    {"OutputIsAGeometryFile", "csv = \"out.csv\"", "csv = \"./leaves.tri\"",
     "run.toml:7: [output]: csv = './leaves.tri' is an input of this run"},
    {"OutputTwice", "csv = \"out.csv\"", "csv = \"out.json\"", "csv and json name the same file"},
    {"OutputFolderMissing", "csv = \"out.csv\"", "csv = \"none/out.csv\"",
     "run.toml:7: [output]: csv = 'none/out.csv' can't be written (No such file or directory)"},
    {"OutputIsAFolder", "csv = \"out.csv\"", "csv = \".\"", "can't be written"},
};

}  // namespace

std::vector<BadInput> bad_documents() {
    return kBadDocuments;
}

}  // namespace quasimc::test
