#pragma once

#include <cmath>
#include <memory>
#include <span>
#include <vector>

#include "base/vec3.h"
#include "geometry/cast/ray_caster.h"
#include "geometry/mesh/cell.h"
#include "geometry/mesh/local_mesh.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A region of a plane across a beam that every ray of the beam through the scene crosses (in a
/// periodic scene: one image of every such ray).
class BeamCrossSection {
  public:
    virtual ~BeamCrossSection() = default;
    /// Area perpendicular to the beam, local units squared.
    [[nodiscard]] virtual double area() const = 0;
    /// A point of the region, outside the scene on the beam's side: an area-preserving, continuous
    /// map of the unit square. Local coordinates.
    [[nodiscard]] virtual Vec3 point(double u0, double u1) const = 0;
    /// point() of several points of the unit square, faster.
    virtual void points(
        std::span<const double> u0, std::span<const double> u1, std::span<Vec3> points) const = 0;
};

/// The faces of the box around the scene where distant light enters. In a periodic scene only the
/// faces across the open axes count: those of the layer (x and y periodic: top and bottom).
struct EntryBox {
    Bounds bounds;   ///< local coordinates; along periodic axes: the cell
    Vec3 face_area;  ///< area of the faces across x, y, z; 0 where the scene is periodic along that
                     ///< axis

    /// Projected area of the scene's box along direction `d` (unit).
    [[nodiscard]] double projected_area(const Vec3& d) const {
        return face_area.x * std::abs(d.x) + face_area.y * std::abs(d.y) +
               face_area.z * std::abs(d.z);
    }
};

/// A sphere in local coordinates.
struct BoundingSphere {
    Vec3 center;
    double radius = 0;
};

/// Bounds a scene for light from infinity.
class SceneProjection {
  public:
    /// @param mesh  the scene in local coordinates
    /// @param cell  world coordinates, as given to the RayCaster of the same mesh
    SceneProjection(const LocalMesh& mesh, const Cell& cell, StartArea start_area);
    /// Constructs from a scene that is ready to trace, and reuses its outline.
    SceneProjection(const RayCaster& caster, StartArea start_area);

    /// The cross-section of a beam that travels along `direction` (unit). Null if it never meets a
    /// periodic scene: the beam runs along a periodic axis, or in the layer's plane.
    ///
    /// Open scenes: as `start_area` specifies; of area 0 if the scene is edge-on. Periodic along x
    /// and y: the cell, on the side where the beam comes from. Periodic along one axis: one period
    /// of the projected strip of the row of cells.
    [[nodiscard]] std::unique_ptr<BeamCrossSection> cross_section(const Vec3& direction) const;

    /// Points whose convex hull contains the scene; empty in a scene periodic along x and y.
    [[nodiscard]] const std::vector<Vec3>& outline() const { return outline_; }
    [[nodiscard]] const EntryBox& entry_box() const { return box_; }
    /// Square world units per square local unit.
    [[nodiscard]] double world_area() const { return 1 / (scale_ * scale_); }
    /// Local units per world unit.
    [[nodiscard]] double scale() const { return scale_; }
    [[nodiscard]] Vec3 to_local(const Vec3& world) const { return scale_ * (world - origin_); }
    /// The periodic axes of the scene; local coordinates.
    [[nodiscard]] const Cell& cell() const { return cell_; }

  private:
    SceneProjection(
        const LocalMesh& mesh, const Cell& cell, std::vector<Vec3> outline, StartArea start_area);

    std::vector<Vec3> outline_;       // points that cross-sections must cover; none in a layer
    BoundingSphere bounding_sphere_;  // contains the scene; only for StartArea::bounding_sphere
    Cell cell_;                       // local coordinates
    StartArea start_area_;
    EntryBox box_;
    Vec3 origin_;  // of the local coordinates, in the world
    double scale_ = 1;
};

}  // namespace quasimc
