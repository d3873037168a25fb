// Cost grows no faster than n log n in suns, triangles, organs, bands and paths. Work is counted:
// bytes allocated, numbers drawn, rays cast. An algorithm of the second power, four times the size:
// sixteen times the work; what is allowed is five.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scaling/work.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

constexpr double kFactor = 4;  ///< from one size to the next
constexpr double kAllowed = 5;

Scene leaves(std::size_t organs, std::size_t triangles_each, std::size_t bands) {
    SceneBuilder builder = make_builder(bands);
    builder.add_material(diffuse("leaf", .1, .1, bands));
    const std::vector<Triangle> all = random_leaves(organs * triangles_each, .1, 1, 7);
    for (std::size_t i = 0; i < organs; ++i) {
        const auto first = all.begin() + static_cast<std::ptrdiff_t>(i * triangles_each);
        builder.add_organ(organ(
            "leaf " + std::to_string(i), "leaf",
            {first, first + static_cast<std::ptrdiff_t>(triangles_each)}));
    }
    return std::move(builder).build();
}

/// Suns along the day, all of one spectrum.
Sources suns(std::size_t count, std::size_t bands) {
    Sources all;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = (static_cast<double>(i) + .5) / static_cast<double>(count);
        all.push_back(sun(80 * (2 * part - 1), std::vector<double>(bands, 1)));
    }
    return all;
}

struct Size {
    std::size_t organs = 40, triangles = 1, bands = 1, suns = 4;
    std::uint64_t paths = 1024;
};

Work work_of_size(const Size& size, Method method) {
    RunSpec spec = spec_of(method, size.paths);
    spec.replicates = 2;
    return work_of(
        leaves(size.organs, size.triangles, size.bands), suns(size.suns, size.bands), spec);
}

class Growth : public ::testing::TestWithParam<Method> {
  protected:
    /// Expects that four times `what` is not much more than four times the work.
    static void expect_linear(const Size& small, const Size& large) {
        const Work a = work_of_size(small, GetParam());
        const Work b = work_of_size(large, GetParam());
        EXPECT_GT(a.bytes, 0);
        EXPECT_LT(b.bytes, kAllowed * a.bytes);
        EXPECT_LT(b.numbers, kAllowed * a.numbers);
        EXPECT_LT(b.rays, kAllowed * a.rays);
    }
};

TEST_P(Growth, IsLinearInSuns) {
    // So many paths that every sun is worth its lines.
    expect_linear({.suns = 128, .paths = 4096}, {.suns = 512, .paths = 4096});
}

TEST_P(Growth, IsLinearInTriangles) {
    expect_linear({.triangles = 32}, {.triangles = 128});
}

TEST_P(Growth, IsLinearInOrgans) {
    expect_linear({.organs = 500}, {.organs = 2000});
}

TEST_P(Growth, IsLinearInBands) {
    expect_linear({.bands = 16}, {.bands = 64});
}

TEST_P(Growth, IsLinearInPaths) {
    expect_linear({.paths = 1 << 13}, {.paths = 1 << 15});
}

INSTANTIATE_TEST_SUITE_P(
    Of,
    Growth,
    ::testing::Values(Method::light_tracing, Method::first_hits, Method::from_organs),
    name_of);

TEST(Growth, IsSeenWhereItIsOfTheSecondPower) {
    const auto quadratic = [](std::size_t n) {
        return bytes_allocated_by([&] {
            for (std::size_t i = 0; i < n; ++i) {
                const std::vector<double> list(n);
                EXPECT_EQ(list.size(), n);
            }
        });
    };
    EXPECT_GT(quadratic(512), kAllowed * quadratic(128));
    EXPECT_NEAR(quadratic(512) / quadratic(128), kFactor * kFactor, 1);
}

}  // namespace
}  // namespace quasimc::test
