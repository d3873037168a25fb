#include "runfile/run_file.h"

#include <cmath>

#include <gtest/gtest.h>

#include "options/options.h"
#include "quasimc/error.h"
#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

TEST(RunFile, OfTheLeastThatIsNeededHasTheDefaults) {
    const RunFile run = read_text(RunText{}.text());
    EXPECT_EQ(run.title, "");
    EXPECT_EQ(run.scene.length_unit(), "m");
    ASSERT_EQ(run.scene.bands().size(), 1U);
    EXPECT_EQ(run.scene.bands()[0], (Band{"PAR", "W m-2"}));
    EXPECT_EQ(run.scene.orientation().up(), UpAxis::z);
    EXPECT_TRUE(run.output.files.empty());
    for (const Option& option : option_table()) {
        EXPECT_EQ(option.get(run.spec), option.get(RunSpec{})) << option.key;
    }
}

TEST(RunFile, TakesEveryKeyAtTheTop) {
    RunText text;
    text.top =
        "format = 1\ntitle = 'A'\nup = 'y'\nnorth = [1, 0, 1]\nlength_unit = 'cm'\n"
        "irradiance_unit = 'umol m-2 s-1'\nbands = ['PAR']\n";
    const RunFile run = read_text(text.text());
    EXPECT_EQ(run.title, "A");
    EXPECT_EQ(run.scene.orientation().up(), UpAxis::y);
    EXPECT_EQ(run.scene.orientation().north(), (Vec3{1, 0, 1}));
    EXPECT_EQ(run.scene.length_unit(), "cm");
    EXPECT_EQ(run.scene.bands()[0].unit, "umol m-2 s-1");
}

TEST(RunFile, TakesBandsWithUnitsOfTheirOwn) {
    RunText text;
    text.top = "irradiance_unit = 'A'\n[[band]]\nname = 'R'\nunit = 'B'\n[[band]]\nname = 'FR'\n";
    const RunFile run = read_text(text.text());
    EXPECT_EQ(run.scene.bands(), (std::vector<Band>{{"R", "B"}, {"FR", "A"}}));
}

TEST(RunFile, WritesUnitsInOneSpelling) {
    for (const auto& [given, unit] : std::vector<std::pair<std::string, std::string>>{
             {"umol/m2/s", "umol m-2 s-1"},
             {"µmol m⁻² s⁻¹", "umol m-2 s-1"},
             {"umol.m^-2.s^-1", "umol m-2 s-1"},
             {"s-1 m-2 umol", "umol m-2 s-1"},
             {"W/m2", "W m-2"},
             {"W·m**-2", "W m-2"},
             {"lux", "lx"},
             {"mol/m2/d", "mol m-2 d-1"},
             {"mW m-2", "mW m-2"},
             {"kg/(m2 d)", "kg/(m2 d)"},
             {"%", "%"},
             {"A", "A"}}) {
        RunText text;
        text.top = "irradiance_unit = '" + given + "'\nbands = ['PAR']\n";
        EXPECT_EQ(read_text(text.text()).scene.bands()[0].unit, unit) << given;
        text.top = "[[band]]\nname = 'PAR'\nunit = '" + given + "'\n";
        EXPECT_EQ(read_text(text.text()).scene.bands()[0].unit, unit) << given;
    }
}

TEST(RunFile, RefusesMisspelledUnits) {
    for (const auto& [given, meant] : std::vector<std::pair<std::string, std::string>>{
             {"umol/m2 s", "umol m-2 s-1"},
             {"umol m-2 s", "umol m-2 s-1"},
             {"UMOL M-2 S-1", "umol m-2 s-1"},
             {"Wm-2", "W m-2"},
             {"Lx", "lx"}}) {
        RunText text;
        text.top = "irradiance_unit = '" + given + "'\nbands = ['PAR']\n";
        EXPECT_TRUE(mentions(faults_of(text.text()), "did you mean '" + meant + "'?")) << given;
    }
    RunText text;
    text.top += "length_unit = 'CM'\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "there is no unit 'CM'; did you mean 'cm'?"));
}

TEST(RunFile, WarnsOfAUnitOfUnknownLength) {
    RunText text;
    text.top += "length_unit = 'foo'\n";
    const RunFile run = read_text(text.text());
    EXPECT_TRUE(mentions(warning_texts(run.warnings), "the length_unit 'foo' is only a name"));
    text.top = "bands = ['PAR']\nlength_unit = 'centimetres'\n";
    EXPECT_EQ(warning_texts(read_text(text.text()).warnings), Texts{});
}

TEST(RunFile, TakesEveryOption) {
    RunText text;
    text.run = default_run_section();
    const RunFile run = read_text(text.text());
    for (const Option& option : option_table()) {
        EXPECT_EQ(option.get(run.spec), option.get(RunSpec{})) << option.key;
    }
}

TEST(RunFile, OptionsFromOutsideGoBeforeIt) {
    RunText text;
    text.run = "[run]\npaths = 1024\nseed = 3\n";
    const RunFile run = read_text(text.text(), {}, {{"paths", "2048", "--paths"}});
    EXPECT_EQ(run.spec.paths, 2048U);
    EXPECT_EQ(run.spec.seed, 3U);
}

TEST(RunFile, FaultsOfOptionsFromOutsideNameTheirLocation) {
    EXPECT_EQ(
        faults_of(RunText{}.text(), {}, {{"paths", "many", "--paths"}}),
        (Texts{"--paths: 'many' is not a whole number (1 to 2^30)"}));
    EXPECT_TRUE(mentions(
        faults_of(RunText{}.text(), {}, {{"pahts", "1", "here"}}), "did you mean 'paths'?"));
}

TEST(RunFile, OutputPathsCountFromItsFolder) {
    RunText text;
    text.rest = "[output]\ncsv = 'out/a.csv'\njson = '/abs/b.json'\n";
    const RunFile run = read_text(text.text());
    EXPECT_EQ(run.output.files.at("csv"), "/run/out/a.csv");
    EXPECT_EQ(run.output.files.at("json"), "/abs/b.json");
}

TEST(RunFile, OutputMayBeStandardOutput) {
    RunText text;
    text.rest = "[output]\ncsv = '-'\n";
    EXPECT_EQ(read_text(text.text()).output.files.at("csv"), "-");
}

TEST(RunFile, AsksForGroupsAndLayers) {
    RunText text;
    text.run = "[run]\ngroups = ['plant']\nlayer_heights = [0, 1.5]\n";
    text.organs += "labels = { plant = 1 }\n";
    const RunFile run = read_text(text.text());
    EXPECT_EQ(run.spec.groups, std::vector<std::string>{"plant"});
    EXPECT_EQ(run.spec.layer_heights, (std::vector<double>{0, 1.5}));
    const RunFile other = read_text(
        text.text(), {}, {{"layer_heights", "1,2.5,3", "--layer-heights"}, {"groups", "", "--x"}});
    EXPECT_EQ(other.spec.layer_heights, (std::vector<double>{1, 2.5, 3}));
    EXPECT_TRUE(other.spec.groups.empty());
}

TEST(RunFile, SaysWhatIsWrongWithGroupsAndLayers) {
    RunText text;
    text.run = "[run]\ngroups = ['plnat']\nlayer_heights = [1, 0]\n";
    text.organs += "labels = { plant = 1 }\n";
    const auto faults = faults_of(text.text());
    EXPECT_TRUE(mentions(
        faults,
        "run.toml:3: groups: no organ has a label 'plnat' (groups are formed by the values of a "
        "label); did you mean 'plant'?"));
    EXPECT_TRUE(mentions(
        faults,
        "run.toml:4: layer_heights: 0 follows 1 (heights must be finite and ascending); give them "
        "in ascending order"));
    text.run = "[run]\nlayer_heights = ['a']\n";
    EXPECT_TRUE(
        mentions(faults_of(text.text()), "layer_heights: [\"a\"] is not a list of finite numbers"));
    text.run = "[run]\nlayer_heights = [0, inf]\n";
    EXPECT_TRUE(mentions(
        faults_of(text.text()),
        "run.toml:3: [run]: layer_heights: [0, inf] is not a list of finite numbers"));
}

TEST(RunFile, ChoosesWhatIsWritten) {
    RunText text;
    text.rest =
        "[output]\nquantities = ['absorbed_flux', 'sunlit_fraction']\nbands = ['PAR']\n"
        "groups_csv = 'g.csv'\n";
    const RunFile run = read_text(text.text());
    EXPECT_EQ(run.output.quantities.size(), 2U);
    EXPECT_EQ(run.output.bands, std::vector<std::string>{"PAR"});
    EXPECT_EQ(run.output.files.at("groups_csv"), "/run/g.csv");
    EXPECT_FALSE(run.output.include_night);
}

TEST(RunFile, SaysWhatIsWrongWithTheChoice) {
    RunText text;
    text.rest =
        "[output]\nquantities = ['absorbed']\nbands = ['PRA']\ngroups = ['plant']\n"
        "include_night = true\ntime_of_day = [8, 6]\n";
    const auto faults = faults_of(text.text());
    EXPECT_TRUE(mentions(faults, "'absorbed' is not a quantity"));
    EXPECT_TRUE(mentions(faults, "'PRA' is not a band; did you mean 'PAR'?"));
    EXPECT_TRUE(mentions(faults, "groups is an option of the run; put it below [run]"));
    EXPECT_TRUE(
        mentions(faults, "include_night without [time] (without [time] there are no time steps)"));
    EXPECT_TRUE(mentions(faults, "time_of_day is [8, 6]"));
    text.rest = "[output]\ncsv = 'a'\ngroups_csv = 'a'\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "csv and groups_csv name the same file"));
}

TEST(RunFile, RefusesUnknownKeysWithASuggestion) {
    RunText text;
    text.top += "lenght_unit = 'm'\n";
    text.run = "[run]\nreplicate = 4\n";
    const Texts faults = faults_of(text.text());
    EXPECT_EQ(
        faults, (Texts{
                    "run.toml:2: unknown key 'lenght_unit'; did you mean 'length_unit'?",
                    "run.toml:4: [run]: unknown key 'replicate'; did you mean 'replicates'?"}));
}

TEST(RunFile, TellsWhereAnOptionBelongs) {
    RunText text;
    text.top += "paths = 1024\n";
    EXPECT_EQ(
        faults_of(text.text()),
        (Texts{"run.toml:2: paths is an option of the run; put it below [run]"}));
}

TEST(RunFile, ReportsAllItsFaultsAtOnce) {
    RunText text;
    text.top = "bands = ['PAR']\nup = 'x'\n";
    text.run = "[run]\npaths = 0\nsampler = 'sobel'\n";
    text.sources =
        "[[source]]\ntype = 'directional'\ndirection = [0, 0, 0]\nirradiance_facing = -1\n";
    text.materials = "[[material]]\nname = 'leaf'\nreflectance = 0.6\ntransmittance = 0.6\n";
    text.organs += "[[organ]]\nmaterial = 'bark'\nshape = 'triangle'\ncorners = [[0, 0, 1]]\n";
    const Texts faults = faults_of(text.text());
    for (const char* part :
         {"run.toml:2: up: 'x' is not one of", "run.toml:4: [run]: paths: 0 is out of range",
          "run.toml:5: [run]: sampler: 'sobel' is not one of",
          "run.toml:8: source 'directional': direction is [0, 0, 0]",
          "run.toml:9: source 'directional': irradiance_facing is -1",
          "run.toml:10: ", "run.toml:21: organ: 1 corners", "'bark'"}) {
        EXPECT_TRUE(mentions(faults, part)) << part << "\n" << ::testing::PrintToString(faults);
    }
    EXPECT_EQ(faults.size(), 8U) << ::testing::PrintToString(faults);
}

TEST(RunFile, ThatIsNotTomlIsRefusedWithItsLine) {
    const Texts faults = faults_of("bands = ['PAR']\nup = \n");
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_TRUE(mentions(faults, "run.toml:2: ")) << faults[0];
}

TEST(RunFile, RefusesWhatTheRunRefusesWithTheLineOfTheOption) {
    RunText text;
    text.run = "[run]\nsampler = 'korobov'\npaths = 1000\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "run.toml:4: paths: 1000 is not a power of two"));
}

TEST(RunFile, RefusesANewerFormat) {
    RunText text;
    text.top = "format = 2\n" + text.top;
    EXPECT_TRUE(mentions(faults_of(text.text()), "run.toml:1: format is 2"));
}

TEST(RunFile, RefusesANorthThatIsNotHorizontal) {
    for (const char* north : {"[0, 0, 1]", "[0, 0, 0]", "[0, 1, 0.1]", "[1e300, 1e300, 0]"}) {
        RunText text;
        text.top += std::string("north = ") + north + "\n";
        EXPECT_TRUE(mentions(faults_of(text.text()), "north is not a horizontal direction"))
            << north;
    }
}

TEST(RunFile, IsKeptWithEveryOptionInIt) {
    RunText text;
    text.run = "[run]\npaths = 1024\n";
    const RunFile run = read_text(text.text(), {}, {{"seed", "7", "--seed"}});
    const Node* options = run.document->find("run");
    ASSERT_NE(options, nullptr);
    EXPECT_EQ(options->as<Node::Table>()->size(), option_table().size());
    EXPECT_EQ(*options->find("paths")->as<std::int64_t>(), 1024);
    EXPECT_EQ(*options->find("seed")->as<std::int64_t>(), 7);
}

TEST(RunFile, DefaultOneHasNoFaultAndEveryOption) {
    const RunFile run = read_text(default_run_file());
    EXPECT_TRUE(run.warnings.empty());
    for (const Option& option : option_table()) {
        EXPECT_NE(
            default_run_file().find("\n" + std::string(option.key) + " = "), std::string::npos);
        EXPECT_EQ(option.get(run.spec), option.get(RunSpec{})) << option.key;
    }
}

TEST(RunFile, OfTheManualHasNoFault) {
    const std::string page = repository_file("docs/reference/run-file.md");
    const std::string fence = "```toml run\n";
    const std::size_t begin = page.find(fence);
    ASSERT_NE(begin, std::string::npos);
    const std::string text =
        page.substr(begin + fence.size(), page.find("```", begin + 3) - begin - fence.size());
    const RunFile run = read_text(text);
    EXPECT_EQ(run.scene.organs().size(), 4U);
    EXPECT_TRUE(run.warnings.empty());
}

TEST(RunFile, CellRepeatsAlongTheGivenAxes) {
    RunText text;
    text.rest = "[cell]\ny = [-2, 3]\n";
    const Cell cell = read_text(text.text()).scene.cell();
    EXPECT_FALSE(cell.along_x);
    EXPECT_TRUE(cell.along_y);
    EXPECT_EQ(cell.low_y, -2);
    EXPECT_EQ(cell.size_y, 5);
}

TEST(RunFile, CellOfAYUpFileHasAxesXAndZ) {
    RunText text;
    text.top += "up = 'y'\n";
    text.rest = "[cell]\nx = [0, 2]\nz = [0, 3]\n";
    const Cell cell = read_text(text.text()).scene.cell();
    EXPECT_EQ(cell.size_x, 3);  // the world's x is the file's z
    EXPECT_EQ(cell.size_y, 2);
    text.rest = "[cell]\ny = [0, 2]\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "unknown key 'y'"));
}

TEST(RunFile, GroundIsTheLastOrgan) {
    RunText text;
    text.rest = "[ground]\nmaterial = 'leaf'\nheight = -1\nx = [0, 4]\ny = [1, 3]\n";
    const Scene scene = read_text(text.text()).scene;
    const Organ& ground = scene.organs().back();
    EXPECT_TRUE(ground.is_ground);
    EXPECT_DOUBLE_EQ(ground.area, 8);
    EXPECT_EQ(data_of(scene).triangles().back()[0].z, -1);
}

TEST(RunFile, GroundMayBeASurfaceFromAFile) {
    RunText text;
    text.rest = "[ground]\nmaterial = 'leaf'\nfile = 'soil.tri'\ntransform = { scale = 2 }\n";
    const Scene scene = read_text(text.text(), {{"soil.tri", "0 0 0 3 0 0 0 3 0\n"}}).scene;
    EXPECT_DOUBLE_EQ(scene.organs().back().area, 18);
}

TEST(RunFile, NamesTheFilesItWasMadeFrom) {
    RunText text;
    text.organs = "[[geometry]]\nfile = 'a.tri'\nmaterial = 'leaf'\n";
    const RunFile run = read_text(text.text(), {{"a.tri", "0 0 0 3 0 0 0 3 0\n"}});
    ASSERT_EQ(run.inputs.size(), 1U);
    EXPECT_EQ(run.inputs[0].path, "a.tri");
    EXPECT_EQ(run.inputs[0].absolute_path, "/run/a.tri");
    EXPECT_EQ(run.inputs[0].bytes, 18U);
    EXPECT_EQ(run.inputs[0].sha256.size(), 64U);
}

}  // namespace
}  // namespace quasimc::test
