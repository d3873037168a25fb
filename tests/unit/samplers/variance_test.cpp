// What the samplers are for: integrals with known values, unbiased, and with less variance than
// Monte Carlo's.

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sampler_testing.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

constexpr std::uint32_t kReplicates = 128;

/// A function on the unit cube with its integral and the variance of one sample.
struct Integrand {
    std::string name;
    std::uint32_t dimensions;
    std::function<double(std::span<const double>)> value;
    double integral, variance;
};

/// The product of x_j + 1/2: smooth.
double smooth(std::span<const double> x) {
    return std::accumulate(
        x.begin(), x.end(), 1.0, [](double f, double y) { return f * (y + 0.5); });
}

/// Whether x lies in the ball of radius 1 around the origin: a jump along a curved surface, as
/// leaves have.
double ball(std::span<const double> x) {
    return std::inner_product(x.begin(), x.end(), x.begin(), 0.0) < 1 ? 1.0 : 0.0;
}

constexpr double kDisc = std::numbers::pi / 4;
constexpr double kBall4 = std::numbers::pi * std::numbers::pi / 32;

std::array<Integrand, 4> integrands() {
    return {{
        {"smooth in 2-D", 2, smooth, 1, std::pow(13.0 / 12, 2) - 1},
        {"smooth in 4-D", 4, smooth, 1, std::pow(13.0 / 12, 4) - 1},
        {"disc", 2, ball, kDisc, kDisc * (1 - kDisc)},
        {"ball in 4-D", 4, ball, kBall4, kBall4 * (1 - kBall4)},
    }};
}

/// The requirements on a sampler: its best number of points, and the factors by which it must
/// reduce the variance of Monte Carlo on integrands(), about half of the measured ones. Other
/// samplers must not increase the variance.
struct Promise {
    std::uint64_t count = 1024;
    std::array<double, 4> least_gains{};
};

Promise promise(const std::string& sampler) {
    if (sampler == "monte_carlo")
        return {.least_gains = {0.7, 0.7, 0.7, 0.7}};
    if (sampler == "korobov")
        return {.least_gains = {250, 60, 20, 8}};
    if (sampler == "sobol")
        return {.least_gains = {150000, 9000, 15, 5}};
    if (sampler == "faure")
        return {.count = 1331, .least_gains = {40000, 1800, 10, 2.5}};
    if (sampler == "halton")
        return {.least_gains = {500, 200, 12, 3.5}};
    return {.least_gains = {0.7, 0.7, 0.7, 0.7}};
}

/// The means over the points of each replicate.
std::vector<double> estimates(
    const Sampler& sampler, const Integrand& integrand, std::uint64_t count, std::uint64_t seed) {
    std::vector<double> means;
    for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
        const Stream stream{.seed = seed, .replicate = replicate, .count = count};
        std::vector<std::vector<double>> x;
        for (std::uint32_t j = 0; j < integrand.dimensions; ++j)
            x.push_back(coordinates(sampler, stream, j));
        double sum = 0;
        std::vector<double> point(integrand.dimensions);
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::uint32_t j = 0; j < integrand.dimensions; ++j)
                point[j] = x[j][i];
            sum += integrand.value(point);
        }
        means.push_back(sum / static_cast<double>(count));
    }
    return means;
}

/// Monte Carlo's variance over that of the estimates, whose expectation is known.
double gain(std::span<const double> means, const Integrand& integrand, std::uint64_t count) {
    double squares = 0;
    for (const double mean : means)
        squares += (mean - integrand.integral) * (mean - integrand.integral);
    return integrand.variance / static_cast<double>(count) /
           (squares / static_cast<double>(means.size()));
}

using Variance = EverySampler;
INSTANTIATE_TEST_SUITE_P(
    Catalogue, Variance, ::testing::ValuesIn(sampler_names()), [](const auto& param) {
        return param.param;
    });

TEST_P(Variance, IsLessThanThatOfMonteCarlo) {
    const auto [count, least_gains] = promise(GetParam());
    const auto all = integrands();
    for (std::size_t i = 0; i < all.size(); ++i) {
        const auto means = estimates(sampler(), all[i], count, 31);
        const double measured_gain = gain(means, all[i], count);
        EXPECT_GT(measured_gain, least_gains[i]) << all[i].name;
        RecordProperty(all[i].name, std::to_string(measured_gain));
    }
}

TEST_P(Variance, IsThatOfMonteCarloForOnePoint) {
    // One point of any randomized set is one uniform point: the variance must be that of a single
    // sample.
    for (const Integrand& integrand : integrands()) {
        const auto means = estimates(sampler(), integrand, 1, 32);
        const double measured_gain = gain(means, integrand, 1);
        EXPECT_GT(measured_gain, 0.5) << integrand.name;
        EXPECT_LT(measured_gain, 2) << integrand.name;
    }
}

TEST_P(Variance, EstimatesAreUnbiased) {
    const double level = sidak_level(kLevel, 4 * 3);
    for (const Integrand& integrand : integrands())
        for (const std::uint64_t count : {1U, 64U, 1024U}) {
            // The half-width of the interval, 5.6 standard errors, may be as wide as Monte Carlo's.
            const double resolution =
                8 * std::sqrt(integrand.variance / static_cast<double>(count) / kReplicates);
            EXPECT_TRUE(agrees(
                measured(estimates(sampler(), integrand, count, 33)), integrand.integral,
                resolution, level))
                << integrand.name << ", " << count << " points";
        }
}

TEST(VarianceTest, ABiasedSamplerIsFoundOut) {
    // The negative control: the lattice without its shift.
    class Unshifted final : public Sampler {
      public:
        double coordinate(
            const Stream& stream, std::uint64_t point, std::uint32_t dimension) const override {
            const std::uint64_t multiple = dimension == 0 ? point : point * 381;
            const auto n = static_cast<double>(stream.count);
            return static_cast<double>(multiple % stream.count) / n +
                   1e-6 * stream.replicate / kReplicates;
        }
    };
    const Integrand integrand = integrands()[0];
    const auto means = estimates(Unshifted(), integrand, 1024, 34);
    EXPECT_FALSE(agrees(measured(means), integrand.integral, 1e-3));
}

}  // namespace
}  // namespace quasimc::test
