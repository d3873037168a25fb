#include "solvers/direct/many_suns.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quasimc {
namespace {

/// The position of a direction along a Hilbert curve (1891) through the horizontal components.
std::uint32_t position_on_curve(const Vec3& direction) {
    constexpr std::uint32_t kSide = 1U << 12U;
    const auto tile = [&](double component) {
        return std::min(kSide - 1, static_cast<std::uint32_t>((component + 1) / 2 * kSide));
    };
    std::uint32_t x = tile(direction.x), y = tile(direction.y), position = 0;
    for (std::uint32_t half = kSide / 2; half > 0; half /= 2) {
        const bool is_right = (x & half) > 0, is_high = (y & half) > 0;
        position = 4 * position + (is_right ? (is_high ? 2 : 3) : (is_high ? 1 : 0));
        if (!is_high) {
            std::swap(x, y);
            if (is_right) {
                x = kSide - 1 - x;
                y = kSide - 1 - y;
            }
        }
    }
    return position;
}

/// The sum of the changes of direction from each sun to the next.
double length_of(const std::vector<ManySuns::Sun>& suns) {
    double sum = 0;
    for (std::size_t i = 1; i < suns.size(); ++i) {
        sum += length(suns[i].direction - suns[i - 1].direction);
    }
    return sum;
}

}  // namespace

ManySuns::ManySuns(std::vector<Sun> suns) : suns_(std::move(suns)) {
    std::vector<Sun> ordered = suns_;
    std::ranges::stable_sort(
        ordered, {}, [](const Sun& sun) { return position_on_curve(sun.direction); });
    if (length_of(ordered) < length_of(suns_)) {
        suns_ = std::move(ordered);
    }
    double paths = 0;
    for (const Sun& sun : suns_) {
        probability_ += sun.probability;
        paths += sun.probability * sun.paths;
    }
    paths_of_each_ = empty() ? 1 : paths / probability_;
}

std::uint32_t ManySuns::affordable(double paths) const {
    return static_cast<std::uint32_t>(
        std::min(probability_ * paths / paths_of_each_, static_cast<double>(suns_.size())));
}

std::vector<ManySuns::Pick> ManySuns::pick(std::uint32_t count, double u) const {
    std::vector<Pick> picks;
    double light = 0;
    double steps = 0;
    for (const Sun& sun : suns_) {
        light += sun.probability;
        // Steps of equal light, shifted by a random part of one: those that end in its light.
        const double until = std::min<double>(count, std::floor(light / probability_ * count + u));
        const double represented =
            count == suns_.size() ? sun.probability : (until - steps) * light_of_each(count);
        steps = until;
        if (represented > 0) {
            picks.push_back({sun.light, represented});
        }
    }
    return picks;
}

}  // namespace quasimc
