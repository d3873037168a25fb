#include "picture/camera_ray_caster.h"

#include <algorithm>
#include <limits>

#include "scene/scene.h"

namespace quasimc {
namespace {

/// The part of a camera ray inside the visible box.
struct Reach {
    double near = 0, far = std::numeric_limits<double>::infinity();

    /// Clips where rate * t > room.
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
    const Camera::CameraRay& line, const Bounds& box, const std::vector<CutPlane>& cuts) {
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

CameraRayCaster::CameraRayCaster(
    const Scene& scene, const Camera& camera, const std::vector<CutPlane>& cuts)
    : scene_(scene),
      camera_(camera),
      cuts_(cuts),
      caster_(
          data_of(scene).geometry,
          camera.is_fisheye() ? scene.cell() : Cell{},
          Accelerator::embree),
      box_(scene.bounds()) {
    if (camera.is_fisheye()) {
        constexpr double kFar = std::numeric_limits<double>::infinity();
        box_ = {{-kFar, -kFar, -kFar}, {kFar, kFar, kFar}};
        return;
    }
    // Camera rays within a face of the box hit surfaces in that face.
    const Vec3 more = 1e-6 * scene.bounds().radius() * Vec3{1, 1, 1};
    box_.add(box_.low - more);
    box_.add(box_.high + more);
}

std::optional<PrimaryHit> CameraRayCaster::trace(const PixelPoint& pixel) const {
    const std::optional<Camera::CameraRay> ray = camera_.through(pixel);
    if (!ray) {
        return std::nullopt;
    }
    const Camera::CameraRay& line = *ray;
    const Reach reach = reach_of(line, box_, cuts_);
    if (!(reach.near < reach.far)) {
        return std::nullopt;
    }
    const LocalMesh& mesh = caster_.mesh();
    const CastHit cast = caster_.cast(
        mesh.to_local(line.origin + reach.near * line.direction), line.direction, kNoTriangle);
    if (cast.end != RayEnd::hit || double{cast.hit.t} > (reach.far - reach.near) * mesh.scale) {
        return std::nullopt;
    }
    return PrimaryHit{
        cast.hit, data_of(scene_).region_of(caster_.source(cast.hit.triangle)).value,
        line.direction};
}

}  // namespace quasimc
