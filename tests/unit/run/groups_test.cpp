// The light of groups of organs.

#include "results/groups.h"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "quasimc/series.h"
#include "results/fraction_table.h"
#include "statistical/scenes.h"
#include "support/listening.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// Two plants of three leaves and a stem each, over a soil; a sensor, and a leaf of the border that
/// is not measured.
Scene make_two_plants() {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_material(diffuse("soil", .2, 0, 2));
    builder.add_material(sensor("sensor", 2));
    const auto leaves = random_leaves(6, .6, 1, 3);
    for (std::size_t i = 0; i < leaves.size(); ++i) {
        builder.add_organ(labelled(
            organ("", "leaf", {leaves[i]}),
            {{"plant", i < 3 ? "b" : "a"}, {"kind", "leaf"}, {"leaf+age", "1"}}));
    }
    for (const char* plant : {"a", "b"}) {
        const double x = *plant == 'a' ? .2 : .8;
        builder.add_organ(labelled(
            organ("", "leaf", make_parallelogram({x, .5, -.4}, {.05, 0, 0}, {0, .02, .8})),
            {{"plant", plant}, {"kind", "stem"}}));
    }
    builder.add_organ(
        labelled(organ("sensor", "sensor", floor_of(0, 1, 0, 1, .9)), {{"kind", "sensor"}}));
    OrganSpec border = labelled(
        organ("border", "leaf", floor_of(0, .2, 0, .2, .3)), {{"plant", "c"}, {"kind", "leaf"}});
    border.measured = false;
    builder.add_organ(std::move(border));
    GroundSpec soil = ground("soil");
    soil.height = -.4;
    builder.set_ground(soil);
    return std::move(builder).build();
}

Sources day_light() {
    return {sun(30, {1, 2}), sky({.5, .2})};
}

RunSpec grouped_spec(Method from, std::uint64_t paths = 1024) {
    RunSpec spec = spec_of(from, paths);
    spec.groups = {"plant", "kind", "plant+kind"};
    spec.layer_heights = {-.4, .3, .5, 1};
    spec.ratios = {"b0:b1"};
    return spec;
}

TEST(Groups, AreTheValuesOfLabelsInTheirOrderAndThenLayers) {
    const Scene scene = make_two_plants();
    const auto groups = make_groups(scene, group_spec(grouped_spec(Method::light_tracing)));
    std::vector<std::string> names;
    for (const OrganGroup& group : groups) {
        names.push_back(group.by + " " + group.value);
    }
    const std::vector<std::string> expected{
        "all ",
        "plant b",
        "plant a",
        "kind leaf",
        "kind stem",
        "kind sensor",
        "plant+kind b+leaf",
        "plant+kind a+leaf",
        "plant+kind a+stem",
        "plant+kind b+stem",
        "layer 1",
        "layer 2",
        "layer 3"};
    EXPECT_EQ(names, expected);
    EXPECT_EQ(groups[0].organs, (std::vector<std::uint32_t>{0, 1, 2, 3, 4, 5, 6, 7}))
        << "no sensor, no organ that is not measured, no ground";
    EXPECT_EQ(groups[2].organs, (std::vector<std::uint32_t>{3, 4, 5, 6}));
    EXPECT_EQ(groups[5].organs, (std::vector<std::uint32_t>{8}));
    double area = 0;
    for (const std::uint32_t i : groups[2].organs) {
        area += scene.organs()[i].area;
    }
    EXPECT_DOUBLE_EQ(groups[2].area, area);
}

TEST(Groups, TakeAKeyThatHasAPlusInItForOneKey) {
    const auto groups = make_groups(make_two_plants(), {.labels = {"leaf+age"}});
    ASSERT_EQ(groups.size(), 2U);
    EXPECT_EQ(groups[1].value, "1");
    EXPECT_EQ(groups[1].organs.size(), 6U);
}

std::vector<std::string> names_of_groups(const GroupSpec& spec) {
    std::vector<std::string> names;
    for (const OrganGroup& group : make_groups(make_two_plants(), spec)) {
        names.push_back(fmt::format("{} {} {}", group.by, group.value, group.organs.size()));
    }
    return names;
}

TEST(Groups, AreSelectedByConditionsAndHaveNames) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(
        names_of_groups({.labels = {"plant where kind == 'leaf'"}}),
        (Names{"all  8", "plant where kind == 'leaf' b 3", "plant where kind == 'leaf' a 3"}));
    EXPECT_EQ(
        names_of_groups({.labels = {"low: kind where height < 0.1 and area > 0"}}),
        (Names{"all  8", "low stem 2"}));
    EXPECT_EQ(
        names_of_groups({.labels = {"sensors: where material == 'sensor'", "where id in [1, 2]"}}),
        (Names{"all  8", "sensors  1", "where id in [1, 2]  2"}));
    EXPECT_EQ(
        names_of_groups({.labels = {"material"}}),
        (Names{"all  8", "material leaf 8", "material sensor 1"}));
}

TEST(Groups, JoinLabelsWithLayers) {
    const Scene scene = make_two_plants();
    const auto groups =
        make_groups(scene, {.labels = {"kind+layer"}, .layer_heights = {-.4, .3, .5, 1}});
    double area = 0;
    for (const OrganGroup& group : groups) {
        area += group.by == "kind+layer" ? group.area : 0;
        if (group.by == "kind+layer" && group.value == "stem+1") {
            EXPECT_EQ(group.organs, (std::vector<std::uint32_t>{6, 7}));
            EXPECT_EQ(group.labels, (Labels{{"kind", "stem"}, {"layer", "1"}}));
        }
    }
    EXPECT_NEAR(area, groups[0].area, 1e-12) << "sensors are in no layer";
}

/// The light on a ground that is not measured is unknown with paths from organs, and not 0.
TEST(Groups, HaveSharesWithoutAMeasuredGround) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_organ(organ("", "leaf", floor_of(0, 1, 0, 1, 1)));
    builder.add_organ(organ("", "leaf", floor_of(1, 2, 0, 1, 2)));
    GroundSpec soil = ground("leaf");
    soil.measured = false;
    builder.set_ground(soil);
    builder.set_cell(
        {.along_x = true, .along_y = true, .low_x = 0, .low_y = 0, .size_x = 3, .size_y = 3});
    const Scene scene = std::move(builder).build();
    EXPECT_FALSE(scene.organs().back().measured);
    const Result some = run(scene, {sky({1})}, spec_of(Method::from_organs, 1024));
    EXPECT_TRUE(std::isnan(some.canopy[0].transmittance.mean));
    EXPECT_TRUE(std::isnan(some.at(2, Quantity::absorbed_flux, 0).mean));
    const Result all = run(scene, {sky({1})}, spec_of(Method::light_tracing, 1024));
    EXPECT_GT(all.canopy[0].transmittance.mean, 0.5);
    EXPECT_NEAR(
        some.groups.share(0, GroupShare::incident, 0).mean,
        all.groups.share(0, GroupShare::incident, 0).mean, 0.01);
}

/// Horizontal squares of 1 and of 0.25, and a vertical one from 0 to 1, in a cell of 2.
Scene make_stories() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    for (const double z : {0.0, 1.0, 2.0, 3.0}) {
        builder.add_organ(organ("", "leaf", floor_of(0, 1, 0, z < 3 ? 1 : .25, z)));
    }
    builder.add_organ(
        organ("upright", "leaf", make_parallelogram({.5, 0, 0}, {0, .5, 0}, {0, 0, 1})));
    builder.set_cell(
        {.along_x = true, .along_y = true, .low_x = 0, .low_y = 0, .size_x = 2, .size_y = 1});
    return std::move(builder).build();
}

TEST(Layers, HoldTheOrgansWhoseCentroidsLieInThem) {
    const auto layers = make_groups(make_stories(), {.layer_heights = {.5, 1, 3}});
    ASSERT_EQ(layers.size(), 3U);
    EXPECT_EQ(layers[1].organs, (std::vector<std::uint32_t>{4}));
    EXPECT_EQ(layers[2].organs, (std::vector<std::uint32_t>{1, 2, 3}))
        << "the height between two layers belongs to the upper one, the last to the last";
    EXPECT_EQ(layers[2].height_min, 1);
    EXPECT_EQ(layers[2].height_max, 3);
    EXPECT_DOUBLE_EQ(layers[1].plant_area_index, .25);
    EXPECT_DOUBLE_EQ(layers[2].plant_area_index, 2.25 / 2);
    EXPECT_DOUBLE_EQ(layers[2].cumulative_plant_area_index, 2.25 / 2);
    EXPECT_DOUBLE_EQ(layers[1].cumulative_plant_area_index, 2.75 / 2);
}

TEST(Layers, OfEqualHeightReachFromTheLowestPointToTheHighest) {
    const auto layers = make_groups(make_stories(), {.layers = 3});
    ASSERT_EQ(layers.size(), 4U);
    EXPECT_EQ(layers[1].height_min, 0);
    EXPECT_DOUBLE_EQ(layers[2].height_min, 1);
    EXPECT_EQ(layers[3].height_max, 3);
    std::size_t organs = 0;
    for (std::size_t i = 1; i < layers.size(); ++i) {
        organs += layers[i].organs.size();
    }
    EXPECT_EQ(organs, 5U);
}

TEST(Layers, OverAGroundBeginThere) {
    const auto layers = make_groups(make_two_plants(), {.layers = 2});
    EXPECT_DOUBLE_EQ(layers[1].height_min, -.4);
    EXPECT_GT(layers[1].plant_area_index, 0);
}

TEST(Layers, WithoutAreaBelowHaveNoPlantAreaIndex) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_organ(organ("", "leaf", floor_of(0, 1, 0, 1, .2)));
    const auto layers = make_groups(std::move(builder).build(), {.layer_heights = {0, 1}});
    EXPECT_TRUE(std::isnan(layers[1].plant_area_index));
}

std::vector<std::string> faults_of_groups(const Scene& scene, const RunSpec& spec) {
    Faults faults;
    check_run(scene, day_light(), spec, faults);
    std::vector<std::string> texts;
    for (const Fault& fault : faults.all()) {
        texts.push_back(fault.text());
    }
    return texts;
}

TEST(GroupFaults, NameTheLabelThatNoOrganHas) {
    RunSpec spec = spec_of(Method::light_tracing, 64);
    spec.groups = {"plnat", "plant+knd"};
    EXPECT_EQ(
        faults_of_groups(make_two_plants(), spec),
        (std::vector<std::string>{
            "groups: no organ has a label 'plnat' (groups are formed by the values of a label); "
            "did you mean 'plant'?",
            "groups: no organ has a label 'knd' (groups are formed by the values of a label); did "
            "you mean 'kind'?"}));
}

TEST(GroupFaults, SayWhatIsWrongInConditions) {
    const std::vector<std::pair<std::string, std::string>> table{
        {"plant where kimd == 'leaf'",
         "groups: where: unknown label 'kimd' in \"kimd == 'leaf'\" (labels are plant, kind, "
         "leaf+age, id, name, material, area, height); did you mean 'kind'?"},
        {"plant where kind = 'leaf'", "'=' sets nothing here; compare with '=='"},
        {"kind+layer", "there are no layers"},
        {"all: kind where area > 0", "other groups have the name 'all'"},
        {"plant+", "no organ has a label ''"},
        {"", "no organ has a label ''"}};
    for (const auto& [text, problem] : table) {
        Faults faults;
        check_groups(make_two_plants(), {.labels = {text}}, faults);
        ASSERT_EQ(faults.size(), 1U) << text;
        EXPECT_NE(faults.all()[0].text().find(problem), std::string::npos)
            << faults.all()[0].text();
    }
    Faults twice;
    check_groups(
        make_two_plants(), {.labels = {"a: plant where area > 0", "a: kind where area > 0"}},
        twice);
    EXPECT_EQ(twice.size(), 1U);
    Faults faults;
    check_groups(make_two_plants(), {.labels = {"layer"}, .layers = 2}, faults);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults.all()[0].text().find("'layer' is a group already"), std::string::npos);
}

TEST(GroupFaults, IncludeALabelOfTheNameOfLayers) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_organ(labelled(organ("", "leaf", floor_of(0, 1, 0, 1, .2)), {{"layer", "7"}}));
    const Scene scene = std::move(builder).build();
    Faults faults;
    check_groups(scene, {.labels = {"layer"}}, faults);
    EXPECT_EQ(faults.size(), 0U) << "a label as others";
    check_groups(scene, {.labels = {"layer"}, .layer_heights = {0, 1}}, faults);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults.all()[0].text().find("is a label and the number of"), std::string::npos);
    Faults none;
    check_groups(scene, {.layer_heights = {0, 1}}, none);
    EXPECT_EQ(none.size(), 0U) << "no groups by the label";
}

TEST(GroupFaults, IncludeHeightsThatDoNotAscend) {
    RunSpec spec = spec_of(Method::light_tracing, 64);
    spec.layer_heights = {0, 2, 1};
    EXPECT_EQ(
        faults_of_groups(make_two_plants(), spec),
        (std::vector<std::string>{"layer_heights: 1 follows 2 (heights must be finite and "
                                  "ascending); give them in ascending order"}));
    spec.layer_heights = {0, std::nan("")};
    EXPECT_EQ(faults_of_groups(make_two_plants(), spec).size(), 1U);
    spec.layer_heights = {3};
    EXPECT_EQ(faults_of_groups(make_two_plants(), spec).size(), 1U);
    spec.layer_heights = {0, 1};
    EXPECT_TRUE(faults_of_groups(make_two_plants(), spec).empty());
    spec.layers = 3;
    EXPECT_EQ(faults_of_groups(make_two_plants(), spec).size(), 1U) << "both";
}

TEST(GroupFaults, IncludeLayersOfAFlatScene) {
    SceneBuilder builder = make_builder(2);
    builder.add_material(diffuse("leaf", .3, .2, 2));
    builder.add_organ(organ("", "leaf", floor_of(0, 1, 0, 1, .2)));
    RunSpec spec = spec_of(Method::light_tracing, 64);
    spec.layers = 2;
    EXPECT_EQ(faults_of_groups(std::move(builder).build(), spec).size(), 1U);
}

class GroupsOfRuns : public BothWays {};

/// The light of a group, as the sum of that of its organs.
double sum_over_organs(
    const Scene& scene,
    const Result& result,
    const OrganGroup& group,
    const QuantityEntry& entry,
    std::size_t band) {
    double sum = 0;
    for (const std::uint32_t i : group.organs) {
        sum += result.at(i, entry.quantity, band).mean *
               (entry.is_flux ? 1 : scene.organs()[i].area / group.area);
    }
    return sum;
}

TEST_P(GroupsOfRuns, AreTheSumsOfTheirOrgans) {
    const Scene scene = make_two_plants();
    const Result result = run(scene, day_light(), grouped_spec(GetParam()));
    const GroupResults& groups = result.groups;
    ASSERT_EQ(groups.groups.size(), 13U);
    for (std::size_t g = 0; g < groups.groups.size(); ++g) {
        const OrganGroup& group = groups.groups[g];
        for (std::size_t b = 0; b < 2; ++b) {
            for (const QuantityEntry& entry : quantity_table()) {
                const double sum = sum_over_organs(scene, result, group, entry, b);
                EXPECT_NEAR(groups.at(g, entry.quantity, b).mean, sum, 1e-12 * (1 + sum))
                    << group.by << group.value << entry.name;
            }
        }
        double sunlit = 0;
        for (const std::uint32_t i : group.organs) {
            sunlit += result.sunlit_fraction[i].mean * scene.organs()[i].area;
        }
        EXPECT_NEAR(groups.sunlit_area[g].mean, sunlit, 1e-12);
        EXPECT_NEAR(groups.sunlit_fraction[g].mean * group.area, sunlit, 1e-12);
    }
}

/// Shares of disjoint groups add up, and have the errors of quotients: the whole has none.
TEST_P(GroupsOfRuns, HaveSharesOfLight) {
    const Scene scene = make_two_plants();
    const Result result = run(scene, day_light(), grouped_spec(GetParam()));
    const GroupResults& groups = result.groups;
    for (std::size_t b = 0; b < 2; ++b) {
        const Estimate all = groups.share(0, GroupShare::absorbed, b);
        EXPECT_NEAR(all.mean, 1, 1e-12);
        EXPECT_LT(all.standard_error, 1e-12);
        double absorbed = 0, incident = 0;
        for (const std::size_t g : {6, 7, 8, 9}) {  // plant+kind
            absorbed += groups.share(g, GroupShare::absorbed, b).mean;
            incident += groups.share(g, GroupShare::incident, b).mean;
            EXPECT_GT(groups.share(g, GroupShare::absorbed, b).standard_error, 0);
        }
        EXPECT_NEAR(absorbed, 1, 1e-12);
        const Estimate whole = groups.share(0, GroupShare::incident, b);
        EXPECT_NEAR(incident, whole.mean, 1e-12);
        const double flux = groups.at(0, Quantity::absorbed_flux, b).mean;
        EXPECT_NEAR(whole.mean, flux / result.canopy[b].incident, 1e-9 * whole.mean);
    }
}

TEST_P(GroupsOfRuns, OfOneOrganHaveItsErrorsAndRatios) {
    const Result result = run(make_two_plants(), day_light(), grouped_spec(GetParam()));
    constexpr std::size_t kSensors = 5;
    const Estimate& group = result.groups.at(kSensors, Quantity::incident_upper, 1);
    const Estimate& own = result.at(8, Quantity::incident_upper, 1);
    EXPECT_NEAR(group.standard_error, own.standard_error, 1e-9 * own.standard_error + 1e-14);
    EXPECT_NEAR(group.ci95_high, own.ci95_high, 1e-9);
    EXPECT_NEAR(result.groups.ratio(kSensors, 0).mean, result.ratio(8, 0).mean, 1e-12);
}

TEST_P(GroupsOfRuns, AreTheSameBitsOnAnyNumberOfThreads) {
    const Scene scene = make_two_plants();
    RunSpec spec = grouped_spec(GetParam(), 256);
    spec.layers = 0;
    const Result one = run(scene, day_light(), spec);
    for (const unsigned threads : {2U, 5U}) {
        spec.threads = threads;
        const Result many = run(scene, day_light(), spec);
        for (std::size_t i = 0; i < one.groups.values.size(); ++i) {
            EXPECT_EQ(one.groups.values[i].mean, many.groups.values[i].mean);
            EXPECT_EQ(one.groups.values[i].standard_error, many.groups.values[i].standard_error);
            EXPECT_EQ(one.groups.values[i].ci95_high, many.groups.values[i].ci95_high);
        }
    }
}

TEST_P(GroupsOfRuns, WithoutContributionsHaveTheBoundOfTheLargestOne) {
    SceneBuilder builder = make_builder(1);
    builder.add_material(diffuse("leaf", .3, .1));
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(
        labelled(organ("a", "leaf", floor_of(.4, .6, .4, .6, -1)), {{"part", "below"}}));
    builder.add_organ(
        labelled(organ("b", "leaf", floor_of(.4, .5, .4, .6, -2)), {{"part", "below"}}));
    builder.add_organ(
        labelled(organ("roof", "black", floor_of(0, 1, 0, 1, 0)), {{"part", "roof"}}));
    RunSpec spec = spec_of(GetParam(), 256);
    spec.groups = {"part"};
    const Result result = run(std::move(builder).build(), {sun(0, {10})}, spec);
    const Estimate& dark = result.groups.at(1, Quantity::absorbed_flux, 0);
    EXPECT_EQ(dark.mean, 0);
    EXPECT_TRUE(std::isnan(dark.standard_error));
    const double a = result.at(0, Quantity::absorbed_flux, 0).ci95_high;
    const double b = result.at(1, Quantity::absorbed_flux, 0).ci95_high;
    if (GetParam() == Method::first_hits) {
        // A line may hit both.
        EXPECT_GT(dark.ci95_high, 1.2 * std::max(a, b));
        EXPECT_LE(dark.ci95_high, a + b);
    } else {
        EXPECT_EQ(dark.ci95_high, std::max(a, b));
    }
}

TEST_P(GroupsOfRuns, WithoutOrgansHaveNoLightForSure) {
    RunSpec spec = spec_of(GetParam(), 256);
    spec.layer_heights = {5, 6};
    const Result result = run(make_two_plants(), day_light(), spec);
    const Estimate& none = result.groups.at(1, Quantity::incident_upper, 0);
    EXPECT_EQ(none.mean, 0);
    EXPECT_EQ(none.standard_error, 0);
    EXPECT_EQ(none.ci95_high, 0);
}

QUASIMC_BOTH_WAYS(GroupsOfRuns);

/// A leaf in the shade of another: light absorbed by the one is missing on the other.
Scene make_shading_pair() {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .1, .05));
    builder.add_organ(labelled(organ("", "leaf", floor_of(0, 1, 0, 1, 0)), {{"pair", "1"}}));
    builder.add_organ(labelled(organ("", "leaf", floor_of(.2, .7, .1, .9, .5)), {{"pair", "1"}}));
    return std::move(builder).build();
}

RunSpec pair_spec(std::uint64_t seed) {
    RunSpec spec = spec_of(Method::light_tracing, 256);
    spec.sampler = "monte_carlo";
    spec.replicates = 8;
    spec.seed = seed;
    spec.groups = {"pair"};
    return spec;
}

/// Whether an error is that of two organs with independent errors.
::testing::AssertionResult is_added(double error, const Result& result) {
    const double a = result.at(0, Quantity::absorbed_flux, 0).standard_error;
    const double b = result.at(1, Quantity::absorbed_flux, 0).standard_error;
    const double added = std::sqrt(a * a + b * b);
    return std::abs(error - added) < .2 * added
               ? ::testing::AssertionSuccess()
               : ::testing::AssertionFailure() << error << " is not " << added;
}

TEST(GroupErrors, OfOrgansThatShadeOneAnotherAreSmallerThanErrorsAdded) {
    RunSpec spec = pair_spec(1);
    spec.replicates = 64;
    const Result result = run(make_shading_pair(), {sun(20, {1})}, spec);
    const double error = result.groups.at(1, Quantity::absorbed_flux, 0).standard_error;
    EXPECT_FALSE(is_added(error, result));
    EXPECT_LT(error, .5 * result.at(0, Quantity::absorbed_flux, 0).standard_error);
    EXPECT_LT(error, .5 * result.at(1, Quantity::absorbed_flux, 0).standard_error);
}

TEST(GroupErrors, OfOrgansTracedForThemselvesAreErrorsAdded) {
    RunSpec spec = pair_spec(1);
    spec.method = Method::from_organs;
    spec.replicates = 512;
    spec.paths = 64;
    const Result result = run(make_shading_pair(), {sun(20, {1})}, spec);
    EXPECT_TRUE(is_added(result.groups.at(1, Quantity::absorbed_flux, 0).standard_error, result));
}

TEST(GroupSums, OfADayAreThoseOfItsOrgansWithErrorsOfTheirOwn) {
    const Scene scene = make_shading_pair();
    const std::vector<TimeStep> times{
        {"morning", {sun(40, {1})}, "a", 3600, 0},
        {"noon", {sun(20, {1})}, "b", 3600, 0},
        {"later", {sun(20, {3})}, "b", 1800, 0},
        {"night", {}, "", 3600, 0}};
    std::vector<Result> results;
    SeriesSum day;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { day = sum; };
    const SeriesSummary summary = run_series(scene, times, pair_spec(1), {.listeners = {&events}});
    const auto sum_of = [&](const SeriesSum& sum, std::size_t organ) {
        return sum.at(organ, Quantity::absorbed_flux, 0);
    };
    const Estimate& pair = day.groups.at(1, Quantity::absorbed_flux, 0);
    EXPECT_NEAR(pair.mean, sum_of(day, 0).mean + sum_of(day, 1).mean, 1e-9 * pair.mean);
    EXPECT_EQ(summary.total.groups.at(1, Quantity::absorbed_flux, 0).mean, pair.mean);
    // Noon and later share a trace, whose error counts for both; morning has its own.
    const auto error_at = [&](std::size_t time) {
        return results[time].groups.at(1, Quantity::absorbed_flux, 0).standard_error;
    };
    EXPECT_NEAR(
        pair.standard_error, std::hypot(3600 * error_at(0), (3600 + 3 * 1800) * error_at(1)),
        1e-9 * pair.standard_error);
    EXPECT_NEAR(error_at(2), 3 * error_at(1), 1e-12);
    EXPECT_EQ(results[3].groups.at(1, Quantity::absorbed_flux, 0).ci95_high, 0);
    EXPECT_EQ(results[3].groups.groups[1].organs.size(), 2U);
}

/// Shares and fractions of a day are quotients of its sums; those of one time step are that step's.
TEST(GroupSums, OfADayHaveSharesOfTheSums) {
    const Scene scene = make_two_plants();
    const std::vector<TimeStep> times{
        {"morning", {sun(70, {1, 2}), sky({.2, .1})}, "a", 3600, 0},
        {"noon", {sun(20, {4, 6}), sky({.5, .2})}, "b", 3600, 0},
        {"night", {}, "", 3600, 0},
        {"next", {sun(20, {4, 6}), sky({.5, .2})}, "b", 1800, 1}};
    std::vector<Result> results;
    std::vector<SeriesSum> days;
    Listening events;
    events.time_step = [&](std::size_t, const Result& result, std::size_t) {
        results.push_back(result);
    };
    events.day = [&](std::size_t, const SeriesSum& sum) { days.push_back(sum); };
    run_series(scene, times, grouped_spec(Method::light_tracing), {.listeners = {&events}});
    ASSERT_EQ(days.size(), 2U);
    for (std::size_t g = 0; g < results[0].groups.groups.size(); ++g) {
        for (std::size_t b = 0; b < 2; ++b) {
            const auto flux = [&](std::size_t group) {
                return days[0].groups.at(group, Quantity::absorbed_flux, b).mean;
            };
            const double light =
                3600 * (results[0].canopy[b].incident + results[1].canopy[b].incident);
            const Estimate absorbed = days[0].groups.share(g, GroupShare::absorbed, b);
            const Estimate incident = days[0].groups.share(g, GroupShare::incident, b);
            EXPECT_NEAR(absorbed.mean, flux(g) / flux(0), 1e-12);
            EXPECT_NEAR(incident.mean, flux(g) / light, 1e-12);
            const Estimate next = days[1].groups.share(g, GroupShare::absorbed, b);
            const Estimate step = results[3].groups.share(g, GroupShare::absorbed, b);
            EXPECT_NEAR(next.mean, step.mean, 1e-12);
            EXPECT_NEAR(next.standard_error, step.standard_error, 1e-12);
        }
    }
    for (std::size_t b = 0; b < 2; ++b) {
        const CanopyFractions& day = days[0].canopy.at(b);
        EXPECT_NEAR(
            day.incident, 3600 * (results[0].canopy[b].incident + results[1].canopy[b].incident),
            1e-9 * day.incident);
        double absorbed = 0;
        for (const Result* step : {&results[0], &results[1]}) {
            absorbed += 3600 * step->canopy[b].incident * step->canopy[b].absorptance.mean;
        }
        EXPECT_NEAR(day.absorptance.mean, absorbed / day.incident, 1e-12);
        EXPECT_GT(day.reflectance.standard_error, 0);
        const CanopyFractions &next = days[1].canopy.at(b), &step = results[3].canopy.at(b);
        for (const FractionEntry& entry : fraction_table()) {
            EXPECT_NEAR((next.*entry.part).mean, (step.*entry.part).mean, 1e-12) << entry.name;
            EXPECT_NEAR(
                (next.*entry.part).standard_error, (step.*entry.part).standard_error, 1e-12);
        }
    }
    // The larger amount of light at noon determines the error.
    const auto error_of = [](const GroupResults& groups) {
        return groups.share(1, GroupShare::absorbed, 0).standard_error;
    };
    EXPECT_GT(error_of(days[0].groups), 0.3 * error_of(results[1].groups));
    EXPECT_LT(error_of(days[0].groups), error_of(results[0].groups) + error_of(results[1].groups));
}

}  // namespace
}  // namespace quasimc::test
