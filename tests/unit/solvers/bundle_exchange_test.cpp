#include "solvers/ray_bundles/bundle_exchange.h"

#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

/// The horizontal has its exact area in every group, whatever places it.
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

}  // namespace
}  // namespace quasimc
