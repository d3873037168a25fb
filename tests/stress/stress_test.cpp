#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "files/input_files.h"
#include "stress/campaign.h"
#include "stress/checks.h"
#include "stress/grammar.h"
#include "stress/near_surfaces.h"
#include "stress/shrink.h"
#include "support/temporary_folder.h"

// Tests of the stress program itself: its detection of errors, and a few scenes.

namespace quasimc::stress {
namespace {

std::string describe(const std::vector<Finding>& findings) {
    std::string words;
    for (const Finding& finding : findings) {
        words += name_of(finding.kind) + ": " + finding.words + "\n";
    }
    return words;
}

/// A black plate under a sun; `brightness` of the sun.
Node plate(double brightness) {
    Node document = empty_table();
    set(document, "bands", node_of(std::vector<std::string>{"b0"}));
    Node material = empty_table();
    set(material, "name", node_of(std::string("m0")));
    set(material, "reflectance", node_of(.5));
    add_table(document, "material", std::move(material));
    Node organ = empty_table();
    set(organ, "material", node_of(std::string("m0")));
    set(organ, "shape", node_of(std::string("triangle")));
    set(organ, "corners", node_of(std::vector<Vec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, .3}}));
    add_table(document, "organ", std::move(organ));
    Node sun = empty_table();
    set(sun, "type", node_of(std::string("directional")));
    set(sun, "azimuth_deg", node_of(0.0));
    set(sun, "elevation_deg", node_of(60.0));
    set(sun, "irradiance_facing", node_of(std::vector<double>{brightness}));
    add_table(document, "source", std::move(sun));
    return document;
}

/// Two leaves of 1 x 1 above each other by some height, and higher by `tilt` at one end.
Scene leaves_above_each_other(double height, double tilt) {
    SceneBuilder builder({{"b0"}});
    const std::vector<SideOptics> side(1);
    builder.add_material({"black", side, side});
    for (const double z : {0.0, height}) {
        OrganSpec leaf;
        const double raised = z > 0 ? z + tilt : z;
        leaf.parts.push_back({"black", Mesh({{Vec3{0, 0, z}, {1, 0, z}, {0, 1, raised}}})});
        builder.add_organ(std::move(leaf));
    }
    return std::move(builder).build();
}

TEST(NearSurfaces, AreThoseThatSinglePrecisionDoesNotTellApart) {
    EXPECT_TRUE(has_near_surfaces(leaves_above_each_other(2e-6, 0)));
    EXPECT_TRUE(has_near_surfaces(leaves_above_each_other(1e-7, 3e-6)));
    EXPECT_FALSE(has_near_surfaces(leaves_above_each_other(1e-5, 0)));
    EXPECT_FALSE(has_near_surfaces(leaves_above_each_other(1e-9, 0))) << "they are cut";
    EXPECT_FALSE(has_near_surfaces(leaves_above_each_other(1e-7, .1)));
}

TEST(StressGrammar, MakesTheSameSceneOfTheSameNumber) {
    EXPECT_EQ(to_toml(random_run(42)), to_toml(random_run(42)));
    EXPECT_NE(to_toml(random_run(42)), to_toml(random_run(43)));
}

TEST(StressGrammar, WritesWhatTheReaderReads) {
    for (std::uint64_t number = 1; number <= 50; ++number) {
        const std::string text = to_toml(random_run(number));
        EXPECT_EQ(to_toml(read_toml(text, "stress")), text) << number;
        EXPECT_NO_THROW(static_cast<void>(make_case(random_run(number)))) << number;
    }
}

TEST(StressGrammar, JudgesBundlesInMostScenesOfNarrowGaps) {
    constexpr unsigned kScenes = 60;
    unsigned with_bundles = 0;
    for (std::uint64_t i = 0; i < kScenes; ++i) {
        const Node document = random_run(kFirstOfGaps + i);
        const std::string text = to_toml(document);
        EXPECT_EQ(to_toml(read_toml(text, "stress")), text) << i;
        const Case it = make_case(document);
        EXPECT_GE(it.run.scene.organs().size(), 5U) << i;
        with_bundles += is_offered(it, Way::ray_bundles) ? 1 : 0;
    }
    EXPECT_GT(with_bundles, kScenes * 9 / 10);
}

TEST(StressComparison, TellsApartWhatDiffersAndWhatDoesNot) {
    const Number one{1, .01, .98, 1.02, true};
    const Number same{1.005, .01, .985, 1.025, true};
    const Number other{1.1, .01, 1.08, 1.12, true};
    EXPECT_GT(p_value_of(one, 15, same, 15), .5);
    EXPECT_LT(p_value_of(one, 15, other, 15), 1e-6);
    // Student's t of 7.071 with 30 degrees of freedom.
    EXPECT_NEAR(p_value_of(one, 15, other, 15), 7.2e-8, 2e-9);
    const double nan = std::nan("");
    const Number nothing{0, nan, 0, .3, true};
    EXPECT_NEAR(p_value_of(nothing, 15, one, 15), std::exp(-9.6), 1e-12);
    EXPECT_EQ(p_value_of(nothing, 15, Number{.1, .03, 0, .2, true}, 15), 1);
}

/// Negative control: the reference has a sun that is 3 % brighter.
TEST(StressJudge, FindsASunThatIsThreePercentBrighter) {
    Case it = make_case(plate(1));
    it.plain->emitters[0].amount[0] *= 1.03;
    const Answer light = compute(it, Way::light_tracing, {65536, 16, 1, 1});
    const Answer reference = compute(it, Way::reference, {65536, 16, 2, 1});
    const auto suspects = disagreements(it, {light, reference}, 1e-3);
    ASSERT_FALSE(suspects.empty());
    Rules sharp;
    sharp.last.paths = 65536;
    EXPECT_FALSE(compare_closely(it, suspects, 1, sharp, 1e-9).empty());
    const Verdict honest = judge(plate(1), 1, Rules{}, true);
    EXPECT_TRUE(honest.findings.empty()) << describe(honest.findings);
    EXPECT_GT(honest.comparisons, 15U);
}

TEST(StressChecks, SeeNumbersThatCannotBe) {
    const Case it = make_case(plate(1));
    const auto names = number_names(it.run.scene);
    Answer answer = compute(it, Way::light_tracing, Effort{});
    EXPECT_TRUE(impossible_numbers(answer, names).empty());
    answer.numbers[0].mean = -1e-9;
    EXPECT_EQ(impossible_numbers(answer, names).size(), 1U);
    answer.numbers[1].high = std::numeric_limits<double>::infinity();
    EXPECT_EQ(impossible_numbers(answer, names).size(), 2U);
}

TEST(StressShrinking, LeavesWhatMatters) {
    const Node whole = random_run(3);
    const auto has_a_sphere = [](const Node& document) {
        try {
            static_cast<void>(make_case(document));
        } catch (const InputError&) {
            return false;
        }
        return to_toml(document).find("sphere") != std::string::npos;
    };
    ASSERT_TRUE(has_a_sphere(whole));
    const Node small = shrunk(whole, has_a_sphere, 400);
    EXPECT_TRUE(has_a_sphere(small));
    EXPECT_EQ(tables_at(small, "organ").size(), 1U);
    EXPECT_LE(tables_at(small, "material").size(), 1U);
}

TEST(StressCampaign, FindsNothingInThirtyScenes) {
    const test::TemporaryFolder folder;
    Campaign campaign;
    campaign.first = 101;
    campaign.scenes = 30;
    campaign.out = folder.path();
    const Tally tally = run_campaign(campaign);
    EXPECT_EQ(tally.scenes, 30U);
    EXPECT_GT(tally.comparisons, 4000U);
    EXPECT_EQ(tally.findings + tally.deaths, 0U) << folder.read("log.txt");
}

/// Every finding that was fixed; it must never occur again.
class StressFindings : public ::testing::TestWithParam<std::filesystem::path> {};

TEST_P(StressFindings, StayMended) {
    const std::string path = GetParam().string();
    Rules rules;
    rules.screen = rules.second;  // one scene allows a more precise test
    const Verdict verdict = judge(read_toml(read_file(path), path), 1, rules, true);
    EXPECT_TRUE(verdict.findings.empty()) << describe(verdict.findings);
    EXPECT_FALSE(verdict.is_rounding);
}

std::vector<std::filesystem::path> stored_findings() {
    std::vector<std::filesystem::path> paths;
    const std::filesystem::path folder = QUASIMC_SOURCE_DIR "/tests/stress/findings";
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == ".toml") {
            paths.push_back(entry.path());
        }
    }
    std::sort(paths.begin(), paths.end());
    return paths;
}

INSTANTIATE_TEST_SUITE_P(
    Stored, StressFindings, ::testing::ValuesIn(stored_findings()), [](const auto& entry) {
        std::string name = entry.param.stem().string();
        std::replace(name.begin(), name.end(), '-', '_');
        return name;
    });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(StressFindings);

}  // namespace
}  // namespace quasimc::stress
