// What a series can't be whose times are computed together.

#include <string>
#include <utility>

#include <fmt/format.h>

#include "quasimc/series.h"
#include "series/basis/season_basis.h"

namespace quasimc {
namespace {

void check_together_sources(const std::vector<TimeStep>& time_steps, Faults& faults) {
    for (const TimeStep& step : time_steps) {
        for (const auto& source : step.sources) {
            const std::string place = fmt::format("source '{}'", source->name());
            if (source->is_lamp()) {
                faults.add(
                    {place, "a lamp, where series = \"together\"",
                     "only light from far away is put together from directions",
                     "use series = \"one_by_one\""});
                return;
            }
            if (source->is_sun() && !(beam_of(*source).to_light.z > 0)) {
                faults.add(
                    {place, "light from below the horizon, where series = \"together\"",
                     "light is put together from directions of the upper hemisphere",
                     "use series = \"one_by_one\""});
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
    if (spec.series != SeriesMode::together) {
        return;
    }
    const auto refuse = [&](bool is_so, std::string problem, std::string why, std::string what) {
        if (is_so) {
            faults.add({"series", std::move(problem), std::move(why), std::move(what)});
        }
    };
    refuse(
        spec.method != Method::ray_bundles, "it is \"together\", and method is not ray_bundles",
        "no other way of computing solves for many lights at once",
        "state method = \"ray_bundles\"");
    refuse(
        spec.target_error > 0 || spec.max_paths > 0,
        "it is \"together\", with target_error or max_paths",
        "what all times have in common is computed once, with paths", "state paths alone");
    const std::uint32_t directions = season_directions();
    refuse(
        spec.paths < directions, fmt::format("it is \"together\", with {} paths", spec.paths),
        fmt::format(
            "the light of {} directions is put together, and a path is needed for each",
            directions),
        fmt::format("set paths to {} or more, or use series = \"one_by_one\"", directions));
    refuse(
        spec.audit > 0, "it is \"together\", with audit", "no time is a run that could be audited",
        "audit one_by_one");
    refuse(
        spec.effort == Effort::day, "it is \"together\", with effort = \"day\"",
        "all times have the same paths", "leave effort out");
    refuse(
        !scene.detectors().empty(), "it is \"together\", and the scene has detectors",
        "light that escapes is not kept by direction", "use series = \"one_by_one\"");
    check_together_sources(time_steps, faults);
}

}  // namespace quasimc
