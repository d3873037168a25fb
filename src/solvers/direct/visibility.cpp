#include "solvers/direct/visibility.h"

#include <cmath>

#include "geometry/cast/rounding.h"

namespace quasimc {
namespace {

/// The first hit before `distance` that is no sensor; `left` remains of the distance from there.
struct SolidHit {
    CastHit at;
    double left = 0;
};
SolidHit cast_past_sensors(
    const PreparedScene& prepared,
    const Vec3& p,
    const Vec3& direction,
    double distance,
    std::uint32_t self) {
    const RayCaster& caster = prepared.caster();
    SolidHit first{caster.cast(p, direction, self), distance};
    CastHit& at = first.at;
    while (at.end == RayEnd::hit && at.hit.t < first.left &&
           prepared.material(prepared.region(at.hit.triangle)).is_transparent()) {
        const Hit hit = at.hit;
        first.left -= hit.t;
        at = caster.cast(caster.mesh().point(hit.triangle, hit.u, hit.v), direction, hit.triangle);
    }
    return first;
}

bool is_open(
    const PreparedScene& prepared,
    const Vec3& p,
    const Vec3& direction,
    double distance,
    std::uint32_t self) {
    if (!prepared.optics().has_transparent) {
        return !prepared.caster().occluded(p, direction, self, distance);
    }
    const auto [at, left] = cast_past_sensors(prepared, p, direction, distance, self);
    return at.end != RayEnd::hit || at.hit.t >= left;
}

}  // namespace

bool is_visible_source(
    const PreparedScene& prepared,
    const Vec3& p,
    const Vec3& direction,
    double distance,
    std::uint32_t self) {
    if (!std::isfinite(distance)) {
        return is_open(prepared, p, direction, distance, self);
    }
    // A lamp may lie on a surface, so its neighbourhood is tested from the lamp.
    const double most = distance - static_cast<double>(kTouch);
    if (most > 0 && !is_open(prepared, p, direction, most, self)) {
        return false;
    }
    const Hit at = prepared.caster().hit_at_lamp(
        p + distance * direction, -direction, distance - static_cast<double>(kNear), self);
    return !at.found() || prepared.material(prepared.region(at.triangle)).is_transparent();
}

bool is_visible_point(
    const PreparedScene& prepared,
    const Vec3& p,
    const Vec3& direction,
    double distance,
    std::uint32_t self,
    std::uint32_t other) {
    const auto [at, left] = cast_past_sensors(prepared, p, direction, distance, self);
    // The point at the end lies on `other`, to rounding.
    return at.end != RayEnd::hit || at.hit.triangle == other ||
           at.hit.t >= left - static_cast<double>(kTouch);
}

}  // namespace quasimc
