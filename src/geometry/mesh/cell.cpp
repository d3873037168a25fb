#include "geometry/mesh/cell.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "base/checks.h"
#include "quasimc/error.h"
#include "quasimc/mesh.h"

namespace quasimc {

namespace {

/// An interval of shifts, counted in periods.
struct Shifts {
    double first = 0, last = 0;

    [[nodiscard]] double count() const { return std::max(0.0, last - first + 1); }
};

/// The cell, slightly enlarged: images that do not touch it are dropped.
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

    /// The translations by whole periods for which the triangle's bounds touch the cell.
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

    /// Whether the triangle, whose bounds touch the cell, touches it itself: no side of the
    /// triangle, in plan view, has the whole cell outside (separating axis theorem).
    [[nodiscard]] bool touches(const Triangle& t) const {
        if (!cell_.along_x || !cell_.along_y) {
            return true;  // for a strip, the bounds are sufficient
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

    /// Whether all of the triangle lies beyond all of the cell along `axis`.
    [[nodiscard]] bool separates(const Vec3& axis, const Triangle& t) const {
        const double cell_reach =
            axis.x * (axis.x > 0 ? high_x_ : low_x_) + axis.y * (axis.y > 0 ? high_y_ : low_y_);
        return dot(axis, t[0]) > cell_reach && dot(axis, t[1]) > cell_reach &&
               dot(axis, t[2]) > cell_reach;
    }

    Cell cell_;
    double low_x_, low_y_, high_x_, high_y_;
};

/// A few rounding errors of the local coordinates of the images: their unit is at most the largest
/// extent of the scene.
template <typename Triangles>
double rounding_margin(const Triangles& triangles, const Cell& cell) {
    Bounds all;
    Vec3 largest;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Bounds b = bounds_of(triangles[i]);
        all.add(b.low);
        all.add(b.high);
        const Vec3 size = b.size();
        largest = {std::max(largest.x, size.x), std::max(largest.y, size.y), 0};
    }
    const double extent_x = cell.along_x ? cell.size_x + 2 * largest.x : all.size().x;
    const double extent_y = cell.along_y ? cell.size_y + 2 * largest.y : all.size().y;
    const double extent = std::max({extent_x, extent_y, all.size().z});
    const double position = std::max(
        {std::abs(all.low.x), std::abs(all.high.x), std::abs(all.low.y), std::abs(all.high.y),
         std::abs(cell.low_x) + cell.size_x, std::abs(cell.low_y) + cell.size_y});
    constexpr double kOfExtent = 0x1p-18, kOfPosition = 0x1p-48;
    return kOfExtent * extent + kOfPosition * position;
}

/// Rejects scenes with an excessive number of images: more than a million and more than eight for
/// each triangle.
template <typename Triangles>
void refuse_too_many(const Triangles& triangles, const Frame2& frame) {
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
              "it extends over too many cells of the periodic scene",
              "it would appear about " + std::to_string(std::llround(std::min(most, 1e18))) +
                  " times in the cell",
              "make the cell larger, or the triangle smaller"}});
    }
}

/// Adds the images of triangles to `images`, and their input triangles to `source`.
template <typename Triangles, typename Images>
void add_images(
    const Triangles& triangles,
    const Cell& cell,
    Images& images,
    std::vector<std::uint32_t>& source) {
    const Frame2 frame(cell, rounding_margin(triangles, cell));
    refuse_too_many(triangles, frame);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle triangle = triangles[i];
        for (const Vec3& shift : frame.shifts_of(triangle)) {
            const auto& [a, b, c] = triangle;
            const Triangle image{a + shift, b + shift, c + shift};
            if (frame.touches(image)) {
                images.push_back(image);
                source.push_back(static_cast<std::uint32_t>(i));
            }
        }
    }
}

/// The translation by whole periods along one axis that moves [from, to] into the cell, away from
/// its borders by far more than rounding. Nothing if there is none.
std::optional<double> move_inside(double from, double to, double low, double size) {
    const double shift = -std::floor((0.5 * (from + to) - low) / size) * size;
    constexpr double kOfSize = 0x1p-14, kOfPosition = 0x1p-46;
    const double margin =
        kOfSize * size + kOfPosition * std::max({std::abs(from), std::abs(to), std::abs(low)});
    const bool fits = from + shift > low + margin && to + shift < low + size - margin;
    return fits ? std::optional(shift) : std::nullopt;
}

/// The instance moved into the cell; nothing if it extends over a border.
std::optional<Instance> moved_inside(
    const Instance& instance, const Bounds& bounds, const Cell& cell) {
    std::optional<double> x = 0, y = 0;
    if (cell.along_x) {
        x = move_inside(bounds.low.x, bounds.high.x, cell.low_x, cell.size_x);
    }
    if (cell.along_y) {
        y = move_inside(bounds.low.y, bounds.high.y, cell.low_y, cell.size_y);
    }
    if (!x || !y) {
        return std::nullopt;
    }
    Instance moved = instance;
    moved.transform.shift += Vec3{*x, *y, 0};
    return moved;
}

}  // namespace

WrappedTriangles wrap_into_cell(const std::vector<Triangle>& triangles, const Cell& cell) {
    EXPECT(cell.periodic() && cell.size_x > 0 && cell.size_y > 0);
    WrappedTriangles wrapped;
    wrapped.triangles.reserve(triangles.size());
    wrapped.source.reserve(triangles.size());
    add_images(triangles, cell, wrapped.triangles, wrapped.source);
    return wrapped;
}

WrappedGeometry wrap_into_cell(const SceneGeometry& geometry, const Cell& cell) {
    EXPECT(cell.periodic() && cell.size_x > 0 && cell.size_y > 0);
    std::vector<std::uint32_t> sources, instance_sources;
    Mesh images;
    if (geometry.instances().empty()) {
        images.vertices.reserve(geometry.mesh().vertices.size());
        images.faces.reserve(geometry.size());
        sources.reserve(geometry.size());
        add_images(geometry.mesh(), cell, images, sources);
        return {std::make_shared<const SceneGeometry>(std::move(images)), std::move(sources), {}};
    }
    // Former triangles of instances, and their indices in the input.
    std::vector<Triangle> loose(
        geometry.begin(), SceneGeometry::Iterator(geometry, geometry.mesh().size()));
    std::vector<std::uint32_t> numbers(loose.size());
    std::iota(numbers.begin(), numbers.end(), 0U);
    std::vector<Instance> kept;
    const std::vector<Bounds> bounds = instance_bounds(geometry.instances());
    for (std::size_t i = 0; i < geometry.instances().size(); ++i) {
        const Instance& instance = geometry.instances()[i];
        const std::uint32_t first = geometry.ranges().first(i);
        if (const auto moved = moved_inside(instance, bounds[i], cell)) {
            kept.push_back(*moved);
            instance_sources.push_back(first);
            continue;
        }
        for (std::uint32_t k = 0; k < instance.mesh->size(); ++k) {
            loose.push_back(instance.triangle(k));
            numbers.push_back(first + k);
        }
    }
    add_images(loose, cell, images, sources);
    for (std::uint32_t& source : sources) {
        source = numbers[source];
    }
    return {
        std::make_shared<const SceneGeometry>(std::move(images), std::move(kept)),
        std::move(sources), std::move(instance_sources)};
}

}  // namespace quasimc
