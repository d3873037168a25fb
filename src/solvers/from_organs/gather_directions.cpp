#include "solvers/from_organs/gather_directions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "light/models/hemisphere.h"
#include "optics/turn.h"
#include "scene/scene.h"

namespace quasimc {

namespace {

constexpr double kAlongGround = .25;
/// The smallest cosine of directions along the ground.
constexpr double kMinCosine = 1e-6;

/// Whether a lobe scatters much more light at grazing angles than the cosine law.
bool sends_along(const Bsdf& lobe) {
    constexpr double kArrival = .05, kExit = 1e-6, kMuch = 100;
    if (lobe.is_delta() || lobe.is_lambertian() || lobe.hemisphere() != Hemisphere::reflected) {
        return false;
    }
    const Vec3 wi{std::sqrt(1 - kArrival * kArrival), 0, -kArrival};
    const Vec3 wo{std::sqrt(1 - kExit * kExit), 0, kExit};
    return lobe.bsdf({0, 0, 1}, wi, wo) > kMuch;
}

bool has_ground_that_sends_along(const Scene& scene) {
    return std::any_of(scene.regions().begin(), scene.regions().end(), [&](const Region& region) {
        const auto& lobes = data_of(scene).material(region).side(SurfaceSide::upper).lobes();
        return scene.organs()[region.organ.value].is_ground &&
               std::any_of(lobes.begin(), lobes.end(), [](const Lobe& lobe) {
                   return sends_along(*lobe.shape);
               });
    });
}

/// Samples the cosine of the exit angle with a density proportional to its power of -3/4. A power
/// of -1 would match the light, but rays that cross many cells would take most of the time.
Vec3 direction_along_ground(double u0, double u1) {
    const double least = std::pow(kMinCosine, .25);
    const double cosine = std::pow(least + u0 * (1 - least), 4);
    const double sine = std::sqrt((1 - cosine) * (1 + cosine));
    const SinCos azimuth = sin_cos_turn(u1);
    return {sine * azimuth.cos, sine * azimuth.sin, -cosine};
}

/// Per solid angle.
double density_along_ground(const Vec3& away) {
    static const double kScale = 8 * std::numbers::pi * (1 - std::pow(kMinCosine, .25));
    return away.z <= -kMinCosine ? 1 / (kScale * std::pow(-away.z, .75)) : 0;
}

}  // namespace

GatherDirections::GatherDirections(const PreparedScene& prepared)
    : prepared_(prepared),
      along_ground_(has_ground_that_sends_along(prepared.scene()) ? kAlongGround : 0) {}

namespace {

/// A direction of equal density over the sphere.
GatherSample draw_on_sphere(double u0, double u1) {
    const double z = 1 - 2 * u0;
    const double sine = std::sqrt(std::max(0.0, 1 - z * z));
    const SinCos azimuth = sin_cos_turn(u1);
    return {
        {sine * azimuth.cos, sine * azimuth.sin, z}, SurfaceSide::upper, 1, 4 * std::numbers::pi};
}

}  // namespace

GatherSample GatherDirections::draw(const OrganPoint& point, double u0, double u1) const {
    if (point.receiver == Receiver::sphere) {
        return draw_on_sphere(u0, u1);
    }
    // The squared sine of the widest angle, 1 except for sensors with a narrow field of view.
    const double part = 1 - std::pow(prepared_.fields_of_view().least_cosine(point.region), 2);
    // pi for the cosine law, 2 for the choice of a side.
    const double factor = 2 * std::numbers::pi * part;
    if (u0 < along_ground_) {
        const Vec3 away = direction_along_ground(u0 / along_ground_, u1);
        const double up = dot(away, point.up);
        const double cosine = std::abs(up);
        const bool is_seen = cosine > 0 && prepared_.fields_of_view().contain(point.region, cosine);
        return {away, side_facing(-up), cosine, is_seen ? mixed(factor, cosine, away) : 0};
    }
    const double pick = 2 * (u0 - along_ground_) / (1 - along_ground_);
    const SurfaceSide side = pick < 1 ? SurfaceSide::upper : SurfaceSide::lower;
    const Vec3 normal = side == SurfaceSide::upper ? point.up : -point.up;
    const Vec3 away =
        cosine_direction_about(normal, part * (side == SurfaceSide::upper ? pick : pick - 1), u1);
    const double cosine = dot(away, normal);
    return {away, side, cosine, along_ground_ > 0 ? mixed(factor, cosine, away) : factor};
}

/// The balance heuristic: the density of a direction is that of both techniques.
double GatherDirections::mixed(double factor, double cosine, const Vec3& away) const {
    return cosine /
           ((1 - along_ground_) * cosine / factor + along_ground_ * density_along_ground(away));
}

}  // namespace quasimc
