#include "run/sensor_run.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "quasimc/run.h"
#include "run/trace_plan.h"
#include "samplers/hash.h"
#include "scene/sensors.h"
#include "solvers/run_limits.h"

namespace quasimc {
namespace {

/// The name of a material with a mirror; empty if there is none.
std::string mirror_of(const Scene& scene) {
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t i = 0; i < is_used.size(); ++i) {
        const Material& material = data_of(scene).materials[i];
        for (const SurfaceSide side : kSurfaceSides) {
            const std::vector<Lobe>& lobes = material.side(side).lobes();
            const bool has_mirror = std::any_of(lobes.begin(), lobes.end(), [](const Lobe& lobe) {
                return lobe.shape->is_delta();
            });
            if (is_used[i] && has_mirror && !material.is_transparent()) {
                return material.name();
            }
        }
    }
    return "";
}

template <typename Is>
std::string name_of_source(const Sources& sources, Is is) {
    const auto found = std::find_if(
        sources.begin(), sources.end(), [&](const auto& source) { return is(*source); });
    return found == sources.end() ? "" : (*found)->name();
}

/// The values of the last rows of a list.
void keep_last(std::vector<Estimate>& values, std::size_t count) {
    values.erase(
        values.begin(), values.end() - static_cast<std::ptrdiff_t>(std::min(count, values.size())));
}

/// Adds a fault for each set with points that single precision cannot resolve in the scene.
void check_reach(const Scene& scene, Faults& faults) {
    for (const SensorSet& set : scene.sensors()) {
        const bool is_near = std::ranges::all_of(set.points, [&](const SensorPoint& point) {
            return is_in_reach(scene, point.position, set.radius);
        });
        if (!is_near) {
            faults.add(
                {fmt::format("sensors '{}'", set.name), "a point is too far from the scene",
                 kReachRule, ""});
        }
    }
}

}  // namespace

bool has_sensors(const Scene& scene) {
    return !scene.sensors().empty();
}

void check_sensor_light(const Scene& scene, const Sources& sources, Faults& faults) {
    if (!has_sensors(scene)) {
        return;
    }
    check_reach(scene, faults);
    const std::string where = fmt::format("sensors '{}'", scene.sensors().front().name);
    const char* as_organs =
        "describe them as organs of a material with transmittance = 1 and transmission_model = "
        "\"mirror\"";
    const std::string lamp =
        name_of_source(sources, [](const Source& source) { return source.is_lamp(); });
    if (!lamp.empty() && scene.cell().periodic()) {
        faults.add(
            {where, fmt::format("they are below '{}', a lamp that repeats with the cell", lamp),
             "paths from a point would have to choose one of infinitely many copies of the lamp",
             as_organs});
    }
    const std::string mirror = mirror_of(scene);
    const std::string bright = name_of_source(sources, [](const Source& source) {
        return source.is_lamp() || source.is_directional() || source.is_sun();
    });
    if (!mirror.empty() && !bright.empty()) {
        faults.add(
            {where, fmt::format("light of '{}' may reach them by the mirror '{}'", bright, mirror),
             "paths from a point never meet it there", as_organs});
    }
}

RunSpec spec_of_organs(const Scene& scene, const RunSpec& spec) {
    RunSpec own = spec;
    if (has_sensors(scene) && spec.target == TargetScope::sensors) {
        own.target = TargetScope::automatic;
        own.target_error = 0;
        own.max_paths = 0;
    }
    return own;
}

RunSpec spec_of_sensors(const Scene& scene, const RunSpec& spec) {
    constexpr std::uint64_t kMinPoints = 32;
    const std::uint64_t rows = sensor_rows(scene);
    const std::uint64_t each = std::bit_floor(
        std::max<std::uint64_t>(spec.paths / rows, std::min(spec.paths, kMinPoints)));
    const bool has_target =
        spec.target == TargetScope::automatic || spec.target == TargetScope::sensors;
    RunSpec own = planned_spec(
        spec, {.method = Method::from_organs,
               .seed = mix64(spec.seed ^ 0xbb67ae8584caa73bU),
               .paths = std::min(each * std::bit_ceil(rows), kMaxPaths),
               .target_error = has_target ? spec.target_error : 0});
    const double more = static_cast<double>(own.paths) / static_cast<double>(spec.paths);
    own.max_paths = has_target ? std::min(
                                     kMaxPaths, static_cast<std::uint64_t>(std::ceil(
                                                    more * static_cast<double>(spec.max_paths))))
                               : 0;
    own.target = TargetScope::automatic;
    own.sun_shade = SunShade::together;
    own.groups.clear();
    own.layers = 0;
    own.layer_heights.clear();
    own.audit = 0;
    return own;
}

Result sensors_of(Result all, const Scene& scene) {
    const std::size_t rows = sensor_rows(scene);
    keep_last(all.values, rows * kQuantities * all.bands);
    keep_last(all.ratio_values, rows * all.ratios);
    keep_last(all.sunlit_fraction, rows);
    all.names = scene_of_sensors(scene).names();
    all.groups = {};
    all.budget.clear();
    all.canopy.clear();
    all.detectors.clear();
    for (OriginLight& origin : all.origins) {
        origin.light = sensors_of(std::move(origin.light), scene);
    }
    return all;
}

}  // namespace quasimc
