#include "series/basis/interpolation_errors.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace quasimc {
namespace {

/// Number of groups of regions with similar light, and the smallest size of a group.
constexpr std::size_t kGroups = 16, kMinRegions = 64;

}  // namespace

void InterpolationErrors::add(const LightSum& together, const LightSum& as_it_is) {
    const auto count = static_cast<double>(together.bins().size());
    std::vector<double> squares(light_.size()), lights(light_.size());
    for (std::size_t i = 0; i < light_.size(); ++i) {
        double light = 0;
        double mean = 0;
        for (std::size_t r = 0; r < together.bins().size(); ++r) {
            light += as_it_is.bins()[r][i] / count;
            mean += (together.bins()[r][i] - as_it_is.bins()[r][i]) / count;
        }
        double noise = 0;
        for (std::size_t r = 0; r < together.bins().size() && count > 1; ++r) {
            const double off = together.bins()[r][i] - as_it_is.bins()[r][i] - mean;
            noise += off * off / (count * (count - 1));
        }
        squares[i] = mean * mean - noise;
        lights[i] = light * light;
    }
    add_parts(squares, lights);
}

/// Relative to all light of the time: at dawn the sky is dim, and the basis functions are least
/// accurate.
void InterpolationErrors::add_parts(
    const std::vector<double>& squares, const std::vector<double>& lights) {
    std::vector<float>& own = squares_.emplace_back(light_.size());
    const BinIndex index(layout_);
    const std::size_t parts = bin_parts(layout_).size();
    for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t first = index.first(part);
        const std::size_t end = first + index.count(part);
        double all = 0;
        for (std::size_t i = first; i < end; ++i) {
            all += lights[i];
        }
        for (std::size_t i = first; i < end && all > 0; ++i) {
            own[i] = static_cast<float>(squares[i] / all);
            light_[i] += lights[i] / all;
        }
    }
}

std::vector<double> InterpolationErrors::relative() const {
    const BinIndex index(layout_);
    std::vector<double> errors(light_.size());
    const std::size_t parts = bin_parts(layout_).size();
    for (std::size_t part = 0; part < parts; ++part) {
        std::vector<std::size_t> order(index.count(part));
        std::iota(order.begin(), order.end(), index.first(part));
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
            return light_[a] < light_[b];
        });
        const std::size_t groups = std::clamp<std::size_t>(order.size() / kMinRegions, 1, kGroups);
        for (std::size_t g = 0; g < groups; ++g) {
            const auto at = [&](std::size_t i) {
                return order.begin() + static_cast<std::ptrdiff_t>(i * order.size() / groups);
            };
            const std::vector<std::size_t> group(at(g), at(g + 1));
            const double error = relative(group);
            for (const std::size_t bin : group) {
                errors[bin] = error;
            }
        }
    }
    return errors;
}

/// Relative error of a group.
double InterpolationErrors::relative(const std::vector<std::size_t>& bins) const {
    double light = 0;
    for (const std::size_t bin : bins) {
        light += light_[bin];
    }
    if (!(light > 0)) {
        return 0;
    }
    double sum = 0;
    double of_squares = 0;
    for (const std::vector<float>& squares : squares_) {
        double own = 0;
        for (const std::size_t bin : bins) {
            own += static_cast<double>(squares[bin]);
        }
        sum += own;
        of_squares += own * own;
    }
    // The error of a sum of independent times; with few times it is at least the sum itself.
    const auto times = static_cast<double>(squares_.size());
    const double variance =
        times > 1 ? std::max(0., of_squares - sum * sum / times) * times / (times - 1) : of_squares;
    return std::sqrt(std::max(0., sum + std::sqrt(variance)) / light);
}

}  // namespace quasimc
