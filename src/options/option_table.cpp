// The table of run options: one row for each field of RunSpec that users can set.

#include <algorithm>
#include <limits>
#include <utility>

#include "options/options.h"
#include "results/question.h"
#include "samplers/catalogue.h"
#include "solvers/catalogue.h"
#include "solvers/run_limits.h"
#include "text/table_reader.h"

namespace quasimc {
namespace {

constexpr double kLongestRun = 1e9;  // seconds

template <typename T>
Option integer_option(OptionWords words, T RunSpec::*field, IntegerDomain domain) {
    return {
        words, domain,
        [field](RunSpec& spec, const OptionValue& value) {
            spec.*field = static_cast<T>(std::get<std::int64_t>(value));
        },
        [field](const RunSpec& spec) -> OptionValue {
            return static_cast<std::int64_t>(spec.*field);
        }};
}

/// @param value_of  the field's value in an OptionValue
template <typename T>
Option plain_option(
    OptionWords words,
    T RunSpec::*field,
    OptionDomain domain,
    T (*value_of)(const OptionValue& value) = [](const OptionValue& value) {
        return std::get<T>(value);
    }) {
    return {
        words, std::move(domain),
        [field, value_of](RunSpec& spec, const OptionValue& value) {
            spec.*field = value_of(value);
        },
        [field](const RunSpec& spec) -> OptionValue { return spec.*field; }};
}

Option real_option(OptionWords words, double RunSpec::*field, RealDomain domain) {
    return plain_option(words, field, domain, as_real);
}

template <typename Enum>
using Named = std::vector<std::pair<std::string_view, Enum>>;

template <typename Enum>
Option choice_option(OptionWords words, Enum RunSpec::*field, const Named<Enum>& values) {
    ChoiceDomain domain;
    for (const auto& [name, value] : values) {
        domain.names.push_back(name);
    }
    return {
        words, domain,
        [field, values](RunSpec& spec, const OptionValue& value) {
            const auto is_named = [&](const auto& v) {
                return v.first == std::get<std::string>(value);
            };
            spec.*field = std::find_if(values.begin(), values.end(), is_named)->second;
        },
        [field, values](const RunSpec& spec) -> OptionValue {
            const auto is_set = [&](const auto& v) { return v.second == spec.*field; };
            return std::string(std::find_if(values.begin(), values.end(), is_set)->first);
        }};
}

/// The methods of the catalogue of solvers, and "auto".
Named<Method> names_of_methods() {
    Named<Method> names;
    for (const SolverEntry& solver : solver_catalogue()) {
        names.emplace_back(solver.name, solver.method);
    }
    names.emplace_back("auto", Method::automatic);
    return names;
}

// THE TABLE.
//
// To add an option of a run: add a field with its default to RunSpec (quasimc/run_spec.h) and a row
// here. The key in [run], the flag of the program, the range check with its message,
// --dump-default, the table in docs/reference/options.md (copy it from `quasimc list options
// -markdown`; a test compares), the keyword in Python and the echo in the JSON result follow from
// the row. python/quasimc/__init__.pyi lists it too, for type checkers (a test compares).
std::vector<Option> rows_of_sampling() {
    constexpr std::int64_t kAnySeed = std::numeric_limits<std::int64_t>::max();
    return {
        plain_option(
            {"sampler", "", "point set for sampling"}, &RunSpec::sampler,
            ChoiceDomain{names_in(sampler_catalogue())}),
        choice_option<Method>(
            {"method", "",
             "transport method: ray_bundles (sun and sky, Lambertian surfaces), first_hits "
             "(sun and sky), light_tracing (lamps), from_organs (few measured organs); auto "
             "chooses"},
            &RunSpec::method, names_of_methods()),
        integer_option(
            {"paths", "", "sampling effort of one replicate, in paths; best a power of two"},
            &RunSpec::paths, {1, kMaxPaths}),
        integer_option(
            {"replicates", "", "independent repetitions that give the standard errors"},
            &RunSpec::replicates, {1, kMaxReplicates}),
        integer_option({"seed", "", "seed of the random numbers"}, &RunSpec::seed, {0, kAnySeed}),
        integer_option(
            {"threads", "", "threads (0: all cores); results do not depend on it"},
            &RunSpec::threads, {0, kMaxThreads}),
    };
}

std::vector<Option> rows_of_stopping() {
    return {
        real_option(
            {"target_error", "",
             "continue until the light of `target` has this relative standard error (0.01: 1 %; "
             "0: no target)"},
            &RunSpec::target_error, {0, 1}),
        real_option(
            {"target_fraction", "",
             "fraction of organs (or groups, sensors) that must reach target_error in every band"},
            &RunSpec::target_fraction, {0, 1}),
        choice_option<TargetScope>(
            {"target", "",
             "whose light must reach target_error: each organ, group or sensor, or the total of "
             "all "
             "organs; auto: organs and, if there are any, sensors"},
            &RunSpec::target,
            {{"auto", TargetScope::automatic},
             {"organs", TargetScope::organs},
             {"groups", TargetScope::groups},
             {"total", TargetScope::total},
             {"sensors", TargetScope::sensors}}),
        plain_option(
            {"target_quantity", "",
             "quantity that must reach target_error; auto: absorbed_flux, of sensors the light on "
             "both sides"},
            &RunSpec::target_quantity, ChoiceDomain{target_quantities()}),
        plain_option(
            {"target_bands", "", "bands in which target_error must be reached (none: all)"},
            &RunSpec::target_bands, ListDomain{"BAND"}),
        real_option(
            {"max_seconds", "s", "time limit in seconds (0: none)"}, &RunSpec::max_seconds,
            {0, kLongestRun}),
        integer_option(
            {"max_paths", "",
             "limit on paths per replicate (0: 2^30 with target_error, otherwise paths)"},
            &RunSpec::max_paths, {0, kMaxPaths}),
    };
}

std::vector<Option> rows_of_time() {
    return {
        choice_option<PathAllocation>(
            {"path_allocation", "",
             "with [time]: paths equal for all time steps, or proportional to their light; "
             "target_error is then for the daily sum"},
            &RunSpec::path_allocation,
            {{"equal", PathAllocation::equal}, {"proportional", PathAllocation::proportional}}),
        choice_option<TimeMethod>(
            {"time_method", "",
             "with [time]: independent time steps, or daylight_coefficients (one set of sky "
             "solutions for all; ray_bundles only)"},
            &RunSpec::time_method,
            {{"independent", TimeMethod::independent},
             {"daylight_coefficients", TimeMethod::daylight_coefficients}}),
    };
}

std::vector<Option> rows_of_results() {
    constexpr std::int64_t kMaxLayers = 100000;
    return {
        plain_option(
            {"ratios", "", "ratios of incident light in two bands, \"R:FR\""}, &RunSpec::ratios,
            ListDomain{"BAND:BAND"}),
        plain_option(
            {"groups", "",
             "sum results over organs with equal labels, \"plant\" or \"plant+kind\"; with a "
             "condition, \"plant where height > 1\""},
            &RunSpec::groups, ListDomain{"LABEL"}),
        plain_option(
            {"origins", "",
             "report light by where it came from too: sun, sky, lamps, or names of sources with *"},
            &RunSpec::origins, ListDomain{"ORIGIN"}),
        choice_option<SunShade>(
            {"sun_shade", "",
             "light of the sunlit and the shaded part of each organ and group: together, or apart "
             "too"},
            &RunSpec::sun_shade, {{"together", SunShade::together}, {"apart", SunShade::apart}}),
        integer_option(
            {"layers", "",
             "sum results in this many layers of equal height, from the ground to the top "
             "(0: none)"},
            &RunSpec::layers, {0, kMaxLayers}),
        plain_option(
            {"layer_heights", "",
             "boundaries of the layers, ascending, in the length unit, instead of their number"},
            &RunSpec::layer_heights, RealsDomain{}, as_reals),
    };
}

std::vector<Option> rows_of_expert() {
    return {
        choice_option<DirectLight>(
            {"direct_light", "",
             "include or exclude direct light in results (excluded: scattered light only)"},
            &RunSpec::direct_light,
            {{"included", DirectLight::included}, {"excluded", DirectLight::excluded}}),
        real_option(
            {"audit", "",
             "check against plain Monte Carlo with this fraction of the paths (0.1; 0: no "
             "check)"},
            &RunSpec::audit, {0, 1}),
        integer_option(
            {"max_depth", "",
             "end a path after this many hits (0: no limit); the energy lost is reported"},
            &RunSpec::max_depth, {0, 1000000}),
        real_option(
            {"roulette_threshold", "",
             "relative weight below which Russian roulette is played (1: at every hit)"},
            &RunSpec::roulette_threshold, {1e-6, 1}),
        choice_option<StartArea>(
            {"start_area", "",
             "area from which paths start: the scene's silhouette, or the disc of its "
             "bounding sphere"},
            &RunSpec::start_area,
            {{"silhouette", StartArea::silhouette},
             {"bounding_sphere", StartArea::bounding_sphere}}),
        choice_option<Accelerator>(
            {"accelerator", "", "embree, or brute_force (slow, for checks)"}, &RunSpec::accelerator,
            {{"embree", Accelerator::embree}, {"brute_force", Accelerator::brute_force}}),
        real_option(
            {"tally_memory_mb", "MB",
             "memory for one tally per thread; above it threads share one (same results)"},
            &RunSpec::tally_memory_mb, {0, 1e6}),
    };
}

std::vector<Option> make_table() {
    std::vector<Option> table;
    const auto add = [&](std::string_view group, std::vector<Option> rows) {
        for (Option& row : rows) {
            row.group = group;
            table.push_back(std::move(row));
        }
    };
    add("Sampling", rows_of_sampling());
    add("Stopping", rows_of_stopping());
    add("Time", rows_of_time());
    add("Results", rows_of_results());
    add("Expert", rows_of_expert());
    return table;
}

}  // namespace

std::span<const Option> option_table() {
    static const std::vector<Option> table = make_table();
    return table;
}

}  // namespace quasimc
