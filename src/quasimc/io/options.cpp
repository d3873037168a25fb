#include "quasimc/io/options.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "quasimc/base/text.h"
#include "quasimc/io/numbers.h"
#include "quasimc/samplers/catalogue.h"

namespace quasimc {
namespace {

constexpr std::int64_t kMostPaths = std::int64_t{1} << 30;
constexpr double kLongestRun = 1e9;  // seconds

/// Words of a row that don't depend on the field's type.
struct Words {
    std::string_view key, unit, summary;
};

template <typename T>
Option integer_option(Words words, T RunSpec::*field, IntegerDomain domain) {
    return {
        words.key,
        words.unit,
        words.summary,
        domain,
        [field](RunSpec& spec, const OptionValue& value) {
            spec.*field = static_cast<T>(std::get<std::int64_t>(value));
        },
        [field](const RunSpec& spec) -> OptionValue {
            return static_cast<std::int64_t>(spec.*field);
        }};
}

double as_real(const OptionValue& value) {
    const auto* integer = std::get_if<std::int64_t>(&value);
    return integer ? static_cast<double>(*integer) : std::get<double>(value);
}

Option real_option(Words words, double RunSpec::*field, RealDomain domain) {
    return {
        words.key,
        words.unit,
        words.summary,
        domain,
        [field](RunSpec& spec, const OptionValue& value) { spec.*field = as_real(value); },
        [field](const RunSpec& spec) -> OptionValue { return spec.*field; }};
}

template <typename Enum>
using Named = std::vector<std::pair<std::string_view, Enum>>;

template <typename Enum>
Option choice_option(Words words, Enum RunSpec::*field, const Named<Enum>& values) {
    ChoiceDomain domain;
    for (const auto& [name, value] : values) {
        domain.names.push_back(name);
    }
    return {
        words.key,
        words.unit,
        words.summary,
        domain,
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

Option sampler_option(Words words) {
    ChoiceDomain domain;
    for (const SamplerEntry& entry : sampler_catalogue()) {
        domain.names.push_back(entry.name);
    }
    return {
        words.key,
        words.unit,
        words.summary,
        domain,
        [](RunSpec& spec, const OptionValue& value) {
            spec.sampler = std::get<std::string>(value);
        },
        [](const RunSpec& spec) -> OptionValue { return spec.sampler; }};
}

Option words_option(Words words, std::vector<std::string> RunSpec::*field, WordsDomain domain) {
    return {
        words.key,
        words.unit,
        words.summary,
        domain,
        [field](RunSpec& spec, const OptionValue& value) {
            spec.*field = std::get<std::vector<std::string>>(value);
        },
        [field](const RunSpec& spec) -> OptionValue { return spec.*field; }};
}

// THE TABLE.
//
// To add an option of a run: add a field with its default to RunSpec (tracing/run_spec.h) and a row
// here. The key in [run], the flag of the program, the range check with its message,
// --dump-default, the table in docs/guide/options.md (copy it from `quasimc list options
// --markdown`; a test compares) and the echo in the JSON result follow from the row.
std::vector<Option> make_table() {
    constexpr std::int64_t kAnySeed = std::numeric_limits<std::int64_t>::max();
    return {
        sampler_option({"sampler", "", "point set that the paths are made from"}),
        choice_option<TraceFrom>(
            {"trace_from", "",
             "where paths start: lit_surfaces (suns), sources (many organs) or organs (few or "
             "small "
             "organs, skies)"},
            &RunSpec::trace_from,
            {{"sources", TraceFrom::sources},
             {"organs", TraceFrom::organs},
             {"lit_surfaces", TraceFrom::lit_surfaces}}),
        integer_option(
            {"paths", "", "paths of each replicate; a power of two is best"}, &RunSpec::paths,
            {1, kMostPaths}),
        integer_option(
            {"replicates", "",
             "independent randomizations; the standard errors come from their scatter"},
            &RunSpec::replicates, {1, 10000}),
        integer_option(
            {"seed", "", "another seed gives other random numbers"}, &RunSpec::seed, {0, kAnySeed}),
        integer_option(
            {"threads", "", "0: as many as the machine has; never changes a result"},
            &RunSpec::threads, {0, 4096}),
        integer_option(
            {"max_depth", "",
             "hits after which a path is cut off (the energy is reported); 0: never"},
            &RunSpec::max_depth, {0, 1000000}),
        real_option(
            {"roulette_weight", "",
             "weight that Russian roulette plays for; 1: at every hit, less: fewer paths end "
             "early"},
            &RunSpec::roulette_weight, {1e-6, 1}),
        choice_option<WindowShape>(
            {"window", "",
             "where light enters: silhouette of the scene, or the disc across its bounding sphere"},
            &RunSpec::window,
            {{"silhouette", WindowShape::silhouette}, {"sphere", WindowShape::sphere}}),
        choice_option<Engine>(
            {"engine", "", "ray engine; brute_force is slow and serves to check the other"},
            &RunSpec::engine, {{"embree", Engine::embree}, {"brute_force", Engine::brute_force}}),
        choice_option<DirectLight>(
            {"direct_light", "",
             "light straight from the sources is counted on organs, or ignored: scattered light "
             "alone"},
            &RunSpec::direct_light,
            {{"counted", DirectLight::counted}, {"ignored", DirectLight::ignored}}),
        real_option(
            {"target_error", "",
             "relative standard error of the absorbed flux to reach, 0.01 for 1 %; 0: none"},
            &RunSpec::target_error, {0, 1}),
        real_option(
            {"target_fraction", "", "fraction of the organs that must reach it in every band"},
            &RunSpec::target_fraction, {0, 1}),
        real_option(
            {"max_seconds", "s", "no new round of paths is begun after that time; 0: no limit"},
            &RunSpec::max_seconds, {0, kLongestRun}),
        integer_option(
            {"max_paths", "",
             "most paths of each replicate in all rounds; 0: 2^30 with a target, else just paths"},
            &RunSpec::max_paths, {0, kMostPaths}),
        real_option(
            {"tally_memory_mb", "MB",
             "private tallies of all threads; larger ones are shared (same results)"},
            &RunSpec::tally_memory_mb, {0, 1e6}),
        words_option(
            {"ratios", "", "ratios of the light of two bands that falls on an organ"},
            &RunSpec::ratios, {"BAND:BAND"}),
    };
}

std::string quoted(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') {
            result += '\\';
        }
        result += c;
    }
    return result + '"';
}

std::string value_words(const OptionValue& value) {
    const auto* text = std::get_if<std::string>(&value);
    return text ? "'" + *text + "'" : option_toml(value);
}

/// What kind of value a domain asks for.
std::string domain_kind(const OptionDomain& domain) {
    switch (domain.index()) {
        case 0:
            return "a whole number";
        case 1:
            return "a number";
        case 2:
            return "a name";
        default:
            return "a list of texts";
    }
}

bool has_right_type(const OptionDomain& domain, const OptionValue& value) {
    const bool integer_for_real =
        std::holds_alternative<RealDomain>(domain) && std::holds_alternative<std::int64_t>(value);
    return integer_for_real || domain.index() == value.index();
}

bool in_domain(const OptionDomain& domain, const OptionValue& value) {
    if (const auto* range = std::get_if<IntegerDomain>(&domain)) {
        const std::int64_t n = std::get<std::int64_t>(value);
        return range->low <= n && n <= range->high;
    }
    if (const auto* range = std::get_if<RealDomain>(&domain)) {
        const double x = as_real(value);
        return std::isfinite(x) && range->low <= x && x <= range->high;
    }
    if (const auto* choice = std::get_if<ChoiceDomain>(&domain)) {
        const auto& names = choice->names;
        return std::find(names.begin(), names.end(), std::get<std::string>(value)) != names.end();
    }
    return true;
}

}  // namespace

std::span<const Option> option_table() {
    static const std::vector<Option> table = make_table();
    return table;
}

const Option* find_option(std::string_view key) {
    const std::span<const Option> table = option_table();
    const auto found = std::find_if(
        table.begin(), table.end(), [key](const Option& option) { return option.key == key; });
    return found == table.end() ? nullptr : &*found;
}

std::string option_flag(const Option& option) {
    std::string flag = "--" + std::string(option.key);
    std::replace(flag.begin(), flag.end(), '_', '-');
    return flag;
}

std::string domain_text(const Option& option) {
    if (const auto* range = std::get_if<IntegerDomain>(&option.domain)) {
        return fmt::format("{} to {}", range->low, range->high);
    }
    if (const auto* range = std::get_if<RealDomain>(&option.domain)) {
        return fmt::format("{} to {}", range->low, range->high);
    }
    if (const auto* choice = std::get_if<ChoiceDomain>(&option.domain)) {
        return "one of " + joined(choice->names, ", ");
    }
    return fmt::format("list of \"{}\"", std::get<WordsDomain>(option.domain).form);
}

std::optional<Fault> check_option(const Option& option, const OptionValue& value) {
    if (!has_right_type(option.domain, value)) {
        return Fault{
            "", fmt::format("{} is {}", option.key, value_words(value)),
            fmt::format("it takes {}: {}", domain_kind(option.domain), domain_text(option)), ""};
    }
    if (in_domain(option.domain, value)) {
        return std::nullopt;
    }
    Fault fault{
        "", fmt::format("{} is {}", option.key, value_words(value)),
        "it takes " + domain_text(option), ""};
    if (const auto* choice = std::get_if<ChoiceDomain>(&option.domain)) {
        fault.why = "no such choice";
        fault.suggestion = did_you_mean(std::get<std::string>(value), choice->names);
    }
    return fault;
}

OptionValue parse_option(const Option& option, std::string_view text) {
    if (std::holds_alternative<IntegerDomain>(option.domain)) {
        if (const auto integer = parse_integer(text)) {
            return *integer;
        }
    }
    if (std::holds_alternative<RealDomain>(option.domain)) {
        if (const auto real = parse_real(text)) {
            return *real;
        }
    }
    if (std::holds_alternative<WordsDomain>(option.domain)) {
        std::vector<std::string> words;
        while (!text.empty()) {
            const std::size_t end = std::min(text.find(','), text.size());
            words.emplace_back(trimmed(text.substr(0, end)));
            text.remove_prefix(std::min(end + 1, text.size()));
        }
        return words;
    }
    return std::string(text);
}

std::string option_toml(const OptionValue& value) {
    if (const auto* integer = std::get_if<std::int64_t>(&value)) {
        return std::to_string(*integer);
    }
    if (const auto* real = std::get_if<double>(&value)) {
        return shortest(*real);
    }
    if (const auto* text = std::get_if<std::string>(&value)) {
        return quoted(*text);
    }
    std::string list;
    for (const std::string& word : std::get<std::vector<std::string>>(value)) {
        list += (list.empty() ? "" : ", ") + quoted(word);
    }
    return "[" + list + "]";
}

std::string default_run_section() {
    std::string text = "[run]\n";
    for (const Option& option : option_table()) {
        const std::string unit = option.unit.empty() ? "" : fmt::format(" [{}]", option.unit);
        text += fmt::format("# {}{}: {}\n", option.summary, unit, domain_text(option));
        text += fmt::format("{} = {}\n", option.key, option_toml(option.get(RunSpec{})));
    }
    return text;
}

std::string options_markdown() {
    std::string text =
        "| Key in `[run]` | Flag | Default | Takes | Meaning |\n|---|---|---|---|---|\n";
    for (const Option& option : option_table()) {
        const std::string unit = option.unit.empty() ? "" : fmt::format(" {}", option.unit);
        text += fmt::format(
            "| `{}` | `{}` | `{}`{} | {} | {} |\n", option.key, option_flag(option),
            option_toml(option.get(RunSpec{})), unit, domain_text(option), option.summary);
    }
    return text;
}

}  // namespace quasimc
