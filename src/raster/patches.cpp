#include "raster/patches.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"

namespace quasimc {
namespace {

/// Where a part lies in its triangle.
struct PartPlace {
    std::uint32_t column = 0, row = 0;
    bool is_turned = false;
};

PartPlace place_of(int level, std::uint32_t part) {
    const std::uint32_t n = 1U << static_cast<unsigned>(level);
    std::uint32_t row = 0;
    for (std::uint32_t in_row = 2 * n - 1; part >= in_row; in_row -= 2) {
        part -= in_row;
        ++row;
    }
    return {part / 2, row, part % 2 != 0};
}

/// A place in the middle of a part.
std::pair<double, double> center_of(int level, std::uint32_t part) {
    const double n = 1 << level;
    const PartPlace place = place_of(level, part);
    const double third = (place.is_turned ? 2 : 1) / 3.0;
    return {(place.column + third) / n, (place.row + third) / n};
}

/// Where a coordinate that goes from a to b passes whole numbers, one after the other, as parts of
/// the way.
class WholeNumbers {
  public:
    WholeNumbers(double a, double b)
        : step_(1 / std::abs(b - a)),
          first_(b > a ? std::floor(a) + 1 - a : a - (std::ceil(a) - 1)),
          next_(a == b ? kNever : first_ * step_) {}

    [[nodiscard]] double next() const { return next_; }
    /// Goes past `at`.
    void pass(double at) {
        while (next_ <= at) {
            next_ = (first_ + ++passed_) * step_;
        }
    }

  private:
    static constexpr double kNever = 2;
    double step_, first_, next_;
    int passed_ = 0;
};

}  // namespace

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

ConvexPiece Patches::corners(int level, std::uint32_t part) {
    const double n = 1 << level;
    const PartPlace place = place_of(level, part);
    const double u = place.column / n;
    const double v = place.row / n;
    const double side = 1 / n;
    if (place.is_turned) {
        return {{u + side, v + side}, {u, v + side}, {u + side, v}};
    }
    return {{u, v}, {u + side, v}, {u, v + side}};
}

std::uint32_t Patches::parent(int level, std::uint32_t part) {
    const auto [u, v] = center_of(level, part);
    return Patches::part(level - 1, u, v);
}

void Patches::cut(
    int level, const Barycentric& a, const Barycentric& b, std::vector<Stretch>& stretches) {
    stretches.clear();
    if (level == 0) {
        stretches.push_back({0, 0, 1});
        return;
    }
    const double n = 1 << level;
    const double au = a.u, av = a.v, bu = b.u, bv = b.v;
    WholeNumbers u(au * n, bu * n), v(av * n, bv * n), w((au + av) * n, (bu + bv) * n);
    for (double from = 0; from < 1;) {
        const double to = std::min({u.next(), v.next(), w.next(), 1.0});
        if (to > from) {
            const double middle = .5 * (from + to);
            const std::uint32_t part =
                Patches::part(level, au + middle * (bu - au), av + middle * (bv - av));
            stretches.push_back({part, from, to});
        }
        u.pass(to);
        v.pass(to);
        w.pass(to);
        from = to;
    }
}

}  // namespace quasimc
