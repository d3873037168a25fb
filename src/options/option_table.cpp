// The table of run options: one row for each field of RunSpec that a person may set.

#include <algorithm>
#include <limits>
#include <utility>

#include "options/options.h"
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

/// Those of the catalogue of solvers, and "auto".
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
// the row. python/quasimc/__init__.pyi lists it too, for who types (a test compares).
std::vector<Option> rows_of_paths() {
    constexpr std::int64_t kAnySeed = std::numeric_limits<std::int64_t>::max();
    return {
        plain_option(
            {"sampler", "", "point set that the paths are made from"}, &RunSpec::sampler,
            ChoiceDomain{names_in(sampler_catalogue())}),
        choice_option<Method>(
            {"method", "",
             "how light is followed: ray_bundles (sun and sky on matt surfaces), first_hits (sun, "
             "sky), light_tracing (lamps), from_organs (few or small ones measured); auto: the "
             "best of them, and why"},
            &RunSpec::method, names_of_methods()),
        integer_option(
            {"paths", "", "paths of each replicate; a power of two is best"}, &RunSpec::paths,
            {1, kMostPaths}),
        integer_option(
            {"replicates", "",
             "independent randomizations; the standard errors come from their scatter"},
            &RunSpec::replicates, {1, kMostReplicates}),
        integer_option(
            {"seed", "", "another seed gives other random numbers"}, &RunSpec::seed, {0, kAnySeed}),
        integer_option(
            {"threads", "", "0: as many as the machine has; never changes a result"},
            &RunSpec::threads, {0, kMostThreads}),
        integer_option(
            {"max_depth", "",
             "hits after which a path is cut off (the energy is reported); 0: never"},
            &RunSpec::max_depth, {0, 1000000}),
        real_option(
            {"roulette_weight", "",
             "weight that Russian roulette plays for; 1: at every hit, less: fewer paths end "
             "early"},
            &RunSpec::roulette_weight, {1e-6, 1}),
    };
}

std::vector<Option> rows_of_engine() {
    return {
        choice_option<CrossSectionShape>(
            {"window", "",
             "where light enters: silhouette of the scene, or the disc across its bounding sphere"},
            &RunSpec::window,
            {{"silhouette", CrossSectionShape::silhouette}, {"sphere", CrossSectionShape::sphere}}),
        choice_option<Engine>(
            {"engine", "", "ray engine; brute_force is slow and serves to check the other"},
            &RunSpec::engine, {{"embree", Engine::embree}, {"brute_force", Engine::brute_force}}),
        choice_option<DirectLight>(
            {"direct_light", "",
             "light straight from the sources is counted on organs, or ignored: scattered light "
             "alone"},
            &RunSpec::direct_light,
            {{"counted", DirectLight::counted}, {"ignored", DirectLight::ignored}}),
        choice_option<Effort>(
            {"effort", "",
             "with [time]: each time has these paths and this target_error, or paths go by the "
             "light of the hours, for the sum of the day"},
            &RunSpec::effort, {{"each", Effort::each}, {"day", Effort::day}}),
        choice_option<SeriesMode>(
            {"series", "",
             "with [time]: each time is traced for itself, or skies and scattered light of all "
             "times are put together from those of one set of directions (ray_bundles)"},
            &RunSpec::series,
            {{"one_by_one", SeriesMode::one_by_one}, {"together", SeriesMode::together}}),
    };
}

std::vector<Option> rows_of_ends() {
    return {
        real_option(
            {"target_error", "",
             "relative standard error of the absorbed flux to reach, 0.01 for 1 %; 0: none"},
            &RunSpec::target_error, {0, 1}),
        real_option(
            {"target_fraction", "", "fraction of the organs that must reach it in every band"},
            &RunSpec::target_fraction, {0, 1}),
        real_option(
            {"max_seconds", "s",
             "the run ends after that time, with fewer paths if need be; 0: no limit"},
            &RunSpec::max_seconds, {0, kLongestRun}),
        integer_option(
            {"max_paths", "",
             "most paths of each replicate in all rounds; 0: 2^30 with a target, else just paths"},
            &RunSpec::max_paths, {0, kMostPaths}),
        real_option(
            {"audit", "",
             "share of the paths (0.1) that plain Monte Carlo tracing gets afterwards, to compare "
             "with; 0: no audit"},
            &RunSpec::audit, {0, 1}),
        real_option(
            {"tally_memory_mb", "MB",
             "private tallies of all threads; larger ones are shared (same results)"},
            &RunSpec::tally_memory_mb, {0, 1e6}),
        plain_option(
            {"ratios", "", "ratios of the light of two bands that falls on an organ"},
            &RunSpec::ratios, WordsDomain{"BAND:BAND"}),
    };
}

std::vector<Option> rows_of_groups() {
    constexpr std::int64_t kMostLayers = 100000;
    return {
        plain_option(
            {"groups", "",
             "labels of organs whose light is summed for each value, with errors of the sums; "
             "\"plant+kind\" for each pair of values"},
            &RunSpec::groups, WordsDomain{"LABEL"}),
        integer_option(
            {"layers", "",
             "layers of equal height, from the ground, or the lowest point if lower, to "
             "the highest of the organs, whose light is summed; 0: none"},
            &RunSpec::layers, {0, kMostLayers}),
        plain_option(
            {"layer_heights", "",
             "instead of layers: the heights between them, ascending, in the unit of length"},
            &RunSpec::layer_heights, RealsDomain{}, as_reals),
    };
}

std::vector<Option> make_table() {
    std::vector<Option> table = rows_of_paths();
    for (const auto& more : {rows_of_engine(), rows_of_ends(), rows_of_groups()}) {
        table.insert(table.end(), more.begin(), more.end());
    }
    return table;
}

}  // namespace

std::span<const Option> option_table() {
    static const std::vector<Option> table = make_table();
    return table;
}

}  // namespace quasimc
