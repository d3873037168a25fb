#include "transport/near_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "light/models/source.h"
#include "transport/surface.h"

namespace quasimc {
namespace {

/// Trial paths that tell how far the things are that a lamp lights: of all lamps, and of one.
constexpr std::size_t kAllTrials = 1U << 17U;
constexpr std::size_t kLeastTrials = 64, kMostTrials = 1024;

/// The point `i` of an additive recurrence with the root of x^5 = x + 1 (Roberts 2018).
std::array<double, 4> trial_point(int i) {
    constexpr double kRoot = 1.1673039782614187;
    std::array<double, 4> u{};
    double step = 1;
    for (double& x : u) {
        step /= kRoot;
        const double turns = 0.5 + step * (i + 1);
        x = turns - std::floor(turns);
    }
    return u;
}

bool is_within(const Vec3& place, const Vec3& center, double radius) {
    const Vec3 offset = place - center;
    return dot(offset, offset) < radius * radius;
}

/// The point of a line lamp that is next to a place, or a lamp's centre.
Vec3 nearest_of(const Vec3& center, const Vec3& half_line, const Vec3& place) {
    const double square = dot(half_line, half_line);
    if (square == 0) {
        return center;
    }
    return center + std::clamp(dot(place - center, half_line) / square, -1.0, 1.0) * half_line;
}

/// What of the light that is scattered near a lamp is followed: see NearLamps::leg().
constexpr double kLegPart = 0.25;

}  // namespace

NearLamps::NearLamps(const PreparedScene& prepared) : prepared_(prepared) {
    // Of the size of an organ. Of bounded irradiance the bright place next to a lamp is as large as
    // the distance: a tenth is met by one point in thirty.
    constexpr double kPartOfOrgan = 0.5, kPartIfBounded = 0.1;
    lamps_.reserve(prepared.lights().size());
    for (const Region& region : prepared.scene().regions()) {
        const double area = prepared.scene().organs()[region.organ.value].area;
        organ_size_.push_back(std::sqrt(area / prepared.world_area()));
    }
    for (const BoundSource& light : prepared.lights()) {
        Lamp& lamp = lamps_.emplace_back();
        const auto place = light.source_sampler->lamp_place();
        if (!place) {
            continue;
        }
        lamp.body = place->body;
        const std::vector<Trial> trials = trials_of(light, *place);
        lamp.scatter_radius = radius_about(trials, *place, light.usual_irradiance);
        lamp.leg = kLegPart * lamp.scatter_radius;
        lamp.half_line = place->half_line;
        const bool is_line = dot(lamp.half_line, lamp.half_line) > 0;
        lamp.is_bounded = place->has_bounded_irradiance && !is_line;
        lamp.organ_part = lamp.is_bounded ? kPartIfBounded : kPartOfOrgan;
        const bool is_near = std::any_of(trials.begin(), trials.end(), [&](const Trial& trial) {
            return lights_near(light, trial.region, trial.place);
        });
        lamp.organ_part = is_near ? lamp.organ_part : 0;
        double sum = 0;
        for (const Trial& trial : trials) {
            sum += scatters_near(light, trial.place) ? 0 : trial.irradiance;
        }
        lamp.irradiance = trials.empty() ? 0 : sum / static_cast<double>(trials.size());
        any_ = any_ || lamp.scatter_radius > 0 || lamp.organ_part > 0;
    }
}

/// What trial paths of a lamp met, the nearest first.
std::vector<NearLamps::Trial> NearLamps::trials_of(
    const BoundSource& light, const LampPlace& lamp) const {
    std::vector<Trial> trials;
    const std::size_t count =
        std::clamp(kAllTrials / prepared_.lights().size(), kLeastTrials, kMostTrials);
    for (int i = 0; i < static_cast<int>(count); ++i) {
        const Emission start = light.source_sampler->emit(trial_point(i));
        const CastHit at = prepared_.caster().cast_from_lamp(start.origin, start.direction);
        if (at.end == RayEnd::hit) {
            const Vec3 place = place_of(prepared_, at.hit);
            trials.push_back(
                {length(place - nearest_of(lamp.body.center, lamp.half_line, place)), place,
                 prepared_.region(at.hit.triangle), irradiance_at(light, at)});
        }
    }
    std::sort(trials.begin(), trials.end(), [](const Trial& a, const Trial& b) {
        return a.distance < b.distance;
    });
    return trials;
}

/// On what was hit, as if nothing else stood in the way.
double NearLamps::irradiance_at(const BoundSource& light, const CastHit& at) const {
    constexpr int kDraws = 4;
    const Vec3 normal = normalized(prepared_.caster().mesh().across(at.hit.triangle));
    const Vec3 place = prepared_.to_world(place_of(prepared_, at.hit));
    double sum = 0;
    for (int i = 0; i < kDraws; ++i) {
        const std::array<double, 4> u = trial_point(i);
        const Illumination seen = model_of(*light.source).illuminate(place, u[0], u[1]);
        sum += seen.weight * std::abs(dot(seen.to_light, normal)) / kDraws;
    }
    return sum;
}

/// A fiftieth of the scene, or a quarter of the distance within which the lamp lights nine tenths
/// of what it lights; 0 where nothing it lights is so near. A large lamp of bounded radiance has
/// no place next to it that is brighter than others, unless most of its light falls on a small one:
/// less than a twentieth of a face of the scene's box, over which `usual` is its irradiance.
double NearLamps::radius_about(
    const std::vector<Trial>& trials, const LampPlace& place, double usual) const {
    constexpr double kPartOfScene = 0.02;
    constexpr double kPartOfReach = 0.25;
    constexpr double kReach = 0.9;
    constexpr double kPeak = 20;
    if (trials.empty()) {
        return 0;
    }
    const auto reach = static_cast<std::size_t>(kReach * static_cast<double>(trials.size() - 1));
    const double scene = length(prepared_.projection().entry_box().bounds.size());
    double radius = std::max(kPartOfScene * scene, kPartOfReach * trials[reach].distance);
    double irradiance = 0;
    for (const Trial& trial : trials) {
        irradiance += trial.irradiance / static_cast<double>(trials.size());
    }
    if (place.has_bounded_irradiance && irradiance < kPeak * usual) {
        radius = radius > place.body.radius ? radius : 0;
    } else if (dot(place.half_line, place.half_line) == 0) {
        radius += 1.5 * place.body.radius;
    }
    return trials.front().distance < radius ? radius : 0;
}

bool NearLamps::scatters_near(const BoundSource& light, const Vec3& place) const {
    const Lamp& lamp = lamp_of(light);
    return lamp.scatter_radius > 0 &&
           is_within(
               place, nearest_of(lamp.body.center, lamp.half_line, place), lamp.scatter_radius);
}

double NearLamps::gap_to(const BoundSource& light, const Bounds& box) const {
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

bool NearLamps::lights_near(
    const BoundSource& light, std::uint32_t region, const Vec3& place) const {
    const Lamp& lamp = lamp_of(light);
    if (lamp.organ_part == 0) {
        return false;
    }
    const double reach = lamp.organ_part * organ_size_[region];
    // Points find what is near a lamp as large as that.
    if (lamp.is_bounded && reach < lamp.body.radius) {
        return false;
    }
    const bool is_line = dot(lamp.half_line, lamp.half_line) > 0;
    return is_within(
        place, nearest_of(lamp.body.center, lamp.half_line, place),
        reach + (is_line ? 0 : 1.5 * lamp.body.radius));
}

}  // namespace quasimc
