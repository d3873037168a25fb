#include "geometry/cast/ray_caster.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/checks.h"
#include "base/lazy.h"
#include "base/stop.h"
#include "geometry/cast/cell_walk.h"
#include "geometry/cast/rounding.h"
#include "geometry/cast/sliver_hit.h"
#include "quasimc/mesh.h"

namespace quasimc {

namespace {

/// Whether `hit` is with the triangle that the ray starts on, or with a coplanar one.
bool is_start(const LocalMesh& mesh, const Ray& ray, std::uint32_t self, const Hit& hit) {
    return hit.found() && (hit.triangle == self || is_rounding(mesh, ray, hit.triangle, hit.t));
}

/// The first hit of a ray that starts on `self`: after hits with self, or with coplanar triangles,
/// the ray is restarted.
Hit closest_past(
    const Intersector& engine, const LocalMesh& mesh, const Ray& ray, std::uint32_t self) {
    Hit hit = engine.closest(ray);
    if (is_start(mesh, ray, self, hit)) [[unlikely]] {
        Ray rest = ray;
        do {
            rest.near = std::nextafter(std::max(rest.near, hit.t), INFINITY);
            hit = engine.closest(rest);
        } while (is_start(mesh, ray, self, hit));
    }
    return hit;
}

/// Whether a lamp at `origin` lies in the plane of a triangle, within the single precision of its
/// corners.
bool is_in_plane(const LocalMesh& mesh, const Vec3& origin, std::uint32_t triangle) {
    constexpr double kPrecision = 0x1p-25;
    const Vec3 corner = mesh.vertex(triangle, 0);
    const Vec3 normal = cross(mesh.vertex(triangle, 1) - corner, mesh.vertex(triangle, 2) - corner);
    return std::abs(dot(corner - origin, normal)) <= kPrecision * length(normal);
}

/// The first hit of `ray` that is neither with `self` nor with a triangle in whose plane the lamp
/// at `lamp` lies, and beyond exact.near in double precision. Both rays are equal except for near.
Hit closest_from_lamp(
    const Intersector& engine,
    const LocalMesh& mesh,
    Ray ray,
    const Ray& exact,
    const Vec3& lamp,
    std::uint32_t self) {
    Hit hit = engine.closest(ray);
    while (hit.found() &&
           (is_start(mesh, exact, self, hit) || is_in_plane(mesh, lamp, hit.triangle)))
        [[unlikely]] {
            ray.near = std::nextafter(std::max(ray.near, hit.t), INFINITY);
            hit = engine.closest(ray);
        }
    return hit;
}

/// The hit of a ray from a lamp before `end`, at most kTouch away, in double precision: the ray
/// starts behind the lamp, further than rounding moves it.
Hit touching(
    const Intersector& engine,
    const LocalMesh& mesh,
    const Vec3& lamp,
    const Vec3& direction,
    double end,
    std::uint32_t self) {
    constexpr float kBehind = 4 * kNear;
    const Ray exact{lamp - static_cast<double>(kBehind) * direction, direction, kBehind};
    Ray ray = exact;
    ray.near = kBehind - kNear;
    ray.far = kBehind + static_cast<float>(std::min(end, static_cast<double>(kTouch)));
    Hit hit = closest_from_lamp(engine, mesh, ray, exact, lamp, self);
    hit.t = std::max(0.0F, hit.t - kBehind);
    return hit;
}

/// @param cell  local coordinates
Tile make_tile(const LocalMesh& mesh, const Cell& cell) {
    Tile tile{mesh.bounds, cell.along_x, cell.along_y};
    constexpr Vec3 kMargin{kOverlap, kOverlap, kOverlap};
    tile.box.low -= kMargin;
    tile.box.high += kMargin;
    if (cell.along_x) {
        tile.box.low.x = cell.low_x;
        tile.box.high.x = cell.low_x + cell.size_x;
    }
    if (cell.along_y) {
        tile.box.low.y = cell.low_y;
        tile.box.high.y = cell.low_y + cell.size_y;
    }
    return tile;
}

}  // namespace

struct RayCaster::Impl {
    LocalMesh mesh;
    WrappedGeometry wrapped;  // in a periodic scene: the sources of its triangles
    Cell cell;                // local coordinates
    Lazy<std::vector<Vec3>> outline;
    Tile tile;
    std::unique_ptr<Intersector> engine;
    Lazy<SurfaceCrossings> crossings;

    [[nodiscard]] bool periodic() const { return tile.along_x || tile.along_y; }

    [[nodiscard]] Hit first_hit(const Ray& ray, std::uint32_t self) const {
        return placed(
            ray,
            self == kNoTriangle ? engine->closest(ray) : closest_past(*engine, mesh, ray, self));
    }
    /// The hit, recomputed if it may be on a sliver.
    [[nodiscard]] Hit placed(const Ray& ray, const Hit& hit) const {
        return mesh.has_slivers && hit.found() ? snapped_to_sliver(mesh, ray, hit) : hit;
    }
    void snap_to_slivers(Packet& packet, std::size_t count) const;
    [[nodiscard]] std::uint32_t image_of(std::uint32_t self, double shift_x, double shift_y) const;
    [[nodiscard]] CastHit follow(CellWalk& walk, std::uint32_t self) const;
    [[nodiscard]] bool is_blocked(CellWalk& walk, std::uint32_t self) const;
    void cast_periodic(Packet& packet, std::size_t count, std::array<RayEnd, kPacket>& ends) const;
};

/// The triangle of the mesh that is `self` as seen from the cell `shift` periods away: the image
/// moved back by as much. kNoTriangle if self does not extend into that cell.
std::uint32_t RayCaster::Impl::image_of(std::uint32_t self, double shift_x, double shift_y) const {
    if (self == kNoTriangle || (shift_x == 0 && shift_y == 0)) {
        return self;
    }
    const Vec3 size = tile.box.size();
    const Vec3 corner = mesh.vertex(self, 0);
    const auto is_it = [&](std::uint32_t other) {
        const Vec3 moved = corner - mesh.vertex(other, 0);
        return (!tile.along_x || std::round(moved.x / size.x) == shift_x) &&
               (!tile.along_y || std::round(moved.y / size.y) == shift_y);
    };
    const std::vector<std::uint32_t>& sources = wrapped.source;
    if (self >= sources.size()) {
        return kNoTriangle;  // instances lie in one cell
    }
    // Images of one triangle are adjacent.
    for (std::uint32_t i = self; i-- > 0 && sources[i] == sources[self];) {
        if (is_it(i)) {
            return i;
        }
    }
    for (std::uint32_t i = self + 1; i < sources.size() && sources[i] == sources[self]; ++i) {
        if (is_it(i)) {
            return i;
        }
    }
    return kNoTriangle;
}

/// Follows a ray from cell to cell up to its first hit; consumes the walk.
CastHit RayCaster::Impl::follow(CellWalk& walk, std::uint32_t self) const {
    for (int cells = 0; walk.inside(); ++cells, walk.step()) {
        if (cells == kMaxCells) {
            return {RayEnd::lost, {}};
        }
        const std::uint32_t self_here = image_of(self, walk.shift_x(), walk.shift_y());
        CastHit result{RayEnd::hit, first_hit(walk.piece(), self_here)};
        if (result.hit.found()) {
            result.hit.t += static_cast<float>(walk.start());
            return result;
        }
    }
    return {RayEnd::escaped, {}};
}

bool RayCaster::Impl::is_blocked(CellWalk& walk, std::uint32_t self) const {
    for (int cells = 0; cells < kMaxCells && walk.inside(); ++cells, walk.step()) {
        if (engine->occluded(walk.piece(), image_of(self, walk.shift_x(), walk.shift_y()))) {
            return true;
        }
    }
    return false;
}

RayCaster::RayCaster(
    const std::vector<Triangle>& triangles, const Cell& cell, Accelerator accelerator)
    : RayCaster(std::make_shared<const SceneGeometry>(Mesh(triangles)), cell, accelerator) {}

RayCaster::RayCaster(
    const std::shared_ptr<const SceneGeometry>& geometry,
    const Cell& cell,
    Accelerator accelerator,
    const std::stop_token& stop)
    : RayCaster(geometry, cell, [&](const LocalMesh& mesh) {
          throw_if_stopped(stop);
          return accelerator == Accelerator::embree ? make_embree_intersector(mesh, stop)
                                                    : make_brute_force_intersector(mesh);
      }) {}

RayCaster::RayCaster(
    const std::shared_ptr<const SceneGeometry>& geometry,
    const Cell& cell,
    const MakeIntersector& make)
    : impl_(std::make_unique<Impl>()) {
    EXPECT(!geometry->empty());
    if (cell.periodic()) {
        impl_->wrapped = wrap_into_cell(*geometry, cell);
    }
    impl_->mesh = make_local_mesh(cell.periodic() ? impl_->wrapped.geometry : geometry);
    if (cell.periodic()) {  // corners in double precision are not needed any more
        impl_->mesh.copy_faces();
        impl_->wrapped.geometry.reset();
    }
    impl_->cell = local_cell(impl_->mesh, cell);
    impl_->tile = make_tile(impl_->mesh, impl_->cell);
    impl_->engine = make(impl_->mesh);
}

RayCaster::~RayCaster() = default;
RayCaster::RayCaster(RayCaster&&) noexcept = default;
RayCaster& RayCaster::operator=(RayCaster&&) noexcept = default;

const LocalMesh& RayCaster::mesh() const {
    return impl_->mesh;
}

std::uint32_t RayCaster::source(std::uint32_t i) const {
    return impl_->periodic() ? impl_->wrapped.source_of(i, impl_->mesh.ranges) : i;
}

bool RayCaster::has_own_numbers() const {
    return !impl_->periodic();
}

const Cell& RayCaster::cell() const {
    return impl_->cell;
}

const std::vector<Vec3>& RayCaster::outline() const {
    return impl_->outline.get([this] {
        const bool is_endless = impl_->cell.along_x && impl_->cell.along_y;
        return is_endless ? std::vector<Vec3>() : outline_points(impl_->mesh);
    });
}

const SurfaceCrossings& RayCaster::crossings(const std::stop_token& stop) const {
    return impl_->crossings.get([&] { return find_crossings(impl_->mesh, stop); });
}

CastHit RayCaster::cast(const Vec3& origin, const Vec3& direction, std::uint32_t self) const {
    if (impl_->periodic()) {
        CellWalk walk(impl_->tile, origin, direction);
        return impl_->follow(walk, self);
    }
    Ray ray{origin, direction};
    ray.near = kNear;
    CastHit result{RayEnd::escaped, impl_->first_hit(ray, self)};
    if (result.hit.found()) {
        result.end = RayEnd::hit;
    }
    return result;
}

CastHit RayCaster::cast_from_lamp(const Vec3& origin, const Vec3& direction) const {
    if (impl_->periodic()) {
        return cast(origin, direction, kNoTriangle);
    }
    Ray ray{origin, direction};
    ray.near = kNear;
    const Intersector& engine = *impl_->engine;
    const LocalMesh& mesh = impl_->mesh;
    const Hit far = closest_from_lamp(engine, mesh, ray, ray, origin, kNoTriangle);
    const Hit near = touching(engine, mesh, origin, direction, 4 * kNear, kNoTriangle);
    const Hit& first = near.found() && !(far.found() && far.t < near.t) ? near : far;
    return {first.found() ? RayEnd::hit : RayEnd::escaped, impl_->placed(ray, first)};
}

Hit RayCaster::hit_at_lamp(
    const Vec3& origin, const Vec3& direction, double end, std::uint32_t self) const {
    EXPECT(!impl_->periodic());
    return touching(*impl_->engine, impl_->mesh, origin, direction, end, self);
}

bool RayCaster::occluded(
    const Vec3& origin, const Vec3& direction, std::uint32_t self, double distance) const {
    if (impl_->periodic()) {
        EXPECT(std::isinf(distance));
        CellWalk walk(impl_->tile, origin, direction);
        return impl_->is_blocked(walk, self);
    }
    Ray ray{origin, direction};
    ray.near = kNear;
    ray.far = static_cast<float>(distance);
    return impl_->engine->occluded(ray, self);
}

void RayCaster::cast(Packet& packet, std::size_t count, std::array<RayEnd, kPacket>& ends) const {
    EXPECT(count <= kPacket);
    if (impl_->periodic()) {
        impl_->cast_periodic(packet, count, ends);
        return;
    }
    for (std::size_t i = 0; i < kPacket; ++i) {
        packet.near[i] = 0;
        packet.far[i] = i < count ? INFINITY : -1.0F;
    }
    impl_->engine->closest(packet);
    impl_->snap_to_slivers(packet, count);
    for (std::size_t i = 0; i < count; ++i) {
        ends[i] = packet.triangle[i] == kNoTriangle ? RayEnd::escaped : RayEnd::hit;
    }
}

void RayCaster::Impl::snap_to_slivers(Packet& packet, std::size_t count) const {
    for (std::size_t i = 0; mesh.has_slivers && i < count; ++i) {
        packet.set_hit(i, placed({packet.origin(i), packet.direction(i)}, packet.hit(i)));
    }
}

/// The rays' first pieces form a packet; those that leave the cell sideways continue singly.
void RayCaster::Impl::cast_periodic(
    Packet& packet, std::size_t count, std::array<RayEnd, kPacket>& ends) const {
    std::array<std::optional<CellWalk>, kPacket> walks;
    Packet pieces{};
    for (std::size_t i = 0; i < kPacket; ++i) {
        pieces.near[i] = 0;
        pieces.far[i] = -1;
        if (i >= count) {
            continue;
        }
        walks[i].emplace(tile, packet.origin(i), packet.direction(i));
        if (!walks[i]->inside()) {
            continue;
        }
        const Ray piece = walks[i]->piece();
        pieces.set_origin(i, piece.origin);
        pieces.far[i] = piece.far;
    }
    pieces.direction_x = packet.direction_x;
    pieces.direction_y = packet.direction_y;
    pieces.direction_z = packet.direction_z;
    engine->closest(pieces);
    snap_to_slivers(pieces, count);
    packet.triangle = pieces.triangle;
    packet.u = pieces.u;
    packet.v = pieces.v;
    packet.normal_x = pieces.normal_x;
    packet.normal_y = pieces.normal_y;
    packet.normal_z = pieces.normal_z;
    for (std::size_t i = 0; i < count; ++i) {
        packet.t[i] = pieces.t[i] + static_cast<float>(walks[i]->start());
        if (pieces.triangle[i] != kNoTriangle) {
            ends[i] = RayEnd::hit;
            continue;
        }
        walks[i]->step();
        const CastHit rest = follow(*walks[i], kNoTriangle);
        ends[i] = rest.end;
        if (rest.end == RayEnd::hit) {
            packet.set_hit(i, rest.hit);
        }
    }
}

}  // namespace quasimc
