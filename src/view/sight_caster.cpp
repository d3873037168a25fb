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

}  // namespace

/// The part of a line of sight that lies in the box: where it starts and how long it is, local
/// units.
struct SightCaster::Sight {
    Vec3 start, direction;
    double length = 0;
};

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

std::optional<SightCaster::Sight> SightCaster::sight(const PixelPlace& place) const {
    const Camera::SightLine line = camera_.through(place);
    const Reach reach = reach_of(line, box_, cuts_);
    if (!(reach.near < reach.far)) {
        return std::nullopt;
    }
    const LocalMesh& mesh = caster_.mesh();
    return Sight{
        mesh.to_local(line.origin + reach.near * line.direction), line.direction,
        (reach.far - reach.near) * mesh.scale};
}

std::optional<SeenHit> SightCaster::seen(const Sight& sight, RayEnd end, const Hit& hit) const {
    if (end != RayEnd::hit || double{hit.t} > sight.length) {
        return std::nullopt;
    }
    return SeenHit{hit, scene_.region_of(caster_.source(hit.triangle)).value, sight.direction};
}

std::optional<SeenHit> SightCaster::look(const PixelPlace& place) const {
    const std::optional<Sight> line = sight(place);
    if (!line) {
        return std::nullopt;
    }
    const CastHit cast = caster_.cast(line->start, line->direction, kNoTriangle);
    return seen(*line, cast.end, cast.hit);
}

std::array<std::optional<SeenHit>, kPacket> SightCaster::look(
    std::span<const PixelPlace> places) const {
    EXPECT(places.size() <= kPacket);
    Packet packet{};
    std::array<Sight, kPacket> sights;
    std::array<std::size_t, kPacket> place_of{};
    std::size_t count = 0;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (const std::optional<Sight> line = sight(places[i])) {
            packet.set_origin(count, line->start);
            packet.set_direction(count, line->direction);
            sights[count] = *line;
            place_of[count++] = i;
        }
    }
    std::array<RayEnd, kPacket> ends{};
    caster_.cast(packet, count, ends);
    std::array<std::optional<SeenHit>, kPacket> found;
    for (std::size_t k = 0; k < count; ++k) {
        found[place_of[k]] = seen(sights[k], ends[k], packet.hit(k));
    }
    return found;
}

}  // namespace quasimc
