// The yardsticks of the tests of samplers, measured themselves.

#include "sampler_testing.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace quasimc::test {
namespace {

/// All coordinates of a point the same: a shift shared by all dimensions would do that.
class OneCoordinate final : public Sampler {
  public:
    explicit OneCoordinate(double distance) : distance_(distance) {}
    double coordinate(
        const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
        const double x =
            static_cast<double>(point) / static_cast<double>(stream.count) + distance_ * dimension;
        return x - std::floor(x);
    }

  private:
    double distance_;
};

TEST(SamplerTesting, NormalQuantilesAreThoseOfTables) {
    EXPECT_NEAR(normal_upper_quantile(0.5), 0, 1e-9);
    EXPECT_NEAR(normal_upper_quantile(0.025), 1.959963985, 1e-8);
    EXPECT_NEAR(normal_upper_quantile(1e-6), 4.753424309, 1e-8);
}

TEST(SamplerTesting, ChiSquareLimitIsThatOfTables) {
    // 99.9 % quantile of 9 degrees of freedom: 27.877. Counts with chi-square 27.04 and 28.09.
    std::array<std::uint64_t, 10> counts{};
    counts.fill(100);
    counts[0] = 100 + 37;
    counts[1] = 100 - 37;
    EXPECT_TRUE(equally_likely(counts, 0.001));
    counts[2] = 100 + 7;
    counts[3] = 100 - 7;
    EXPECT_FALSE(equally_likely(counts, 0.001));
}

TEST(SamplerTesting, ChiSquareRefusesTooFewObservations) {
    EXPECT_FALSE(equally_likely(std::array<std::uint64_t, 2>{3, 3}, kLevel));
}

TEST(SamplerTesting, CorrelationOfACoordinateWithItselfIsOne) {
    const OneCoordinate sampler(0);
    const auto x = coordinates(sampler, {.count = 4096}, 0);
    EXPECT_NEAR(uniform_correlation(x, x), 1, 1e-3);
}

TEST(SamplerTesting, SharedNumbersAreSeenAsACollision) {
    const Stream stream{.count = 128};
    EXPECT_FALSE(dimensions_differ(OneCoordinate(0), stream, 64, kLevel));
    EXPECT_FALSE(dimensions_differ(OneCoordinate(0.01), stream, 64, kLevel));
}

}  // namespace
}  // namespace quasimc::test
