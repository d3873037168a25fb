#include "sampler_testing.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "support/statistics.h"

namespace quasimc::test {

std::vector<std::string> sampler_names() {
    std::vector<std::string> names;
    for (const SamplerEntry& entry : sampler_catalogue())
        names.emplace_back(entry.name);
    return names;
}

std::vector<double> coordinates(
    const Sampler& sampler, const Stream& stream, std::uint32_t dimension) {
    std::vector<double> x(stream.count);
    sampler.coordinates(stream, stream.first, dimension, x);
    return x;
}

std::vector<std::uint64_t> counts(std::span<const double> x, std::uint64_t boxes) {
    std::vector<std::uint64_t> result(boxes);
    for (const double value : x)
        ++result[static_cast<std::size_t>(value * static_cast<double>(boxes))];
    return result;
}

std::vector<std::uint64_t> counts(
    std::span<const double> x,
    std::span<const double> y,
    std::uint64_t boxes_x,
    std::uint64_t boxes_y) {
    std::vector<std::uint64_t> result(boxes_x * boxes_y);
    for (std::size_t i = 0; i < x.size(); ++i) {
        const auto column = static_cast<std::uint64_t>(x[i] * static_cast<double>(boxes_x));
        const auto row = static_cast<std::uint64_t>(y[i] * static_cast<double>(boxes_y));
        ++result[row * boxes_x + column];
    }
    return result;
}

bool all_one(std::span<const std::uint64_t> counts) {
    return std::all_of(
        counts.begin(), counts.end(), [](std::uint64_t count) { return count == 1; });
}

::testing::AssertionResult equally_likely(std::span<const std::uint64_t> counts, double level) {
    const auto cells = static_cast<double>(counts.size());
    const double total =
        static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
    const double expected = total / cells;
    if (expected < 20)
        return ::testing::AssertionFailure() << "only " << expected << " observations a cell";
    double chi2 = 0;
    for (const std::uint64_t count : counts)
        chi2 += std::pow(static_cast<double>(count) - expected, 2) / expected;
    const double v = 2 / (9 * (cells - 1));
    const double limit =
        (cells - 1) * std::pow(1 - v + normal_upper_quantile(level) * std::sqrt(v), 3);
    if (chi2 > limit)
        return ::testing::AssertionFailure()
               << "chi-square " << chi2 << " of " << cells << " cells exceeds " << limit;
    return ::testing::AssertionSuccess();
}

double normal_upper_quantile(double probability) {
    double low = -40;
    double high = 40;
    for (int i = 0; i < 200; ++i) {
        const double middle = (low + high) / 2;
        (std::erfc(middle / std::sqrt(2.0)) / 2 > probability ? low : high) = middle;
    }
    return low;
}

double uniform_correlation(std::span<const double> x, std::span<const double> y) {
    double sum = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        sum += (x[i] - 0.5) * (y[i] - 0.5);
    return 12 * sum / static_cast<double>(x.size());
}

::testing::AssertionResult dimensions_differ(
    const Sampler& sampler, const Stream& stream, std::uint32_t dimensions, double level) {
    std::vector<std::vector<double>> x;
    for (std::uint32_t j = 0; j < dimensions; ++j)
        x.push_back(coordinates(sampler, stream, j));
    const double each = sidak_level(level, dimensions * (dimensions - 1) / 2);
    const double limit =
        normal_upper_quantile(each / 2) / std::sqrt(static_cast<double>(stream.count));
    for (std::uint32_t j = 0; j < dimensions; ++j)
        for (std::uint32_t k = j + 1; k < dimensions; ++k) {
            const double correlation = uniform_correlation(x[j], x[k]);
            if (std::abs(correlation) > limit)
                return ::testing::AssertionFailure()
                       << "dimensions " << j << " and " << k << " have correlation " << correlation
                       << " over " << stream.count << " points, more than " << limit;
            for (std::size_t i = 0; i < x[j].size(); ++i)
                if (x[j][i] == x[k][i])
                    return ::testing::AssertionFailure()
                           << "dimensions " << j << " and " << k << " agree in point " << i;
        }
    return ::testing::AssertionSuccess();
}

}  // namespace quasimc::test
