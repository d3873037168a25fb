#include "run/zero_result.h"

#include <algorithm>
#include <limits>

#include "light/models/source.h"
#include "results/evaluate.h"
#include "results/flows.h"
#include "results/groups.h"
#include "results/sun_shade.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// Whether some source is a sun with light, even if it misses the scene.
bool has_bright_sun(const Sources& sources) {
    return std::any_of(sources.begin(), sources.end(), [](const auto& source) {
        const auto spectrum = source->spectrum();
        return source->is_sun() &&
               std::any_of(spectrum.begin(), spectrum.end(), [](double x) { return x > 0; });
    });
}

}  // namespace

Result zero_result(const Scene& scene, const RunSpec& spec) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Result dark;
    dark.names = scene.names();
    dark.bands = scene.bands().size();
    dark.ratios = spec.ratios.size();
    dark.values.resize(scene.organs().size() * kQuantities * dark.bands);
    dark.ratio_values.resize(scene.organs().size() * dark.ratios, {kNan, kNan, kNan, kNan});
    dark.groups = zero_groups(scene, group_spec(spec), dark.ratios);
    if (spec.sun_shade == SunShade::apart) {
        dark.sun_shade = zero_sun_shade(scene.organs().size(), dark.bands);
        dark.groups.sun_shade = zero_sun_shade(dark.groups.groups.size(), dark.bands);
    }
    dark.budget.resize(dark.bands);
    dark.canopy = zero_canopy(scene);
    dark.detectors = zero_detectors(scene);
    dark.replicates = spec.replicates;
    dark.chosen.reason = "no source gives light; nothing was computed";
    if (!scene.sensors().empty()) {
        RunSpec plain = spec;
        plain.sun_shade = SunShade::together;
        plain.groups.clear();
        plain.layers = 0;
        plain.layer_heights.clear();
        Result sensors = zero_result(scene_of_sensors(scene), plain);
        sensors.groups = {};
        dark.sensors = std::make_shared<const Result>(std::move(sensors));
    }
    if (!spec.origins.empty()) {
        RunSpec plain = spec;
        plain.origins.clear();
        plain.ratios.clear();
        plain.sun_shade = SunShade::together;
        const Result each = zero_result(scene, plain);
        for (const std::string& origin : spec.origins) {
            dark.origins.push_back({origin, each});
        }
    }
    return dark;
}

Result unlit_result(const Scene& scene, const RunSpec& spec) {
    Result unlit = zero_result(scene, spec);
    unlit.stop = StopReason::no_light;
    unlit.fraction_at_target = spec.target_error > 0 ? 1 : 0;
    return unlit;
}

void add_sunlit_of_hidden_suns(const Scene& scene, const Sources& sources, Result& result) {
    if (result.sunlit_fraction.empty() && has_bright_sun(sources)) {
        result.sunlit_fraction.resize(scene.organs().size());
    }
}

}  // namespace quasimc
