#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <tuple>

#include <gtest/gtest.h>

#include "solvers/ray_bundles/bundle_memory.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

Scene make_leaf_of_bands(std::size_t bands = 1) {
    SceneBuilder builder = make_builder(bands);
    builder.add_material(diffuse("leaf", .1, .1, bands));
    builder.add_organ(organ("leaf", "leaf", floor_of(0, 1, 0, 1, 0)));
    return std::move(builder).build();
}

/// The errors of a run of one leaf under a sun.
std::vector<Fault> faults_of(const RunSpec& spec, const Sources& sources = {sun(0, {1})}) {
    const Scene scene = make_leaf_of_bands();
    Faults faults;
    check_run(scene, sources, spec, faults);
    try {
        faults.throw_if_any();
        return {};
    } catch (const InputError& error) {
        return error.faults();
    }
}

/// A leaf with this material on one side.
Scene make_leaf_with(const SideOptics& upper) {
    SceneBuilder builder = make_builder();
    MaterialSpec waxy = diffuse("waxy", .1, .1);
    waxy.upper[0] = upper;
    builder.add_material(waxy);
    builder.add_organ(organ("leaf", "waxy", floor_of(0, 1, 0, 1, 0)));
    return std::move(builder).build();
}

// Materials unsuitable for bundles are rejected by name.
TEST(CheckRun, RefusesRayBundlesWhereSurfacesAreNotLambertian) {
    RunSpec spec;
    spec.method = Method::ray_bundles;
    EXPECT_TRUE(faults_of(spec).empty());
    const SideOptics shiny{.1, .1, "phong", {{"exponent", 20}}};
    const SideOptics waxy{.1, .1, "coated_lambertian", {{"coat", .04}}};
    for (const SideOptics& side : {shiny, waxy}) {
        Faults faults;
        check_run(make_leaf_with(side), {sun(0, {1})}, spec, faults);
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_EQ(faults.all()[0].where, "method");
        EXPECT_NE(faults.all()[0].problem.find("'waxy'"), std::string::npos);
        EXPECT_NE(faults.all()[0].suggestion.find("first_hits"), std::string::npos);
        spec.method = Method::automatic;
        EXPECT_NE(
            plan_method(make_leaf_with(side), {sun(0, {1})}, spec).method, Method::ray_bundles);
        spec.method = Method::ray_bundles;
    }
}

/// A hundred copies of a plant of a thousand triangles, alike in all bands.
Scene make_large_scene(std::size_t bands) {
    SceneBuilder builder = make_builder(bands);
    builder.add_material(diffuse("leaf", .1, .1, bands));
    const auto plant = std::make_shared<const Mesh>(random_leaves(1000, .1, 1, 1));
    for (int i = 0; i < 100; ++i) {
        OrganSpec organ;
        Affine transform;
        transform.shift = {2. * i, 0, 0};
        organ.parts.push_back({"leaf", {}, plant, transform});
        builder.add_organ(std::move(organ));
    }
    return std::move(builder).build();
}

TEST(CheckRun, RefusesRayBundlesThatTakeMoreMemoryThanThereIs) {
    constexpr unsigned kMany = 4096;
    RunSpec spec = spec_of(Method::ray_bundles, 1024);
    // Bands of the same optics are solved once, if they are many.
    for (const auto& [bands, threads, replicates, is_refused] :
         {std::tuple(15U, kMany, kMany, true), std::tuple(15U, kMany, 2U, false),
          std::tuple(15U, 1U, kMany, false), std::tuple(40U, 128U, 128U, false)}) {
        const Scene scene = make_large_scene(bands);
        const Sources sources{sun(0, std::vector<double>(bands, 1))};
        spec.threads = threads;
        spec.replicates = replicates;
        Faults faults;
        check_run(scene, sources, spec, faults);
        ASSERT_EQ(faults.size(), is_refused ? 1U : 0U);
        if (is_refused) {
            EXPECT_TRUE(faults.all()[0].problem.starts_with(
                "ray_bundles needs about 1179.7 GB of memory for 400000 patches"))
                << faults.all()[0].text();
        }
    }
}

TEST(CheckRun, WarnsOfTheMemoryOfRayBundlesByTheSolvedBands) {
    const RunSpec spec = spec_of(Method::ray_bundles, 1024);
    for (const auto& [bands, warns] : {std::pair(15U, true), std::pair(16U, false)}) {
        const Scene scene = make_large_scene(bands);
        const Sources sources{sun(0, std::vector<double>(bands, 1))};
        const PatchSize size = patch_size(scene, 1024);
        // 4 patches a triangle, 48 bytes a patch and band: 288 MB, so that 6 copies are needed.
        const PatchSize more{.count = 6 * size.count};
        EXPECT_EQ(lint_bundle_memory(scene, sources, spec, more).empty(), !warns);
    }
}

TEST(CheckRun, FindsNothingInAGoodSpecification) {
    EXPECT_TRUE(faults_of({}).empty());
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1000;
    spec.ratios = {"b0:b0"};
    spec.max_paths = 1000;
    spec.target_error = .5;
    spec.target_fraction = 1;
    EXPECT_TRUE(faults_of(spec).empty());
}

TEST(CheckRun, FindsEachFaultAndSaysWhere) {
    constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
    struct Case {
        std::string where;
        std::function<void(RunSpec&)> spoil;
    };
    const std::vector<Case> cases{
        {"sampler", [](RunSpec& s) { s.sampler = "soboll"; }},
        {"sampler", [](RunSpec& s) { s.sampler = ""; }},
        {"paths", [](RunSpec& s) { s.paths = 0; }},
        {"paths", [](RunSpec& s) { s.paths = (std::uint64_t{1} << 30U) + 1; }},
        {"paths",
         [](RunSpec& s) {
             s.sampler = "korobov";
             s.paths = 1000;
         }},
        {"replicates", [](RunSpec& s) { s.replicates = 0; }},
        {"audit", [](RunSpec& s) { s.audit = -.1; }},
        {"audit", [](RunSpec& s) { s.audit = 1.1; }},
        {"audit",
         [](RunSpec& s) {
             s.audit = .1;
             s.replicates = 1;
         }},
        {"replicates", [](RunSpec& s) { s.replicates = 10001; }},
        {"threads", [](RunSpec& s) { s.threads = 5000; }},
        {"roulette_threshold", [](RunSpec& s) { s.roulette_threshold = -.1; }},
        {"roulette_threshold", [](RunSpec& s) { s.roulette_threshold = kNotANumber; }},
        {"target_error", [](RunSpec& s) { s.target_error = -1; }},
        {"target_error", [](RunSpec& s) { s.target_error = 1; }},
        {"target_error", [](RunSpec& s) { s.target_error = kNotANumber; }},
        {"target_error",
         [](RunSpec& s) {
             s.target_error = .1;
             s.replicates = 1;
         }},
        {"target_fraction", [](RunSpec& s) { s.target_fraction = 0; }},
        {"target_fraction", [](RunSpec& s) { s.target_fraction = 1.01; }},
        {"max_seconds", [](RunSpec& s) { s.max_seconds = -1; }},
        {"max_seconds", [](RunSpec& s) { s.max_seconds = kNotANumber; }},
        {"max_seconds", [](RunSpec& s) { s.max_seconds = INFINITY; }},
        {"max_paths", [](RunSpec& s) { s.max_paths = 100; }},
        {"tally_memory_mb", [](RunSpec& s) { s.tally_memory_mb = -1; }},
        {"ratios", [](RunSpec& s) { s.ratios = {"b0"}; }},
        {"ratios", [](RunSpec& s) { s.ratios = {"b0:b0:b0"}; }},
        {"ratios", [](RunSpec& s) { s.ratios = {"b0:far-red"}; }},
        {"target", [](RunSpec& s) { s.target = TargetScope::groups; }},
        {"target", [](RunSpec& s) { s.target = TargetScope::sensors; }},
        {"target_quantity", [](RunSpec& s) { s.target_quantity = "absorbed"; }},
        {"target_quantity", [](RunSpec& s) { s.target_quantity = ""; }},
        {"target_bands", [](RunSpec& s) { s.target_bands = {"far-red"}; }},
    };
    for (std::size_t i = 0; i < cases.size(); ++i) {
        RunSpec spec;
        spec.method = Method::light_tracing;
        cases[i].spoil(spec);
        const std::vector<Fault> faults = faults_of(spec);
        ASSERT_EQ(faults.size(), 1U) << "case " << i;
        EXPECT_EQ(faults[0].where, cases[i].where) << "case " << i;
        EXPECT_FALSE(faults[0].problem.empty());
    }
}

TEST(CheckRun, SuggestsTheNearestName) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.sampler = "halten";
    EXPECT_NE(faults_of(spec)[0].suggestion.find("halton"), std::string::npos);
    spec = {};
    spec.sampler = "korobov";
    spec.paths = 1000;
    EXPECT_NE(faults_of(spec)[0].suggestion.find("1024"), std::string::npos);
    spec = {};
    spec.ratios = {"b0:b01"};
    EXPECT_NE(faults_of(spec)[0].suggestion.find("b0"), std::string::npos);
}

TEST(CheckRun, FindsFaultsOfSources) {
    EXPECT_EQ(faults_of({}, {}).size(), 1U);
    EXPECT_EQ(faults_of({}, {sun(0, {0}), sky({0})}).size(), 1U) << "dark";
    EXPECT_EQ(faults_of({}, {sun(0, {1}), sky({-1})}).size(), 1U);
    EXPECT_EQ(faults_of({}, {sun(0, {INFINITY})}).size(), 1U);
    EXPECT_EQ(faults_of({}, {sun(0, {std::nan("")})}).size(), 1U);
    EXPECT_EQ(faults_of({}, {sun(0, {1e-60}), sky({0})}).size(), 0U);
    EXPECT_EQ(faults_of({}, {sun(0, {1e-61}), sky({1})}).size(), 0U) << "no light";
    EXPECT_EQ(faults_of({}, {sun(0, {-1e-61}), sky({1})}).size(), 1U);
    const std::vector<Fault> tiny = faults_of({}, {sun(0, {1e-308})});
    ASSERT_EQ(tiny.size(), 1U) << "errors would be lost";
    EXPECT_NE(tiny[0].why.find("1e-60"), std::string::npos);
    const std::vector<Fault> faults = faults_of({}, {sun(0, {1}), sky({1, 2})});
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].where.find("sky"), std::string::npos);
}

TEST(CheckRun, AllFaultsOfARunAreReportedAtOnce) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.sampler = "sobel";
    spec.replicates = 0;
    spec.ratios = {"x:y"};
    try {
        (void)run(make_leaf_of_bands(), {sun(0, {1, 1})}, spec);
        FAIL() << "no error";
    } catch (const InputError& error) {
        EXPECT_EQ(error.faults().size(), 5U);
    }
}

}  // namespace
}  // namespace quasimc::test
