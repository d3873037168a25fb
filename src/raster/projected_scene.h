#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <utility>

#include "base/stop.h"
#include "base/vec3.h"
#include "geometry/mesh/cell.h"
#include "geometry/mesh/local_mesh.h"

namespace quasimc {

/// Role of a triangle for visibility.
enum class VisibilityRole : std::uint8_t {
    opaque,
    sensor,   ///< receives light and transmits it undisturbed
    omitted,  ///< another image of the same triangle represents it (RayCaster::source)
};

/// The point v0 + u (v1 - v0) + v (v2 - v0) of a triangle.
struct Barycentric {
    float u = 0, v = 0;
};

/// A triangle on the plane of a beam: coordinates x and y and depth z of its corners.
struct ProjectedTriangle {
    double x[3], y[3], z[3];

    /// Its corners, the lowest in y first.
    [[nodiscard]] std::array<int, 3> upwards() const {
        int low = 0;
        int middle = 1;
        int high = 2;
        // Branchless: the order is unpredictable.
        const auto order = [this](int& i, int& j) {
            const bool swap = y[j] < y[i];
            const int smaller = swap ? j : i;
            j = swap ? i : j;
            i = smaller;
        };
        order(low, middle);
        order(middle, high);
        order(low, middle);
        return {low, middle, high};
    }
    /// The point of the triangle that projects to (x, y). Its projection must have an area.
    [[nodiscard]] Barycentric barycentric(double at_x, double at_y) const;
};

/// One coordinate of the plane of a beam: point p has the value dot(along, p) + offset.
struct BeamAxis {
    Vec3 along;
    double offset = 0;
};

struct StoredBlock;

/// A scene as input of projections.
struct ProjectedScene {
    const LocalMesh* mesh = nullptr;
    Cell cell;                                   ///< local coordinates
    std::span<const VisibilityRole> roles = {};  ///< by triangle of the mesh; empty: all are opaque
    std::span<const Vec3> outline = {};  ///< points whose hull contains the scene; empty: vertices
    /// Checked while a beam is prepared, which takes long for a million triangles.
    const std::stop_token* stop = nullptr;
    std::span<const StoredBlock> blocks = {};  ///< stored_blocks(), where they are worthwhile

    /// @throws StopRequested  if a stop was requested
    void check_stop() const {
        if (stop != nullptr) {
            throw_if_stopped(*stop);
        }
    }

    [[nodiscard]] VisibilityRole role(std::uint32_t triangle) const {
        return roles.empty() ? VisibilityRole::opaque : roles[triangle];
    }
    /// dot(unit normal of the upper side of a triangle, direction), 0 if it has no area.
    [[nodiscard]] double cosine(std::uint32_t triangle, const Vec3& direction) const;
    /// The least and the largest dot(along, p) of the points of a triangle.
    [[nodiscard]] std::pair<double, double> extent(std::uint32_t triangle, const Vec3& along) const;
    [[nodiscard]] ProjectedTriangle seen(
        std::uint32_t triangle, const BeamAxis& x, const BeamAxis& y, const BeamAxis& z) const;
};

/// Whether s and t run along the periods of a scene, or t slantwise, so that structures aligned
/// with the cell do not waste lines.
enum class AlongPeriods { straight, slanted };

/// The plane onto which a beam projects a scene: points of one ray have the same (s, t), and depth
/// grows along the beam. In an open scene s and t are perpendicular to the beam and rotated by a
/// chosen angle. In a periodic one the projection is periodic along s, t or both, so that one
/// period contains an image of every ray.
struct ProjectionPlane {
    /// @param scene  with at least one triangle
    /// @param direction  unit, in which the light travels; in a periodic scene one that has a
    /// cross-section (SceneProjection::cross_section)
    /// @param rotation  0..1 for half a turn of s and t; in a periodic scene it selects one of the
    /// directions in which lines of equal t close, or run across a row
    /// @param periods  direction of s and t in a periodic scene
    ProjectionPlane(
        const ProjectedScene& scene, const Vec3& direction, double rotation, AlongPeriods periods);

    Vec3 s, t, depth;             ///< coordinates of a point p: dot(s, p), dot(t, p), dot(depth, p)
    double area = 1;              ///< across the beam, per unit of s and t
    double low_s = 0, low_t = 0;  ///< lower end of the scene, or of a period
    double size_s = 0, size_t = 0;
    bool repeats_s = false, repeats_t = false;

  private:
    void set_layer(const Cell& cell, const Vec3& direction, double rotation, AlongPeriods periods);
    void set_row(
        const ProjectedScene& scene, const Vec3& direction, double rotation, AlongPeriods periods);
};

/// The x range of the part of a triangle with y from `low` to `high`; none if it is empty.
[[nodiscard]] std::optional<std::pair<double, double>> extent_within(
    const double (&x)[3], const double (&y)[3], double low, double high);

/// At most this number of periods to either side are counted, like the cells that a ray may cross
/// (RayCaster::kMaxCells).
inline constexpr double kMaxPeriods = 100000;
/// Rounding error of positions, in periods.
inline constexpr double kPeriodMargin = 1e-9;

/// The periods that a segment overlaps, relative to the first.
struct Periods {
    std::int32_t first = 0, last = 0;
};
/// @param low, high  range of the segment, from the beginning of the first period
/// @param period  > 0
[[nodiscard]] Periods periods_of(double low, double high, double period, bool repeats);

/// The periods of x that a triangle overlaps within one period of y; the last before the first if
/// none. At low incidence a projected triangle is long and slanted, and misses most of the periods
/// in its bounding box.
[[nodiscard]] Periods periods_in_row(
    const ProjectedTriangle& seen,
    std::int32_t period_y,
    double size_y,
    double size_x,
    bool repeats_x);

}  // namespace quasimc
