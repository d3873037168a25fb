#include "solvers/ray_bundles/bundle_exchange.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// The horizontal has its exact area in every group, for any key.
TEST(BundleDirections, AreHalfAsHighAsTheZenithOnAverage) {
    for (const std::uint32_t directions : {2U, 8U, 64U, 1000U}) {
        for (std::uint64_t key = 0; key < 20; ++key) {
            const BundleGroup group{directions, 1, key};
            double height = 0;
            for (std::uint32_t i = 0; i < directions; ++i) {
                const Vec3 d = bundle_direction(group, i);
                EXPECT_NEAR(dot(d, d), 1, 1e-14);
                EXPECT_GT(d.z, 0);
                height += d.z;
            }
            // Directions near the horizon are raised by 1e-5.
            EXPECT_NEAR(height / directions, .5, 1e-5);
        }
    }
}

/// Over all placements each direction of a group is uniform: an upright surface, of whose area a
/// direction sees |cos|, is seen with half of it.
TEST(BundleDirections, SeeASteepSurfaceWithoutBias) {
    constexpr std::uint64_t kKeys = 20000;
    double seen = 0;
    double square = 0;
    for (std::uint64_t key = 0; key < kKeys; ++key) {
        const BundleGroup group{8, 1, key};
        double own = 0;
        for (std::uint32_t i = 0; i < group.directions; ++i) {
            own += std::abs(dot(bundle_direction(group, i), Vec3{.6, .8, 0})) / group.directions;
        }
        seen += own / kKeys;
        square += own * own / kKeys;
    }
    const double error = std::sqrt((square - seen * seen) / kKeys);
    EXPECT_NEAR(seen, .5, 5 * error);
    EXPECT_LT(error, 1e-3);
}

TEST(BundleDirections, AreOthersForAnotherKey) {
    const Vec3 a = bundle_direction({8, 1, 1}, 3);
    const Vec3 b = bundle_direction({8, 1, 2}, 3);
    EXPECT_GT(length(a - b), 1e-3);
}

/// A lone leaf scatters what its albedo says, and sends all of it away from the scene: as much as
/// lines find of its area.
TEST(Exchange, LetsTheLightOfALoneLeafEscape) {
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .2));
    builder.add_organ(organ("", "leaf", {{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}}));
    const Scene scene = std::move(builder).build();
    const Sources suns({sun(0, {1})});
    const PreparedScene prepared(
        scene, suns, StartArea::silhouette,
        std::make_shared<RayCaster>(data_of(scene).geometry, scene.cell(), Accelerator::embree));
    const ProjectedScene seen{&prepared.caster().mesh(), {}};
    const SolvedBands bands = SolvedBands::of(prepared);
    const PatchScene patches(prepared, bands, seen, make_patches(prepared, {}, 64, {}));

    PatchIrradiance direct = no_irradiance(std::make_unique<PatchLight>(patches));
    const double flux = patches.patches.count();  // one of each patch
    for (std::uint32_t patch = 0; patch < patches.patches.count(); ++patch) {
        direct.light->sides(0).incident(std::size_t{2} * patch)[0] = 1;
    }
    ScatteredOrder order = scatter(std::move(direct));
    const std::vector<double>& leaving = order.flux.last;
    double escaped = 0;
    BundleScratch scratch;
    const PatchIrradiance irradiance = exchange(
        std::move(order.exitance), {64, patches.area / 100, 1},
        {.on_escape = [&](const Vec3&, auto flux_of) { escaped += flux_of[0]; }}, scratch);

    EXPECT_NEAR(leaving[0], .5 * flux, 1e-9 * flux);
    const double found = irradiance.lines->areas.found[0] / patches.area;
    EXPECT_NEAR(found, 1, .1);
    EXPECT_NEAR(escaped, leaving[0] * found, 1e-9 * flux);
    const RegionFlux on_leaf(irradiance, std::vector<double>(2, 1));
    EXPECT_EQ(on_leaf.of(0, SurfaceSide::upper)[0], 0);
    EXPECT_EQ(on_leaf.of(0, SurfaceSide::lower)[0], 0);
}

}  // namespace
}  // namespace quasimc::test
