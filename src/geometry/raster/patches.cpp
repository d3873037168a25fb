#include "geometry/raster/patches.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/checks.h"

namespace quasimc {
namespace {

/// A place in the middle of a part.
std::pair<double, double> center_of(int level, std::uint32_t part) {
    const std::uint32_t n = 1U << static_cast<unsigned>(level);
    std::uint32_t row = 0;
    for (std::uint32_t in_row = 2 * n - 1; part >= in_row; in_row -= 2) {
        part -= in_row;
        ++row;
    }
    const double third = (part % 2 == 0 ? 1 : 2) / 3.0;
    const std::uint32_t column = part / 2;
    return {(column + third) / n, (row + third) / n};
}

/// Adds where a coordinate that goes from a to b passes whole numbers, as parts of the way.
void add_crossings(double a, double b, std::vector<double>& at) {
    const double low = std::min(a, b);
    const double high = std::max(a, b);
    for (double whole = std::floor(low) + 1; whole < high; ++whole) {
        at.push_back((whole - a) / (b - a));
    }
}

}  // namespace

Patches::Patches(std::vector<std::uint8_t> levels) : levels_(std::move(levels)) {
    first_.reserve(levels_.size() + 1);
    for (const std::uint8_t level : levels_) {
        EXPECT(level <= kFinest || level == kNone);
        const std::uint32_t parts = level == kNone ? 0 : 1U << (2U * level);
        first_.push_back(first_.back() + parts);
    }
}

std::uint32_t Patches::parent(int level, std::uint32_t part) {
    const auto [u, v] = center_of(level, part);
    return Patches::part(level - 1, u, v);
}

void Patches::cut(
    int level, const Barycentric& a, const Barycentric& b, std::vector<Stretch>& stretches) {
    stretches.clear();
    if (level == 0) {
        stretches.push_back({0, 1});
        return;
    }
    const double n = 1 << level;
    std::vector<double> at{0};
    const double au = a.u, av = a.v, bu = b.u, bv = b.v;
    add_crossings(au * n, bu * n, at);
    add_crossings(av * n, bv * n, at);
    add_crossings((au + av) * n, (bu + bv) * n, at);
    std::sort(at.begin(), at.end());
    at.push_back(1);
    for (std::size_t i = 0; i + 1 < at.size(); ++i) {
        const double middle = .5 * (at[i] + at[i + 1]);
        const std::uint32_t part =
            Patches::part(level, au + middle * (bu - au), av + middle * (bv - av));
        stretches.push_back({part, at[i + 1] - at[i]});
    }
}

}  // namespace quasimc
