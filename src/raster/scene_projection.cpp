#include "raster/scene_projection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "base/checks.h"
#include "raster/convex_map.h"

namespace quasimc {

namespace {

/// Margin of cross-sections and boxes around the scene, local units: rays are traced in single
/// precision.
constexpr double kMargin = 0x1p-20;
/// A beam within this sine of a periodic axis, or of the layer's plane, never meets the scene.
constexpr double kGrazing = 0x1p-30;

/// Axes across a beam: s and t span the plane, the beam travels along d.
struct AcrossBeam {
    Vec3 s, t, d;

    /// s is as parallel to the world's x axis as possible (y for beams along x), so that the map of
    /// a beam along an axis runs along the other two.
    explicit AcrossBeam(const Vec3& direction) : d(direction) {
        const Vec3 axis = std::abs(d.x) < 0.9 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
        s = normalized(axis - dot(axis, d) * d);
        t = cross(d, s);
        if (t.x + t.y + t.z < 0) {
            t = -t;
        }
    }
};

/// Radius of the sphere about the local origin that contains all points.
double radius_of(const std::vector<Vec3>& points) {
    double square = 0;
    for (const Vec3& p : points) {
        square = std::max(square, dot(p, p));
    }
    return std::sqrt(square) + kMargin;
}

/// A nearly minimal bounding sphere: the centre moves towards the furthest point in decreasing
/// steps (Badoiu and Clarkson 2003). After n steps the radius is within 1/sqrt(n) of the smallest,
/// in practice within 1/n.
BoundingSphere small_bounding_sphere(const std::vector<Vec3>& points) {
    constexpr int kSteps = 1000;
    BoundingSphere best{{}, radius_of(points)};
    Vec3 center;
    for (int i = 1; i <= kSteps; ++i) {
        const auto distance = [&](const Vec3& p) { return dot(p - center, p - center); };
        const Vec3 furthest = *std::max_element(
            points.begin(), points.end(),
            [&](const Vec3& a, const Vec3& b) { return distance(a) < distance(b); });
        const double radius = std::sqrt(distance(furthest)) + kMargin;
        if (radius < best.radius) {
            best = {center, radius};
        }
        center += (furthest - center) / (i + 1);
    }
    return best;
}

/// A cross-section whose points() calls its own point() directly.
template <typename Derived>
class CrossSectionOf : public BeamCrossSection {
  public:
    void points(std::span<const double> u0, std::span<const double> u1, std::span<Vec3> points)
        const final {
        EXPECT(u0.size() == points.size() && u1.size() == points.size());
        const auto& derived = static_cast<const Derived&>(*this);
        for (std::size_t i = 0; i < points.size(); ++i) {
            points[i] = derived.Derived::point(u0[i], u1[i]);
        }
    }
};

/// Cross-section of a scene of no projected area.
class EmptyCrossSection final : public CrossSectionOf<EmptyCrossSection> {
  public:
    explicit EmptyCrossSection(const Vec3& point) : point_(point) {}
    [[nodiscard]] double area() const override { return 0; }
    [[nodiscard]] Vec3 point(double, double) const override { return point_; }

  private:
    Vec3 point_;
};

class SilhouetteCrossSection final : public CrossSectionOf<SilhouetteCrossSection> {
  public:
    /// @param hull  about `center`, which lies in front of the scene
    SilhouetteCrossSection(
        const AcrossBeam& plane, const Vec3& center, const std::vector<Point2>& hull)
        : s_(plane.s), t_(plane.t), center_(center), map_(hull) {}
    [[nodiscard]] double area() const override { return map_.area(); }
    [[nodiscard]] Vec3 point(double u0, double u1) const override {
        const Point2 p = map_.point(u0, u1);
        return center_ + p.s * s_ + p.t * t_;
    }

  private:
    Vec3 s_, t_, center_;
    ConvexMap map_;
};

/// A parallelogram across which u0 and u1 run, not necessarily perpendicular to the beam.
class ParallelogramCrossSection final : public CrossSectionOf<ParallelogramCrossSection> {
  public:
    ParallelogramCrossSection(const Vec3& corner, const Vec3& side0, const Vec3& side1, double area)
        : corner_(corner), side0_(side0), side1_(side1), area_(area) {}
    [[nodiscard]] double area() const override { return area_; }
    [[nodiscard]] Vec3 point(double u0, double u1) const override {
        return corner_ + u0 * side0_ + u1 * side1_;
    }

  private:
    Vec3 corner_, side0_, side1_;
    double area_;
};

/// The rectangle along s and t around a convex polygon.
std::unique_ptr<BeamCrossSection> rectangle_cross_section(
    const AcrossBeam& plane, double distance, const std::vector<Point2>& hull) {
    Point2 low = hull.front(), high = hull.front();
    for (const Point2& p : hull) {
        low = {std::min(low.s, p.s), std::min(low.t, p.t)};
        high = {std::max(high.s, p.s), std::max(high.t, p.t)};
    }
    const double width = high.s - low.s, height = high.t - low.t;
    const Vec3 corner = -distance * plane.d + low.s * plane.s + low.t * plane.t;
    return std::make_unique<ParallelogramCrossSection>(
        corner, width * plane.s, height * plane.t, width * height);
}

std::unique_ptr<BeamCrossSection> silhouette_cross_section(
    const std::vector<Vec3>& outline, const Vec3& direction) {
    const AcrossBeam plane(direction);
    const double distance = radius_of(outline);
    std::vector<Point2> points;
    points.reserve(outline.size());
    for (const Vec3& p : outline) {
        points.push_back({dot(plane.s, p), dot(plane.t, p)});
    }
    const std::vector<Point2> hull = convex_hull(std::move(points));
    // Edge-on: of no area, except for rounding.
    constexpr double kNoArea = 0x1p-44;
    if (polygon_area(hull) <= kNoArea) {
        return std::make_unique<EmptyCrossSection>(-distance * plane.d);
    }
    std::vector<Point2> grown;
    for (const Point2& p : hull) {
        grown.push_back({p.s - kMargin, p.t - kMargin});
        grown.push_back({p.s - kMargin, p.t + kMargin});
        grown.push_back({p.s + kMargin, p.t - kMargin});
        grown.push_back({p.s + kMargin, p.t + kMargin});
    }
    const std::vector<Point2> border = convex_hull(std::move(grown));
    std::unique_ptr<BeamCrossSection> rectangle = rectangle_cross_section(plane, distance, border);
    // The map of a rectangle is simpler, which outweighs a few more rays that miss the scene.
    constexpr double kNearlyAll = 0.9;
    if (polygon_area(border) > kNearlyAll * rectangle->area()) {
        return rectangle;
    }
    return std::make_unique<SilhouetteCrossSection>(plane, -distance * plane.d, border);
}

/// The disc across the bounding sphere, as a circumscribed polygon of hardly larger area: this map
/// separates fewer neighbours than a polar one.
std::unique_ptr<BeamCrossSection> sphere_cross_section(
    const BoundingSphere& sphere, const Vec3& direction) {
    constexpr int kCorners = 1024;
    const AcrossBeam plane(direction);
    const double radius = sphere.radius / std::cos(std::numbers::pi / kCorners);
    std::vector<Point2> corners;
    for (int i = 0; i < kCorners; ++i) {
        const double angle = 2 * std::numbers::pi * i / kCorners;
        corners.push_back({radius * std::cos(angle), radius * std::sin(angle)});
    }
    return std::make_unique<SilhouetteCrossSection>(
        plane, sphere.center - sphere.radius * plane.d, convex_hull(std::move(corners)));
}

/// The cell of a layer, on the side where the beam comes from.
std::unique_ptr<BeamCrossSection> layer_cross_section(const Bounds& box, const Vec3& direction) {
    if (std::abs(direction.z) < kGrazing) {
        return nullptr;
    }
    const Vec3 size = box.size();
    const Vec3 corner{box.low.x, box.low.y, direction.z < 0 ? box.high.z : box.low.z};
    return std::make_unique<ParallelogramCrossSection>(
        corner, Vec3{size.x, 0, 0}, Vec3{0, size.y, 0}, size.x * size.y * std::abs(direction.z));
}

/// One period of a row along `axis` (x or y): u0 runs along the row, u1 across. A sheared
/// rectangle, on the side of the row where the beam comes from.
std::unique_ptr<BeamCrossSection> row_cross_section(
    const std::vector<Vec3>& outline,
    const Vec3& axis,
    double low,
    double period,
    const Vec3& direction) {
    const Vec3 across = direction - dot(direction, axis) * axis;
    const double sine = length(across);
    if (sine < kGrazing) {
        return nullptr;
    }
    const Vec3 forward = across / sine;
    const Vec3 t = cross(forward, axis);
    double from = INFINITY, to = -INFINITY, back = 0;
    for (const Vec3& p : outline) {
        from = std::min(from, dot(t, p) - kMargin);
        to = std::max(to, dot(t, p) + kMargin);
        back = std::max(back, kMargin - dot(forward, p));
    }
    return std::make_unique<ParallelogramCrossSection>(
        low * axis + from * t - back * forward, period * axis, (to - from) * t,
        period * sine * (to - from));
}

EntryBox make_entry_box(const LocalMesh& mesh, const Cell& local_cell) {
    Bounds box = mesh.bounds;
    constexpr Vec3 kMargins{kMargin, kMargin, kMargin};
    box.low -= kMargins;
    box.high += kMargins;
    if (local_cell.along_x) {
        box.low.x = local_cell.low_x;
        box.high.x = local_cell.low_x + local_cell.size_x;
    }
    if (local_cell.along_y) {
        box.low.y = local_cell.low_y;
        box.high.y = local_cell.low_y + local_cell.size_y;
    }
    const Vec3 size = box.size();
    return {
        box,
        {local_cell.along_x ? 0 : size.y * size.z, local_cell.along_y ? 0 : size.x * size.z,
         size.x * size.y}};
}

}  // namespace

SceneProjection::SceneProjection(const LocalMesh& mesh, const Cell& cell, StartArea start_area)
    : SceneProjection(
          mesh,
          local_cell(mesh, cell),
          cell.along_x && cell.along_y ? std::vector<Vec3>() : outline_points(mesh),
          start_area) {}

SceneProjection::SceneProjection(const RayCaster& caster, StartArea start_area)
    : SceneProjection(caster.mesh(), caster.cell(), caster.outline(), start_area) {}

/// @param cell  local coordinates
SceneProjection::SceneProjection(
    const LocalMesh& mesh, const Cell& cell, std::vector<Vec3> outline, StartArea start_area)
    : outline_(std::move(outline)),
      cell_(cell),
      start_area_(start_area),
      box_(make_entry_box(mesh, cell)),
      origin_(mesh.origin),
      scale_(mesh.scale) {
    if (!cell.periodic() && start_area == StartArea::bounding_sphere) {
        bounding_sphere_ = small_bounding_sphere(outline_);
    }
}

std::unique_ptr<BeamCrossSection> SceneProjection::cross_section(const Vec3& direction) const {
    if (cell_.along_x && cell_.along_y) {
        return layer_cross_section(box_.bounds, direction);
    }
    if (cell_.along_x) {
        return row_cross_section(outline_, {1, 0, 0}, cell_.low_x, cell_.size_x, direction);
    }
    if (cell_.along_y) {
        return row_cross_section(outline_, {0, 1, 0}, cell_.low_y, cell_.size_y, direction);
    }
    if (start_area_ == StartArea::bounding_sphere) {
        return sphere_cross_section(bounding_sphere_, direction);
    }
    return silhouette_cross_section(outline_, direction);
}

}  // namespace quasimc
