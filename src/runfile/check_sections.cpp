#include "runfile/check_sections.h"

#include <algorithm>
#include <vector>

#include "light/source_origins.h"
#include "quasimc/source.h"
#include "series/trace_spec.h"

namespace quasimc {
namespace {

/// Checks that times have lengths, which a day's sum needs.
void check_path_allocation(const Sections& sections, const Reporter& reporter, Faults& faults) {
    if (sections.options.spec.path_allocation == PathAllocation::equal) {
        return;
    }
    if (!sections.series) {
        faults.add(
            {"path_allocation", "it is \"proportional\"",
             "the run has no " + reporter.table_name("time"), "remove it"});
        return;
    }
    const auto& steps = sections.series->time_steps;
    if (std::any_of(steps.begin(), steps.end(), [](const auto& s) { return s.seconds == 0; })) {
        faults.add(
            {"path_allocation", "it is \"proportional\"", "instants do not count in daily sums",
             "give duration_minutes, or leave path_allocation out"});
    }
}

void check_hours(const Sections& sections, const Reporter& reporter, Faults& faults) {
    const RunSpec& spec = sections.options.spec;
    if (sections.series) {
        check_together(*sections.scene, sections.series->time_steps, spec, faults);
    } else if (spec.time_method == TimeMethod::daylight_coefficients) {
        faults.add(
            {"time_method", "it is \"daylight_coefficients\"",
             "the run has no " + reporter.table_name("time"), "remove it"});
    }
}

/// Refuses sunlit and shaded parts of a cumulative sky.
void check_parts(const Sections& sections, Faults& faults) {
    if (sections.options.spec.sun_shade == SunShade::apart && sections.series &&
        sections.series->cumulative_sky != CumulativeSky::none) {
        faults.add(
            {"sun_shade", "light of sunlit and shaded parts, with a cumulative sky",
             "no instants are left, in which a part is sunlit", "leave cumulative_sky out"});
    }
}

/// The sources of the file, or of all its times.
Sources all_sources(const Sections& sections) {
    return sections.series ? sources_of(sections.series->time_steps) : sections.sources.sources;
}

/// The sources that a run is checked with: its own, those of a time step with light, or a
/// substitute if no light is allowed and there is none.
Sources checked_sources(
    const Sections& sections, const Scene& scene, NoLightPolicy no_light_policy) {
    const std::vector<double> one(scene.bands().size(), 1.0);
    if (!sections.series) {
        const Sources& sources = sections.sources.sources;
        return no_light_policy == NoLightPolicy::allowed && is_dark(sources)
                   ? Sources{make_uniform_sky("night", one)}
                   : sources;
    }
    const std::vector<TimeStepPlan> plans = plan_series(sections.series->time_steps);
    const auto lit =
        std::find_if(plans.begin(), plans.end(), [](const auto& plan) { return plan.factor > 0; });
    return lit == plans.end()
               ? Sources{make_uniform_sky("night", one)}
               : sections.series->time_steps[static_cast<std::size_t>(lit - plans.begin())].sources;
}

}  // namespace

bool is_dark(const Sources& sources) {
    return std::all_of(sources.begin(), sources.end(), [](const auto& source) {
        const auto spectrum = source->spectrum();
        return std::all_of(spectrum.begin(), spectrum.end(), [](double x) { return x == 0; });
    });
}

void check_with_sources(
    const Sections& sections, const Scene& scene, Faults& faults, NoLightPolicy no_light_policy) {
    const RunSpec& spec = sections.options.spec;
    Sources sources;
    if (sections.known.sources) {
        check_origins(all_sources(sections), spec.origins, faults);
        sources = checked_sources(sections, scene, no_light_policy);
    }
    check_known_parts(scene, sources, spec, sections.known, faults);
}

void check_times(const Sections& sections, const Reporter& reporter, Faults& faults) {
    const KnownParts& known = sections.known;
    if (known.sources) {
        check_path_allocation(sections, reporter, faults);
        check_parts(sections, faults);
    }
    if (known.sources && known.scene) {
        check_hours(sections, reporter, faults);
    }
}

}  // namespace quasimc
