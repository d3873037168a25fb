#include "geometry/mesh/cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/bounds.h"
#include "base/checks.h"
#include "base/input_error.h"

namespace quasimc {

namespace {

/// An interval of shifts, counted in periods.
struct Shifts {
    double first = 0, last = 0;

    [[nodiscard]] double count() const { return std::max(0.0, last - first + 1); }
};

/// The cell, a little enlarged: what the images must touch to be kept.
class Frame2 {
  public:
    Frame2(const Cell& cell, double margin)
        : cell_(cell),
          low_x_(cell.low_x - margin),
          low_y_(cell.low_y - margin),
          high_x_(cell.low_x + cell.size_x + margin),
          high_y_(cell.low_y + cell.size_y + margin) {}

    [[nodiscard]] Shifts along_x(const Bounds& b) const {
        return cell_.along_x ? shifts(b.low.x, b.high.x, low_x_, high_x_, cell_.size_x) : Shifts{};
    }
    [[nodiscard]] Shifts along_y(const Bounds& b) const {
        return cell_.along_y ? shifts(b.low.y, b.high.y, low_y_, high_y_, cell_.size_y) : Shifts{};
    }

    /// The moves by whole periods that make the triangle's bounds touch the cell.
    [[nodiscard]] std::vector<Vec3> shifts_of(const Triangle& t) const {
        const Bounds b = bounds_of(t);
        const Shifts x = along_x(b), y = along_y(b);
        const auto columns = static_cast<std::int64_t>(x.count());
        const auto rows = static_cast<std::int64_t>(y.count());
        std::vector<Vec3> shifts;
        shifts.reserve(static_cast<std::size_t>(columns * rows));
        for (std::int64_t i = 0; i < columns * rows; ++i) {
            const std::int64_t row = i / columns, column = i % columns;
            shifts.push_back(
                {(x.first + static_cast<double>(column)) * cell_.size_x,
                 (y.first + static_cast<double>(row)) * cell_.size_y, 0});
        }
        return shifts;
    }

    /// Whether the triangle, whose bounds are known to touch the cell, touches it itself: no side
    /// of the triangle, seen from above, has the cell wholly outside (the theorem of the separating
    /// axis).
    [[nodiscard]] bool touches(const Triangle& t) const {
        if (!cell_.along_x || !cell_.along_y) {
            return true;  // of a strip, the bounds say all
        }
        for (int i = 0; i < 3; ++i) {
            const Vec3& a = t[i];
            const Vec3 side = t[(i + 1) % 3] - a;
            if (separates({-side.y, side.x, 0}, t) || separates({side.y, -side.x, 0}, t)) {
                return false;
            }
        }
        return true;
    }

  private:
    static Shifts shifts(double from, double to, double low, double high, double size) {
        return {std::ceil((low - to) / size), std::floor((high - from) / size)};
    }

    /// Whether all of the triangle lies further along `axis` than all of the cell.
    [[nodiscard]] bool separates(const Vec3& axis, const Triangle& t) const {
        const double cell_reach =
            axis.x * (axis.x > 0 ? high_x_ : low_x_) + axis.y * (axis.y > 0 ? high_y_ : low_y_);
        return dot(axis, t[0]) > cell_reach && dot(axis, t[1]) > cell_reach &&
               dot(axis, t[2]) > cell_reach;
    }

    Cell cell_;
    double low_x_, low_y_, high_x_, high_y_;
};

/// A few rounding errors of the local coordinates that the images will be traced in: their unit is
/// at most the largest extent of the scene.
double rounding_margin(const std::vector<Triangle>& triangles, const Cell& cell) {
    Bounds all;
    Vec3 largest;
    for (const Triangle& t : triangles) {
        const Bounds b = bounds_of(t);
        all.add(b.low);
        all.add(b.high);
        const Vec3 size = b.size();
        largest = {std::max(largest.x, size.x), std::max(largest.y, size.y), 0};
    }
    const double extent_x = cell.along_x ? cell.size_x + 2 * largest.x : all.size().x;
    const double extent_y = cell.along_y ? cell.size_y + 2 * largest.y : all.size().y;
    const double extent = std::max({extent_x, extent_y, all.size().z});
    const double place = std::max(
        {std::abs(all.low.x), std::abs(all.high.x), std::abs(all.low.y), std::abs(all.high.y),
         std::abs(cell.low_x) + cell.size_x, std::abs(cell.low_y) + cell.size_y});
    constexpr double kOfExtent = 0x1p-18, kOfPlace = 0x1p-48;
    return kOfExtent * extent + kOfPlace * place;
}

/// Refuses scenes that would make more images than any sensible one: more than a million and more
/// than eight for each triangle.
void refuse_too_many(const std::vector<Triangle>& triangles, const Frame2& frame) {
    double total = 0, most = 0;
    std::size_t worst = 0;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Bounds b = bounds_of(triangles[i]);
        const double count = frame.along_x(b).count() * frame.along_y(b).count();
        total += count;
        if (count > most) {
            most = count;
            worst = i;
        }
    }
    if (total > std::max(1e6, 8 * static_cast<double>(triangles.size()))) {
        throw InputError(
            {{"triangle " + std::to_string(worst + 1),
              "it reaches over too many cells of the periodic scene",
              "it would appear about " + std::to_string(std::llround(std::min(most, 1e18))) +
                  " times in the cell",
              "make the cell larger, or the triangle smaller"}});
    }
}

}  // namespace

WrappedTriangles wrap_into_cell(const std::vector<Triangle>& triangles, const Cell& cell) {
    EXPECT(cell.periodic() && cell.size_x > 0 && cell.size_y > 0);
    const Frame2 frame(cell, rounding_margin(triangles, cell));
    refuse_too_many(triangles, frame);

    WrappedTriangles wrapped;
    wrapped.triangles.reserve(triangles.size());
    wrapped.source.reserve(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const Vec3& shift : frame.shifts_of(triangles[i])) {
            const auto& [a, b, c] = triangles[i];
            const Triangle image{a + shift, b + shift, c + shift};
            if (frame.touches(image)) {
                wrapped.triangles.push_back(image);
                wrapped.source.push_back(static_cast<std::uint32_t>(i));
            }
        }
    }
    return wrapped;
}

}  // namespace quasimc
