#include "raster/patches.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"

namespace quasimc {
Patches::Patches(std::vector<std::uint8_t> levels, std::span<const SurfaceCrossing> crossings)
    : levels_(std::move(levels)) {
    if (!crossings.empty()) {
        cut_of_.resize(levels_.size());
    }
    first_.reserve(levels_.size() + 1);
    auto crossing = crossings.begin();
    for (std::uint32_t i = 0; i < triangles(); ++i) {
        const std::uint8_t level = levels_[i];
        EXPECT(level <= kFinest || level == kNone);
        const auto end = std::find_if(
            crossing, crossings.end(), [&](const SurfaceCrossing& c) { return c.triangle != i; });
        std::uint32_t patches = level == kNone ? 0 : 1U << (2U * level);
        if (crossing != end) {
            EXPECT(level >= 1 && level != kNone);
            cuts_.emplace_back(level, std::span(crossing, end));
            cut_of_[i] = static_cast<std::uint32_t>(cuts_.size());
            patches = cuts_.back().patches();
        }
        crossing = end;
        first_.push_back(first_.back() + patches);
    }
    EXPECT(crossing == crossings.end());
}

double Patches::share(std::uint32_t triangle, std::uint32_t i) const {
    const CutTriangle* cut = cut_of(triangle);
    return cut == nullptr ? std::ldexp(1.0, -2 * level(triangle)) : cut->area(i);
}

}  // namespace quasimc
