#include "raster/triangle_parts.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace quasimc {
namespace {

/// The position of a part in its triangle.
struct PartPosition {
    std::uint32_t column = 0, row = 0;
    bool is_turned = false;
};

PartPosition position_of(int level, std::uint32_t part) {
    const std::uint32_t n = 1U << static_cast<unsigned>(level);
    std::uint32_t row = 0;
    for (std::uint32_t in_row = 2 * n - 1; part >= in_row; in_row -= 2) {
        part -= in_row;
        ++row;
    }
    return {part / 2, row, part % 2 != 0};
}

/// A point in the middle of a part.
std::pair<double, double> center_of(int level, std::uint32_t part) {
    const double n = 1 << level;
    const PartPosition position = position_of(level, part);
    const double third = (position.is_turned ? 2 : 1) / 3.0;
    return {(position.column + third) / n, (position.row + third) / n};
}

/// The positions where a coordinate from a to b crosses whole numbers, in order, as fractions of
/// the interval.
class WholeNumbers {
  public:
    WholeNumbers(double a, double b)
        : step_(1 / std::abs(b - a)),
          first_(b > a ? std::floor(a) + 1 - a : a - (std::ceil(a) - 1)),
          next_(a == b ? kNever : first_ * step_) {}

    [[nodiscard]] double next() const { return next_; }
    /// Advances past `at`.
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

ConvexPiece TriangleParts::corners(std::uint32_t part) const {
    const double n = 1 << level_;
    const PartPosition position = position_of(level_, part);
    const double u = position.column / n;
    const double v = position.row / n;
    const double side = 1 / n;
    if (position.is_turned) {
        return {{u + side, v + side}, {u, v + side}, {u + side, v}};
    }
    return {{u, v}, {u + side, v}, {u, v + side}};
}

std::uint32_t TriangleParts::parent(std::uint32_t part) const {
    const auto [u, v] = center_of(level_, part);
    return TriangleParts(level_ - 1).at(u, v);
}

std::span<const TriangleParts::Segment> TriangleParts::segments(
    const Barycentric& a, const Barycentric& b, std::vector<Segment>& scratch) const {
    scratch.clear();
    if (level_ == 0) {
        scratch.push_back({0, 0, 1});
        return scratch;
    }
    const double n = 1 << level_;
    const double au = a.u, av = a.v, bu = b.u, bv = b.v;
    WholeNumbers u(au * n, bu * n), v(av * n, bv * n), w((au + av) * n, (bu + bv) * n);
    for (double from = 0; from < 1;) {
        const double to = std::min({u.next(), v.next(), w.next(), 1.0});
        if (to > from) {
            const double middle = .5 * (from + to);
            const std::uint32_t part = at(au + middle * (bu - au), av + middle * (bv - av));
            scratch.push_back({part, from, to});
        }
        u.pass(to);
        v.pass(to);
        w.pass(to);
        from = to;
    }
    return scratch;
}

}  // namespace quasimc
