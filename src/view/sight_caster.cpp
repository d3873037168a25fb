#include "view/sight_caster.h"

#include <algorithm>
#include <limits>

#include "base/checks.h"

namespace quasimc {
namespace {

/// The part of a line of sight from which the scene is looked at.
struct Reach {
    double near = 0, far = std::numeric_limits<double>::infinity();

    /// Cuts off where rate * t > room.
    void cut(double rate, double room) {
        if (rate > 0) {
            far = std::min(far, room / rate);
        } else if (rate < 0) {
            near = std::max(near, room / rate);
        } else if (room < 0) {
            far = -1;
        }
    }
};

Reach reach_of(
    const Camera::SightLine& line, const Bounds& box, const std::vector<CutPlane>& cuts) {
    Reach reach;
    const Vec3 &o = line.origin, &d = line.direction;
    reach.cut(d.x, box.high.x - o.x);
    reach.cut(-d.x, o.x - box.low.x);
    reach.cut(d.y, box.high.y - o.y);
    reach.cut(-d.y, o.y - box.low.y);
    reach.cut(d.z, box.high.z - o.z);
    reach.cut(-d.z, o.z - box.low.z);
    for (const CutPlane& plane : cuts) {
        reach.cut(dot(plane.normal, d), plane.offset - dot(plane.normal, o));
    }
    return reach;
}

/// A line of sight of a packet: which place it belongs to, and how long it is, local units.
struct SightInBox {
    std::size_t place = 0;
    Vec3 direction;
    double length = 0;
};

}  // namespace

SightCaster::SightCaster(
    const Scene& scene, const Camera& camera, const std::vector<CutPlane>& cuts)
    : scene_(scene),
      camera_(camera),
      cuts_(cuts),
      caster_(scene.shared_triangles(), Cell{}, Engine::embree),
      box_(scene.bounds()) {
    // Lines of sight that run in a face of the box see what lies in it.
    const Vec3 more = 1e-6 * scene.bounds().radius() * Vec3{1, 1, 1};
    box_.add(box_.low - more);
    box_.add(box_.high + more);
}

std::optional<SeenHit> SightCaster::look(const PixelPlace& place) const {
    const Camera::SightLine line = camera_.through(place);
    const Reach reach = reach_of(line, box_, cuts_);
    if (!(reach.near < reach.far)) {
        return std::nullopt;
    }
    const LocalMesh& mesh = caster_.mesh();
    const Vec3 start = mesh.to_local(line.origin + reach.near * line.direction);
    const CastHit cast = caster_.cast(start, line.direction, kNoTriangle);
    const double length = (reach.far - reach.near) * mesh.scale;
    if (cast.end != RayEnd::hit || double{cast.hit.t} > length) {
        return std::nullopt;
    }
    return SeenHit{
        cast.hit, scene_.region_of(caster_.source(cast.hit.triangle)).value, line.direction};
}

std::array<std::optional<SeenHit>, kPacket> SightCaster::look(
    std::span<const PixelPlace> places) const {
    EXPECT(places.size() <= kPacket);
    const LocalMesh& mesh = caster_.mesh();
    Packet packet{};
    std::array<SightInBox, kPacket> sights;
    std::size_t count = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        const Camera::SightLine line = camera_.through(places[i]);
        const Reach reach = reach_of(line, box_, cuts_);
        if (!(reach.near < reach.far)) {
            continue;
        }
        const Vec3 start = mesh.to_local(line.origin + reach.near * line.direction);
        packet.origin_x[count] = static_cast<float>(start.x);
        packet.origin_y[count] = static_cast<float>(start.y);
        packet.origin_z[count] = static_cast<float>(start.z);
        packet.direction_x[count] = static_cast<float>(line.direction.x);
        packet.direction_y[count] = static_cast<float>(line.direction.y);
        packet.direction_z[count] = static_cast<float>(line.direction.z);
        sights[count++] = {i, line.direction, (reach.far - reach.near) * mesh.scale};
    }
    std::array<RayEnd, kPacket> ends{};
    caster_.cast(packet, count, ends);
    std::array<std::optional<SeenHit>, kPacket> seen;
    for (std::size_t k = 0; k < count; ++k) {
        if (ends[k] == RayEnd::hit && double{packet.t[k]} <= sights[k].length) {
            const Hit hit{
                packet.triangle[k],
                packet.t[k],
                packet.u[k],
                packet.v[k],
                {packet.normal_x[k], packet.normal_y[k], packet.normal_z[k]}};
            const std::uint32_t region = scene_.region_of(caster_.source(hit.triangle)).value;
            seen[sights[k].place] = SeenHit{hit, region, sights[k].direction};
        }
    }
    return seen;
}

}  // namespace quasimc
