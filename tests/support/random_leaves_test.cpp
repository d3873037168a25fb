#include "support/random_leaves.h"

#include <array>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace quasimc::test {
namespace {

TEST(RandomLeaves, AreEquilateralTrianglesAboutPointsOfTheCube) {
    for (const Triangle& leaf : random_leaves(100, 1.3, 10, 1)) {
        EXPECT_NEAR(length(leaf[1] - leaf[0]), 1.3, 1e-12);
        EXPECT_NEAR(length(leaf[2] - leaf[1]), 1.3, 1e-12);
        EXPECT_NEAR(length(leaf[0] - leaf[2]), 1.3, 1e-12);
        const Vec3 center = (leaf[0] + leaf[1] + leaf[2]) / 3;
        for (const double x : {center.x, center.y, center.z}) {
            EXPECT_GE(x, -1e-12);
            EXPECT_LE(x, 10 + 1e-12);
        }
    }
}

TEST(RandomLeaves, AreTheSameForTheSameSeed) {
    EXPECT_EQ(random_leaves(5, 1, 10, 1), random_leaves(5, 1, 10, 1));
    EXPECT_NE(random_leaves(5, 1, 10, 1), random_leaves(5, 1, 10, 2));
}

TEST(RandomLeaves, FaceAllDirectionsAlike) {
    std::array<double, 16> squares{};
    for (std::size_t r = 0; r < squares.size(); ++r) {
        for (const Triangle& leaf : random_leaves(500, 1, 1, r)) {
            const Vec3 n = normalized(area_vector(leaf));
            squares[r] += n.z * n.z / 500;
        }
    }
    EXPECT_TRUE(agrees(measured(squares), 1.0 / 3, 0.05));
}

}  // namespace
}  // namespace quasimc::test
