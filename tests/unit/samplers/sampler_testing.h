#pragma once

#include <algorithm>
#include <cstdint>
#include <memory>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "samplers/catalogue.h"

namespace quasimc::test {

/// For tests that run once for every row of the catalogue: TEST_P(EverySampler, ...).
class EverySampler : public ::testing::TestWithParam<std::string> {
  protected:
    EverySampler() : sampler_(make_sampler(GetParam())) {}
    [[nodiscard]] const Sampler& sampler() const { return *sampler_; }
    [[nodiscard]] static bool is_random() {
        return std::any_of(
            sampler_catalogue().begin(), sampler_catalogue().end(),
            [](const SamplerEntry& e) { return e.name == GetParam() && e.is_random; });
    }

  private:
    std::unique_ptr<const Sampler> sampler_;
};

/// The names of the catalogue.
[[nodiscard]] std::vector<std::string> sampler_names();

/// Coordinate `dimension` of all points of the round.
[[nodiscard]] std::vector<double> coordinates(
    const Sampler& sampler, const Stream& stream, std::uint32_t dimension);

/// How often each of `boxes` equal parts of [0, 1) is hit by `x`.
[[nodiscard]] std::vector<std::uint64_t> counts(std::span<const double> x, std::uint64_t boxes);

/// The same for boxes_x * boxes_y parts of the square, counted in rows of boxes_x.
[[nodiscard]] std::vector<std::uint64_t> counts(
    std::span<const double> x,
    std::span<const double> y,
    std::uint64_t boxes_x,
    std::uint64_t boxes_y);

/// Whether all of them are 1.
[[nodiscard]] bool all_one(std::span<const std::uint64_t> counts);

/// Whether observations fall into equally likely cells with equal frequency: Pearson's chi-square,
/// upper tail (Wilson and Hilferty's approximation). The cells must hold 20 or more on average.
[[nodiscard]] ::testing::AssertionResult equally_likely(
    std::span<const std::uint64_t> counts, double level);

/// The z of the standard normal distribution that is exceeded with this probability.
[[nodiscard]] double normal_upper_quantile(double probability);

/// Pearson's correlation of numbers whose means and variances are those of the uniform
/// distribution.
[[nodiscard]] double uniform_correlation(std::span<const double> x, std::span<const double> y);

/// Whether no two of the first `dimensions` coordinates of one replicate are more correlated than
/// independent numbers would be, at `level` for the family of all pairs, and no point has two equal
/// coordinates.
[[nodiscard]] ::testing::AssertionResult dimensions_differ(
    const Sampler& sampler, const Stream& stream, std::uint32_t dimensions, double level);

}  // namespace quasimc::test
