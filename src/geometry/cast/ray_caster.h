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

/// Where a ray went: to a hit, out of the scene, or, in a periodic scene, past `kMaxCells` cells
/// (a ray so nearly horizontal in an empty layer that it would never end).
enum class RayEnd { hit, escaped, lost };

struct CastHit {
    RayEnd end = RayEnd::escaped;
    Hit hit;  ///< set when end == hit; triangle counts the mesh of the caster
};

/// Rays through the scene as it is meant: past the triangle they start on, and through the images
/// of a periodic cell. Owns mesh and intersector; const after construction.
class RayCaster {
  public:
    /// @param triangles  the scene, world coordinates; at least one
    RayCaster(const std::vector<Triangle>& triangles, const Cell& cell, Accelerator accelerator);
    /// The same of a scene, which is kept.
    /// @throws StopRequested  if a stop is requested before it is ready
    RayCaster(
        const std::shared_ptr<const SceneGeometry>& geometry,
        const Cell& cell,
        Accelerator accelerator,
        const std::stop_token& stop = {});
    /// The same with an engine of the caller's.
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
    /// The input triangle that triangle `i` of the mesh is (an image of).
    [[nodiscard]] std::uint32_t source(std::uint32_t i) const;
    /// Whether each triangle of the mesh is the input triangle of the same number.
    [[nodiscard]] bool has_own_numbers() const;
    /// The cell in local coordinates.
    [[nodiscard]] const Cell& cell() const;
    /// Points whose convex hull holds the scene, local coordinates; none of a scene periodic along
    /// x and y. Looked for when they are first asked for.
    [[nodiscard]] const std::vector<Vec3>& outline() const;
    /// Where triangles of the mesh cross; looked for when it is first asked for.
    /// @throws StopRequested  if a stop is requested before they are found
    [[nodiscard]] const SurfaceCrossings& crossings(const std::stop_token& stop = {}) const;

    /// The first hit of a ray that leaves `self` (or kNoTriangle) from `origin`, local coordinates.
    /// `self` is never hit by its own ray. In a periodic scene the origin may lie in any image of
    /// the cell.
    [[nodiscard]] CastHit cast(const Vec3& origin, const Vec3& direction, std::uint32_t self) const;

    /// Whether anything lies between `origin` (on triangle `self`) and a point at `distance` (local
    /// units). Rays lost count as free. In a periodic scene `distance` must be infinite.
    [[nodiscard]] bool occluded(
        const Vec3& origin,
        const Vec3& direction,
        std::uint32_t self,
        double distance = std::numeric_limits<double>::infinity()) const;

    /// The first hit of a ray that leaves a lamp at `origin`, which may lie as near to a surface as
    /// single precision can tell; one in whose plane it lies is not met.
    [[nodiscard]] CastHit cast_from_lamp(const Vec3& origin, const Vec3& direction) const;

    /// What such a ray meets within kTouch of the lamp and before `end`, other than `self`. Not in
    /// periodic scenes.
    [[nodiscard]] Hit hit_at_lamp(
        const Vec3& origin, const Vec3& direction, double end, std::uint32_t self) const;

    /// First hits of sixteen rays close to each other and alike in direction, which start outside
    /// the scene: `packet` gives origins and directions (near and far are set here), and takes the
    /// hits. `ends` says how each ended. Idle lanes are marked by `count`: lanes [count, 16) are
    /// not traced.
    void cast(Packet& packet, std::size_t count, std::array<RayEnd, kPacket>& ends) const;

    static constexpr int kMaxCells = 100000;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace quasimc
