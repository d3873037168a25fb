#include "solvers/from_organs/lamp_near_field.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/additive_recurrence.h"
#include "light/models/source.h"
#include "scene/sensors.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// Pilot paths that sample the surfaces a lamp lights: of all lamps, and of one.
constexpr std::size_t kAllSamples = 1U << 17U;
constexpr std::size_t kMinSamples = 64, kMaxSamples = 1024;

bool is_within(const Vec3& p, const Vec3& center, double radius) {
    const Vec3 offset = p - center;
    return dot(offset, offset) < radius * radius;
}

/// The point of a line lamp nearest to `p`, or a lamp's centre.
Vec3 nearest_of(const Vec3& center, const Vec3& half_line, const Vec3& p) {
    const double square = dot(half_line, half_line);
    if (square == 0) {
        return center;
    }
    return center + std::clamp(dot(p - center, half_line) / square, -1.0, 1.0) * half_line;
}

/// The shortest connection over the radius of the near field.
constexpr double kConnectionPart = 0.25;

}  // namespace

LampNearField::LampNearField(const PreparedScene& prepared) : prepared_(prepared) {
    // Fractions of the size of an organ. If the irradiance is bounded, the bright spot next to a
    // lamp is as large as the distance: at a tenth, one point in thirty hits it.
    constexpr double kPartOfOrgan = 0.5, kPartIfBounded = 0.1;
    lamps_.reserve(prepared.lights().size());
    for (const Region& region : prepared.scene().regions()) {
        const Organ& organ = prepared.scene().organs()[region.organ.value];
        const double area = is_point_sensor(organ) ? 0 : organ.area;
        organ_size_.push_back(std::sqrt(area / prepared.projection().world_area()));
    }
    for (const BoundSource& light : prepared.lights()) {
        Lamp& lamp = lamps_.emplace_back();
        const auto extent = light.source_sampler->lamp_extent();
        if (!extent) {
            continue;
        }
        lamp.body = extent->body;
        const std::vector<PilotSample> samples = pilot_samples(light, *extent);
        lamp.scatter_radius = radius_about(samples, *extent, light.usual_irradiance);
        lamp.min_connection_distance = kConnectionPart * lamp.scatter_radius;
        lamp.half_line = extent->half_line;
        const bool is_line = dot(lamp.half_line, lamp.half_line) > 0;
        lamp.is_bounded = extent->has_bounded_irradiance && !is_line;
        lamp.organ_part = lamp.is_bounded ? kPartIfBounded : kPartOfOrgan;
        const bool is_near = std::any_of(
            samples.begin(), samples.end(),
            [&](const PilotSample& sample) { return lights_near(light, sample.region, sample.p); });
        lamp.organ_part = is_near ? lamp.organ_part : 0;
        double sum = 0;
        for (const PilotSample& sample : samples) {
            sum += scatters_near(light, sample.p) ? 0 : sample.irradiance;
        }
        lamp.irradiance = samples.empty() ? 0 : sum / static_cast<double>(samples.size());
        any_ = any_ || lamp.scatter_radius > 0 || lamp.organ_part > 0;
    }
}

/// The first hits of paths from a lamp, nearest first.
std::vector<LampNearField::PilotSample> LampNearField::pilot_samples(
    const BoundSource& light, const LampExtent& lamp) const {
    std::vector<PilotSample> samples;
    const std::size_t count =
        std::clamp(kAllSamples / prepared_.lights().size(), kMinSamples, kMaxSamples);
    for (int i = 0; i < static_cast<int>(count); ++i) {
        const Emission start = light.source_sampler->emit(additive_recurrence_point(i));
        const CastHit at = prepared_.caster().cast_from_lamp(start.origin, start.direction);
        if (at.end == RayEnd::hit) {
            const Vec3 p = point_of(prepared_, at.hit);
            samples.push_back(
                {length(p - nearest_of(lamp.body.center, lamp.half_line, p)), p,
                 prepared_.region(at.hit.triangle), irradiance_at(light, at)});
        }
    }
    std::sort(samples.begin(), samples.end(), [](const PilotSample& a, const PilotSample& b) {
        return a.distance < b.distance;
    });
    return samples;
}

/// Irradiance on the surface that was hit, without occlusion.
double LampNearField::irradiance_at(const BoundSource& light, const CastHit& at) const {
    constexpr int kDraws = 4;
    const Vec3 normal = normalized(prepared_.caster().mesh().across(at.hit.triangle));
    const Vec3 p = prepared_.caster().mesh().to_world(point_of(prepared_, at.hit));
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) {
        const std::array<double, 4> u = additive_recurrence_point(i);
        const Illumination seen = model_of(*light.source).illuminate(p, u[0], u[1]);
        sum += seen.weight * std::abs(dot(seen.to_light, normal)) / kDraws;
    }
    return sum;
}

/// A fiftieth of the scene, or a quarter of the distance that contains nine tenths of the first
/// hits; 0 if no first hit is so near. A large lamp of bounded radiance has no point next to it
/// that is brighter than others, unless most of its light falls on a small area: less than a
/// twentieth of a face of the scene's box, over which `usual` is its irradiance.
double LampNearField::radius_about(
    const std::vector<PilotSample>& samples, const LampExtent& extent, double usual) const {
    constexpr double kPartOfScene = 0.02;
    constexpr double kPartOfReach = 0.25;
    constexpr double kReach = 0.9;
    constexpr double kPeak = 20;
    if (samples.empty()) {
        return 0;
    }
    const auto reach = static_cast<std::size_t>(kReach * static_cast<double>(samples.size() - 1));
    const double scene = length(prepared_.projection().entry_box().bounds.size());
    double radius = std::max(kPartOfScene * scene, kPartOfReach * samples[reach].distance);
    double irradiance = 0;
    for (const PilotSample& sample : samples) {
        irradiance += sample.irradiance / static_cast<double>(samples.size());
    }
    if (extent.has_bounded_irradiance && irradiance < kPeak * usual) {
        radius = radius > extent.body.radius ? radius : 0;
    } else if (dot(extent.half_line, extent.half_line) == 0) {
        radius += 1.5 * extent.body.radius;
    }
    return samples.front().distance < radius ? radius : 0;
}

bool LampNearField::scatters_near(const BoundSource& light, const Vec3& p) const {
    const Lamp& lamp = lamp_of(light);
    return lamp.scatter_radius > 0 &&
           is_within(p, nearest_of(lamp.body.center, lamp.half_line, p), lamp.scatter_radius);
}

double LampNearField::gap_to(const BoundSource& light, const Bounds& box) const {
    const Lamp& lamp = lamp_of(light);
    const auto between = [](double low, double high, double center, double half) {
        return std::max({0.0, low - center - std::abs(half), center - std::abs(half) - high});
    };
    const Vec3& c = lamp.body.center;
    const Vec3& half = lamp.half_line;
    const Vec3 gap{
        between(box.low.x, box.high.x, c.x, half.x), between(box.low.y, box.high.y, c.y, half.y),
        between(box.low.z, box.high.z, c.z, half.z)};
    const double body = dot(half, half) > 0 ? 0 : 1.5 * lamp.body.radius;
    return std::max(0.0, length(gap) - std::max(lamp.scatter_radius, body));
}

bool LampNearField::lights_near(
    const BoundSource& light, std::uint32_t region, const Vec3& p) const {
    const Lamp& lamp = lamp_of(light);
    if (lamp.organ_part == 0) {
        return false;
    }
    const double reach = lamp.organ_part * organ_size_[region];
    // Points sample the near field of so large a lamp well.
    if (lamp.is_bounded && reach < lamp.body.radius) {
        return false;
    }
    const bool is_line = dot(lamp.half_line, lamp.half_line) > 0;
    return is_within(
        p, nearest_of(lamp.body.center, lamp.half_line, p),
        reach + (is_line ? 0 : 1.5 * lamp.body.radius));
}

}  // namespace quasimc
