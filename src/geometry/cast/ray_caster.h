#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "geometry/cast/intersector.h"
#include "geometry/mesh/cell.h"
#include "geometry/mesh/crossings.h"

namespace quasimc {

/// The end of a ray: at a hit, outside the scene, or, in a periodic scene, after `kMaxCells` cells
/// (a nearly horizontal ray in an empty layer would never end).
enum class RayEnd { hit, escaped, lost };

struct CastHit {
    RayEnd end = RayEnd::escaped;
    Hit hit;  ///< set when end == hit; triangle is an index in the caster's mesh
};

/// Casts rays through a scene: they ignore the triangle that they start on, and see the images of a
/// periodic cell. Owns mesh and intersector; const after construction.
class RayCaster {
  public:
    /// @param triangles  the scene, world coordinates; at least one
    RayCaster(const std::vector<Triangle>& triangles, const Cell& cell, Accelerator accelerator);
    /// Constructs from a scene, which it shares.
    /// @throws StopRequested  if a stop is requested before it is ready
    RayCaster(
        const std::shared_ptr<const SceneGeometry>& geometry,
        const Cell& cell,
        Accelerator accelerator,
        const std::stop_token& stop = {});
    /// Constructs with an intersector of the caller.
    using MakeIntersector = std::function<std::unique_ptr<Intersector>(const LocalMesh&)>;
    RayCaster(
        const std::shared_ptr<const SceneGeometry>& geometry,
        const Cell& cell,
        const MakeIntersector& make);
    ~RayCaster();
    RayCaster(RayCaster&&) noexcept;
    RayCaster& operator=(RayCaster&&) noexcept;
    RayCaster(const RayCaster&) = delete;
    RayCaster& operator=(const RayCaster&) = delete;

    [[nodiscard]] const LocalMesh& mesh() const;
    /// The input triangle of which triangle `i` of the mesh is an image.
    [[nodiscard]] std::uint32_t source(std::uint32_t i) const;
    /// Whether each triangle of the mesh has the index of its input triangle.
    [[nodiscard]] bool has_own_numbers() const;
    /// The cell in local coordinates.
    [[nodiscard]] const Cell& cell() const;
    /// Points whose convex hull contains the scene, local coordinates; none in a scene periodic
    /// along x and y. Computed on first use.
    [[nodiscard]] const std::vector<Vec3>& outline() const;
    /// Crossings of triangles of the mesh; computed on first use.
    /// @throws StopRequested  if a stop is requested before
    [[nodiscard]] const SurfaceCrossings& crossings(const std::stop_token& stop = {}) const;

    /// The first hit of a ray that leaves `self` (or kNoTriangle) from `origin`, local coordinates.
    /// `self` is never hit by its own ray. In a periodic scene the origin may lie in any image of
    /// the cell.
    [[nodiscard]] CastHit cast(const Vec3& origin, const Vec3& direction, std::uint32_t self) const;

    /// Whether any surface lies between `origin` (on triangle `self`) and a point at `distance`
    /// (local units). Lost rays count as unoccluded. In a periodic scene `distance` must be
    /// infinite.
    [[nodiscard]] bool occluded(
        const Vec3& origin,
        const Vec3& direction,
        std::uint32_t self,
        double distance = std::numeric_limits<double>::infinity()) const;

    /// The first hit of a ray that leaves a lamp at `origin`, which may be as close to a surface as
    /// single precision allows; surfaces in whose plane it lies are ignored.
    [[nodiscard]] CastHit cast_from_lamp(const Vec3& origin, const Vec3& direction) const;

    /// The hit of such a ray within kTouch of the lamp and before `end`, except with `self`. Not in
    /// periodic scenes.
    [[nodiscard]] Hit hit_at_lamp(
        const Vec3& origin, const Vec3& direction, double end, std::uint32_t self) const;

    /// First hits of sixteen rays with nearby origins outside the scene and similar directions:
    /// `packet` holds origins and directions (near and far are set here), and receives the hits.
    /// `ends` receives how each ray ended. Lanes [count, 16) are inactive.
    void cast(Packet& packet, std::size_t count, std::array<RayEnd, kPacket>& ends) const;

    static constexpr int kMaxCells = 100000;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quasimc
