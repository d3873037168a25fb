#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "picture/image.h"
#include "program.h"
#include "quasimc/version.h"

namespace quasimc::test {
namespace {

using Arguments = std::vector<std::string>;

TEST_F(ProgramTest, AuditsOnDemand) {
    const Outcome outcome = run({"run", "run.toml", "--audit", "0.5"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("audit     agrees"), std::string::npos) << outcome.out;
    EXPECT_EQ(outcome.err.find("audit"), std::string::npos) << outcome.err;
    const Outcome refused = run({"run", "run.toml", "--audit", "0.5", "--replicates", "1"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("audit: at least 2 replicates are needed"), std::string::npos);
}

TEST_F(ProgramTest, NamesTheMethodThatItChose) {
    const Outcome outcome = run({"run", "run.toml", "--method", "auto"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("method    first_hits (automatic): "), std::string::npos)
        << outcome.out;
}

TEST_F(ProgramTest, RunWritesTableResultAndSummary) {
    const Outcome outcome = run({"run", "run.toml"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("3 organs"), std::string::npos) << outcome.out;
    EXPECT_NE(folder_.read("out.csv").find("\n1,third,"), std::string::npos);
    EXPECT_NE(folder_.read("out.json").find("\"organs_sha256\""), std::string::npos);
}

TEST_F(ProgramTest, RunGivesTheSameTableAgain) {
    ASSERT_EQ(run({"run", "run.toml", "--csv", "a.csv", "--threads", "1"}).status, 0);
    ASSERT_EQ(run({"run", "run.toml", "--csv", "b.csv", "--threads", "2"}).status, 0);
    EXPECT_EQ(replaced(folder_.read("a.csv"), "threads = 1", "threads = 2"), folder_.read("b.csv"));
}

TEST_F(ProgramTest, TablesMayGoToStandardOutput) {
    const Outcome outcome = run({"run", "run.toml", "--csv", "-"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(outcome.out.starts_with("# QuasiMC"));
    EXPECT_EQ(outcome.out.find("energy    "), std::string::npos);
    EXPECT_NE(outcome.err.find("energy    "), std::string::npos);
}

TEST_F(ProgramTest, TheRunFileMayComeFromStandardInput) {
    const Outcome outcome = run({"run", "-"}, good_run_file());
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(new_files(), (Arguments{"out.csv", "out.json"}));
}

TEST_F(ProgramTest, FlagsGoBeforeTheFile) {
    ASSERT_EQ(
        run({"run", "run.toml", "--paths", "512", "--seed=9", "--sampler", "korobov"}).status, 0);
    const std::string table = folder_.read("out.csv");
    EXPECT_NE(table.find("sampler = \"korobov\""), std::string::npos);
    EXPECT_NE(table.find("paths = 512"), std::string::npos);
    EXPECT_NE(table.find("seed = 9"), std::string::npos);
}

TEST_F(ProgramTest, BadValuesOfFlagsAreWrongUsageAndNameTheFlag) {
    EXPECT_EQ(run({"run", "run.toml", "--paths", "many"}).status, 2);
    EXPECT_NE(
        run({"run", "run.toml", "--paths", "0"}).err.find("--paths: 0 is out of range"),
        std::string::npos);
    EXPECT_NE(run({"run", "run.toml", "--seed", "-1"}).err.find("--seed: "), std::string::npos);
    EXPECT_NE(run({"run", "run.toml", "--sampler", ""}).err.find("--sampler: "), std::string::npos);
    EXPECT_NE(
        run({"run", "run.toml", "--max-seconds", "nan"}).err.find("--max-seconds: "),
        std::string::npos);
    EXPECT_TRUE(new_files().empty());
}

TEST_F(ProgramTest, WrongUsageIsStatusTwo) {
    const std::vector<Arguments> table{
        {},
        {"run"},
        {"fly"},
        {"run", "run.toml", "--wings"},
        {"run", "run.toml", "--paths"},
        {"run", "run.toml", "run.toml"},
        {"run", "run.toml", "--repeat", "out.json"},
        {"check"},
        {"list", "apples"},
        {"--dump"},
        {"convert", "run.toml"}};
    for (const Arguments& arguments : table) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2) << ::testing::PrintToString(arguments) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err, "");
    }
}

TEST_F(ProgramTest, MistakenFlagsAreNamedWithTheNearest) {
    const std::vector<std::pair<Arguments, std::string>> table{
        {{"run", "run.toml", "--method"}, "--method: a value is missing\n"},
        {{"run", "run.toml", "--paths"}, "--paths: a value is missing\n"},
        {{"run", "run.toml", "--paths", "--quiet"}, "--paths: a value is missing\n"},
        {{"run", "run.toml", "--path", "3"}, "unknown option --path; did you mean '--paths'?\n"},
        {{"run", "run.toml", "--seed", "3", "--seed", "4"},
         "--seed: it is given 2 times (it takes one value); give it once\n"},
        {{"run", "run.toml", "--repeat", "out.json"},
         "FILE: it is given with --repeat (each excludes the other); remove one of them\n"},
        {{"run", "run.toml", "--sampeler=sobol"},
         "unknown option --sampeler; did you mean '--sampler'?\n"},
        {{"run", "run.toml", "--wings"}, "unknown option --wings\n"},
        {{"run", "run.toml", "more.toml"}, "unexpected argument 'more.toml'\n"}};
    for (const auto& [arguments, message] : table) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(
            outcome.err, "error: " + message + "Run 'quasimc run --help' for more information.\n");
    }
}

TEST_F(ProgramTest, AllMistakesOfFlagsAreReportedAtOnce) {
    const Outcome outcome = run(
        {"show", "run.toml", "-o", "a.png", "-o", "b.png", "--sweep-point", "0", "--minus",
         "out.json", "--error"});
    EXPECT_EQ(outcome.status, 2);
    for (const char* part :
         {"2 times (it takes one value); give it once", "error: --sweep-point: 0 is out of range",
          "error: --minus: it is given with --error"}) {
        EXPECT_NE(outcome.err.find(part), std::string::npos) << part << outcome.err;
    }
}

TEST_F(ProgramTest, WholeNumbersMayBeWrittenAsReals) {
    EXPECT_EQ(run({"run", "run.toml", "--paths", "1e3"}).status, 0);
    EXPECT_NE(folder_.read("out.csv").find("paths = 1000"), std::string::npos);
}

TEST_F(ProgramTest, WarnsOfIrradiancesBeyondAnyLight) {
    folder_.write(
        "bright.toml",
        replaced(good_run_file(), "irradiance_facing = 1", "irradiance_facing = 2e6"));
    const Outcome outcome = run({"run", "bright.toml"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(
        outcome.err.find("warning: bright.toml:12: source 'directional': irradiance_facing of band "
                         "PAR is 2000000 W m-2, but the sun gives 1361 W m-2"),
        std::string::npos)
        << outcome.err;
}

TEST_F(ProgramTest, HelpAndVersionGoToStandardOutput) {
    EXPECT_EQ(run({"--version"}).out, "quasimc " + std::string(version()) + "\n");
    for (const Arguments& arguments :
         {Arguments{"--help"}, Arguments{"run", "--help"}, Arguments{"check", "-h"}}) {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_NE(outcome.out.find("Usage: "), std::string::npos);
        EXPECT_EQ(outcome.err, "");
    }
    EXPECT_NE(run({"run", "--help"}).out.find("--target-error"), std::string::npos);
}

TEST_F(ProgramTest, CheckFindsFaultsAndRunsNothing) {
    EXPECT_EQ(run({"check", "run.toml"}).status, 0);
    EXPECT_EQ(run({"check", "run.toml", "--paths", "0"}).status, 2);
    folder_.write(
        "run.toml", replaced(good_run_file(), "file = \"leaves.tri\"", "file = \"leaves.tro\""));
    EXPECT_EQ(run({"check", "run.toml"}).status, 1);
    EXPECT_TRUE(new_files().empty());
}

TEST_F(ProgramTest, CheckPrintsWarnings) {
    folder_.write("leaves.tri", good_leaves() + good_leaves());
    const Outcome outcome = run({"check", "run.toml"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.err.find("warning: "), std::string::npos) << outcome.err;
}

TEST_F(ProgramTest, TheDumpedDefaultFileRuns) {
    const Outcome dumped = run({"--dump-default"});
    EXPECT_EQ(dumped.status, 0);
    folder_.write("default.toml", dumped.out);
    const Outcome outcome =
        run({"run", "default.toml", "--paths", "256", "--csv", "a.csv", "--json", "a.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
}

TEST_F(ProgramTest, FromRepeatsARun) {
    ASSERT_EQ(run({"run", "run.toml", "--seed", "5"}).status, 0);
    const Outcome again =
        run({"run", "--repeat", "out.json", "--csv", "again.csv", "--json", "again.json"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_NE(again.out.find("the same numbers as in out.json"), std::string::npos) << again.out;
    const auto organs = [](const std::string& text) {
        return text.substr(text.find("\"organs\": ["));
    };
    EXPECT_EQ(organs(folder_.read("out.json")), organs(folder_.read("again.json")));
    EXPECT_EQ(folder_.read("out.csv"), folder_.read("again.csv"));
    // The result of a repetition can be repeated too.
    EXPECT_NE(
        run({"run", "--repeat", "again.json"}).out.find("the same numbers"), std::string::npos);
}

TEST_F(ProgramTest, FromTellsOtherNumbers) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    const Outcome asked = run({"run", "--repeat", "out.json", "--seed", "99"});
    EXPECT_EQ(asked.status, 0) << asked.err;
    EXPECT_NE(
        asked.out.find("OTHER numbers than in out.json, as asked by --seed 99"), std::string::npos)
        << asked.out;
    // Those of a file that was changed: the same program computes what it did.
    const std::string stored = folder_.read("out.json");
    const std::size_t digit = stored.find("\"mean\":", stored.find("\n{\"id\":")) + 9;
    std::string changed = stored;
    changed[digit] = changed[digit] == '7' ? '8' : '7';
    folder_.write("changed.json", changed);
    const Outcome other = run({"run", "--repeat", "changed.json", "-q"});
    EXPECT_EQ(other.status, 1);
    EXPECT_NE(other.err.find("(1 of 4 rows of numbers differ)"), std::string::npos) << other.err;
    folder_.write("old.json", replaced(stored, "\"organs_sha256\": \"", "\"organs_sha256\": \"x"));
    EXPECT_EQ(run({"run", "--repeat", "old.json"}).status, 1);
}

/// Other versions, and runs ended by time, may give other digits.
TEST_F(ProgramTest, FromForgivesOtherNumbersOfOtherRuns) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    const std::string stored =
        replaced(folder_.read("out.json"), "\"organs_sha256\": \"", "\"organs_sha256\": \"x");
    folder_.write(
        "old.json", replaced(stored, "\"program_version\": \"", "\"program_version\": \"9"));
    const Outcome old = run({"run", "--repeat", "old.json"});
    EXPECT_EQ(old.status, 0) << old.err;
    EXPECT_NE(old.out.find("OTHER numbers than in old.json, which version 9"), std::string::npos)
        << old.out;
    folder_.write("cut.json", replaced(stored, "\"finished\"", "\"interrupted\""));
    const Outcome cut = run({"run", "--repeat", "cut.json"});
    EXPECT_EQ(cut.status, 0) << cut.err;
    EXPECT_NE(cut.out.find("whose run was stopped before its end"), std::string::npos) << cut.out;
}

TEST_F(ProgramTest, TellsAFileOfGeometryFromARunFile) {
    folder_.write("plant.opf", "<?xml version=\"1.0\"?>\n<opf>\n0.1 .2 .3 = \n</opf>\n");
    for (const char* name : {"leaves.tri", "plant.opf"}) {
        const Outcome outcome = run({"run", name});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(outcome.err.starts_with(
            "error: " + std::string(name) + ": is geometry, not a run file;"))
            << outcome.err;
        EXPECT_NE(outcome.err.find("name it in a run file, under [[geometry]]"), std::string::npos);
    }
    folder_.write("out.json", "{}\n");
    EXPECT_EQ(
        run({"check", "out.json"}).err,
        "error: out.json: is a result, not a run file; show it: quasimc view out.json; or repeat "
        "its run: quasimc run --repeat out.json\n");
    folder_.write("weather.epw", "LOCATION,here\n");
    const Outcome outcome = run({"run", "weather.epw"});
    EXPECT_TRUE(outcome.err.starts_with("error: weather.epw: is not a run file (weather.epw:1"))
        << outcome.err;
    EXPECT_NE(outcome.err.find("give a run file in TOML"), std::string::npos);
}

TEST_F(ProgramTest, FromRefusesAChangedInput) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    folder_.write("leaves.tri", good_leaves() + "\n");
    const Outcome outcome = run({"run", "--repeat", "out.json"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("'leaves.tri'"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("its SHA-256 differs"), std::string::npos) << outcome.err;
}

TEST_F(ProgramTest, FromRefusesBrokenResults) {
    ASSERT_EQ(run({"run", "run.toml"}).status, 0);
    const std::string json = folder_.read("out.json");
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{1}, json.size() / 3, json.size() - 3}) {
        folder_.write("out.json", json.substr(0, size));
        EXPECT_EQ(run({"run", "--repeat", "out.json"}).status, 1);
    }
    EXPECT_EQ(run({"run", "--repeat", "leaves.tri"}).status, 1);
    EXPECT_EQ(run({"run", "--repeat", "none.json"}).status, 1);
}

TEST_F(ProgramTest, AMissedTargetIsStatusFourAndResultsAreWritten) {
    const Outcome outcome =
        run({"run", "run.toml", "--target-error", "1e-9", "--max-paths", "512"});
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    EXPECT_NE(outcome.out.find("not reached"), std::string::npos);
    EXPECT_EQ(new_files(), (Arguments{"out.csv", "out.json"}));
}

TEST_F(ProgramTest, AReachedTargetIsStatusZero) {
    const Outcome outcome = run({"run", "run.toml", "--target-error", "0.5"});
    EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
}

/// The paths of the result are those of the last line of rounds, not the paths of the run file.
TEST_F(ProgramTest, ALargeTargetNeedsFewerPathsThanASmallOne) {
    std::uint64_t before = 0;
    for (const char* target : {"0.5", "0.05", "0.005"}) {
        const Outcome outcome =
            run({"run", "run.toml", "--paths", "65536", "--target-error", target});
        EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
        const auto json = nlohmann::json::parse(folder_.read("out.json"));
        const auto paths = json["completed"]["paths"].get<std::uint64_t>();
        EXPECT_EQ(json["rounds"].back()["paths"], paths);
        EXPECT_EQ(json["rounds"].front()["paths"], 256);
        EXPECT_GE(paths, before) << target;
        EXPECT_TRUE(before > 0 || paths < 65536) << paths;
        before = paths;
    }
}

TEST_F(ProgramTest, ATargetIsForTheLightThatIsNamed) {
    const auto outcome = [&](const Arguments& options) {
        Arguments all{"run", "run.toml", "--target-error", "0.5"};
        all.insert(all.end(), options.begin(), options.end());
        return run(all);
    };
    EXPECT_NE(
        outcome({"--target", "total"}).out.find("reached: the total is within 50 %\n"),
        std::string::npos);
    EXPECT_NE(
        outcome({"--target", "groups", "--layers", "2", "--target-quantity", "incident_upper"})
            .out.find("% of the groups are within 50 % in incident_upper"),
        std::string::npos);
    const Outcome refused = outcome({"--target", "sensors", "--target-bands", "infrared"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("target: \"sensors\", but there are none"), std::string::npos);
    EXPECT_NE(refused.err.find("'infrared' is not a band"), std::string::npos);
}

TEST_F(ProgramTest, ATerminatedRunLeavesNothing) {
    folder_.write("out.csv", "old");
    const std::string command = "cd '" + folder_.path().string() +
                                "' && timeout -s TERM 0.3 '" QUASIMC_PROGRAM
                                "' run run.toml --paths 67108864 --replicates 1000 >/dev/null 2>&1";
    EXPECT_NE(std::system(command.c_str()), 0);  // NOLINT(concurrency-mt-unsafe)
    EXPECT_EQ(folder_.read("out.csv"), "old");
    EXPECT_EQ(new_files(), (Arguments{"out.csv"}));
}

TEST_F(ProgramTest, AFullDiskIsAnInputError) {
    EXPECT_EQ(run({"run", "run.toml", "--csv", "/dev/full"}).status, 1);
}

TEST_F(ProgramTest, GapsAreMeasuredWithAndWithoutLight) {
    const std::string gaps = "\n[[gap_fraction]]\nname = 'eye'\nat = [[0, 0, 0]]\nrays = 256\n";
    folder_.write("gaps.toml", folder_.read("run.toml") + gaps);
    const Outcome outcome = run({"gaps", "gaps.toml", "--csv", "gaps.csv"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("eye: 1 position"), std::string::npos) << outcome.out;
    EXPECT_NE(outcome.out.find("index of an LAI-2000"), std::string::npos) << outcome.out;
    ASSERT_EQ(run({"run", "gaps.toml", "--gaps-csv", "beside.csv"}).status, 0);
    const auto rows = [this](const std::string& file) {
        const std::string text = folder_.read(file);
        return text.substr(text.find("\nname,position"));
    };
    EXPECT_EQ(rows("gaps.csv"), rows("beside.csv"));
    EXPECT_NE(rows("gaps.csv").find("eye,all,,,,0,13,0,360,gap_fraction,"), std::string::npos);
    const Outcome without = run({"gaps", "run.toml"});
    EXPECT_EQ(without.status, 1);
    EXPECT_NE(without.err.find("it has no [[gap_fraction]]"), std::string::npos) << without.err;
    EXPECT_EQ(run({"run", "run.toml", "--gaps-csv", "none.csv"}).status, 2);
}

TEST_F(ProgramTest, AFisheyeIsACameraAtAPoint) {
    const Outcome wrong = run({"show", "run.toml", "--camera", "fisheye:1,2", "-o", "eye.png"});
    EXPECT_EQ(wrong.status, 2);
    EXPECT_NE(wrong.err.find("'1,2' is not a point"), std::string::npos) << wrong.err;
    if (has_png()) {
        EXPECT_EQ(
            run({"show", "run.toml", "--camera", "fisheye:0,0,0", "-o", "eye.png"}).status, 0);
    }
}

TEST_F(ProgramTest, ListsNameWhatThereIs) {
    EXPECT_NE(run({"list", "samplers"}).out.find("sobol"), std::string::npos);
    EXPECT_NE(run({"list", "models"}).out.find("phong"), std::string::npos);
    EXPECT_NE(run({"list", "optics"}).out.find("grass_leaf"), std::string::npos);
    EXPECT_NE(run({"list", "detectors"}).out.find("rings 1 ... 180"), std::string::npos);
    EXPECT_NE(run({"list", "formats"}).out.find("ply"), std::string::npos);
    EXPECT_NE(run({"list", "options"}).out.find("target_error"), std::string::npos);
    EXPECT_NE(run({"list", "quantities"}).out.find("absorbed_flux"), std::string::npos);
}

TEST_F(ProgramTest, ConvertWritesAScenesTrianglesToBeReadAgain) {
    ASSERT_EQ(run({"convert", "run.toml", "all.tri"}).status, 0);
    folder_.write("run.toml", replaced(good_run_file(), "leaves.tri", "all.tri"));
    const Outcome outcome = run({"check", "run.toml"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("4 organs"), std::string::npos) << outcome.out;
    EXPECT_EQ(run({"convert", "run.toml", "all.xyz"}).status, 1);
    ASSERT_EQ(run({"convert", "-", "piped.tri"}, good_run_file()).status, 0);
    EXPECT_EQ(folder_.read("piped.tri"), folder_.read("all.tri"));
}

TEST_F(ProgramTest, TheFirstExampleRuns) {
    folder_.write("leaves.toml", "");
    const std::filesystem::path example =
        std::filesystem::path(QUASIMC_SOURCE_DIR) / "examples/01-leaves";
    for (const char* name : {"leaves.toml", "leaves.tri"}) {
        std::filesystem::copy_file(
            example / name, folder_.path() / name,
            std::filesystem::copy_options::overwrite_existing);
    }
    const Outcome outcome = run({"run", "leaves.toml", "--paths", "4096"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("500 organs"), std::string::npos);
    EXPECT_NE(folder_.read("leaves.csv").find("\n500,leaf 500,leaf,"), std::string::npos);
}

TEST_F(ProgramTest, SkyTellsTheSunAndDrawsTheSky) {
    const Outcome outcome = run(
        {"sky", "--site", "39.742476,-105.1786", "--time", "2003-10-17T12:30:30-07:00",
         "--elevation-m", "1830.14", "--pressure-hpa", "820", "--temperature-c", "11",
         "--delta-t-s", "67"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(
        outcome.out.find("azimuth 194.3402 deg (from north over east), elevation 39.8884 deg"),
        std::string::npos)
        << outcome.out;
    EXPECT_NE(outcome.out.find("sunrise 2003-10-17T06:12:43-07:00"), std::string::npos);
    EXPECT_NE(outcome.out.find("cie_clear"), std::string::npos);
    EXPECT_NE(outcome.out.find("clear sky on the horizontal "), std::string::npos);
    EXPECT_NE(outcome.out.find("PPFD "), std::string::npos);
}

TEST_F(ProgramTest, SkyDrawsItOrSaysThatItWasBuiltWithoutPictures) {
    const Outcome outcome = run(
        {"sky", "--site", "50,8", "--time", "2024-06-21T12:00Z", "--png", "sky.png", "--size",
         "128"});
    if (has_png()) {
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_TRUE(folder_.read("sky.png").starts_with("\x89PNG"));
    } else {
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("it was built without libpng"), std::string::npos);
        EXPECT_TRUE(new_files().empty());
    }
}

TEST_F(ProgramTest, SkyTellsOfPolarNightsAndDrawsNone) {
    const Arguments night{"sky", "--site", "80,20", "--time", "2024-12-21T12:00Z"};
    const Outcome outcome = run(night);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("polar night"), std::string::npos);
    EXPECT_NE(outcome.out.find("no light: the sun is below the horizon"), std::string::npos);
    Arguments drawn = night;
    drawn.insert(drawn.end(), {"--png", "sky.png"});
    EXPECT_EQ(run(drawn).status, 2);
    EXPECT_TRUE(new_files().empty());
}

TEST_F(ProgramTest, SkyAsksForTheLightThatASkyNeeds) {
    const Outcome outcome =
        run({"sky", "--site", "50,8", "--time", "2024-06-21T12:00Z", "--sky", "perez"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--sky: perez needs the light of the hour"), std::string::npos);
}

TEST_F(ProgramTest, SkyTellsAllThatIsWrong) {
    const Outcome outcome = run({"sky", "--site", "95", "--time", "2024-06-21T12:00"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--site: '95' is not a site"), std::string::npos);
    EXPECT_NE(outcome.err.find("--time: '2024-06-21T12:00' has no time zone"), std::string::npos);
    EXPECT_EQ(outcome.err.find("utc_offset_hours"), std::string::npos) << "it has no such option";
    EXPECT_EQ(run({"sky", "--site", "50,8"}).status, 2);
    EXPECT_EQ(
        run({"sky", "--site", "50,8", "--time", "2024-06-21T12:00Z", "--sky", "pink"}).status, 2);
}

}  // namespace
}  // namespace quasimc::test
