// Restrictions of series whose time steps are computed together.

#include <algorithm>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "light/source_origins.h"
#include "quasimc/series.h"
#include "series/basis/daylight_coefficients.h"

namespace quasimc {
namespace {

void check_together_sources(const std::vector<TimeStep>& time_steps, Faults& faults) {
    for (const TimeStep& step : time_steps) {
        for (const auto& source : step.sources) {
            const std::string where = fmt::format("source '{}'", source->name());
            if (source->is_lamp()) {
                faults.add(
                    {where, "a lamp, where time_method = \"daylight_coefficients\"",
                     "daylight coefficients need distant light",
                     "use time_method = \"independent\""});
                return;
            }
            if (source->is_sun() && !(beam_of(*source).to_light.z > 0)) {
                faults.add(
                    {where,
                     "light from below the horizon, where time_method = \"daylight_coefficients\"",
                     "daylight coefficients cover the upper hemisphere",
                     "use time_method = \"independent\""});
                return;
            }
        }
    }
}

}  // namespace

void check_together(
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const RunSpec& spec,
    Faults& faults) {
    if (spec.time_method != TimeMethod::daylight_coefficients) {
        return;
    }
    const auto refuse = [&](bool is_so, std::string problem, std::string why, std::string what) {
        if (is_so) {
            faults.add({"time_method", std::move(problem), std::move(why), std::move(what)});
        }
    };
    refuse(
        spec.method != Method::ray_bundles,
        "it is \"daylight_coefficients\", and method is not ray_bundles",
        "no other method solves for many sources at once", "set method = \"ray_bundles\"");
    refuse(
        spec.target_error > 0 || spec.max_paths > 0,
        "it is \"daylight_coefficients\", with target_error or max_paths",
        "daylight coefficients are computed once, with a fixed number of paths", "set paths only");
    const std::uint32_t directions = season_directions();
    refuse(
        spec.paths < directions,
        fmt::format("it is \"daylight_coefficients\", with {} paths", spec.paths),
        fmt::format("each of the {} directions needs a path", directions),
        fmt::format("set paths to {} or more, or use time_method = \"independent\"", directions));
    refuse(
        spec.audit > 0, "it is \"daylight_coefficients\", with audit",
        "no time step is a run of its own", "use time_method = \"independent\"");
    refuse(
        spec.path_allocation == PathAllocation::proportional,
        "it is \"daylight_coefficients\", with path_allocation = \"proportional\"",
        "all time steps have the same paths", "leave path_allocation out");
    refuse(
        !scene.detectors().empty(), "it is \"daylight_coefficients\", and the scene has detectors",
        "escaping light is not stored by direction", "use time_method = \"independent\"");
    refuse(
        !scene.sensors().empty(), "it is \"daylight_coefficients\", and the scene has sensors",
        "paths from points need the sources of each time",
        "use time_method = \"independent\", or cumulative_sky");
    refuse(
        spec.sun_shade == SunShade::apart,
        "it is \"daylight_coefficients\", with light of sunlit and shaded parts",
        "the direct light of suns is not stored by side", "use time_method = \"independent\"");
    const auto splits_suns = [&](const TimeStep& step) {
        return std::ranges::count_if(
                   sources_by_origin(step.sources, spec.origins),
                   [](const Sources& own) { return !shining(own, Shining::suns).empty(); }) > 1;
    };
    refuse(
        std::ranges::any_of(time_steps, splits_suns),
        "it is \"daylight_coefficients\", and origins parts the suns of a time",
        "their direct light is computed together", "use time_method = \"independent\"");
    check_together_sources(time_steps, faults);
}

}  // namespace quasimc
