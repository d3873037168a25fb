// Directives for the method and the returned quantities.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "coupling/vlab/directive_table.h"
#include "solvers/catalogue.h"
#include "solvers/run_limits.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

void ignore(Values& values, DirectiveContext& /*context*/) {
    static_cast<void>(values.rest());
}

void read_verbose(Values& values, DirectiveContext& context) {
    // MonteCarlo uses on and off.
    Values word = values;
    const std::string said = lower_case(word.word());
    if (said == "on" || said == "off") {
        context.spec.verbose = said == "on" ? 1 : 0;
        values = word;
    } else if (const auto level = values.integer("the level", {0, 3})) {
        context.spec.verbose = static_cast<int>(*level);
    }
}

void read_sensors(Values& values, DirectiveContext& context) {
    const std::optional<bool> on = values.yes_no();
    const std::optional<double> angle = values.number_or(90, "the field of view", {0, 90});
    if (angle && *angle == 0) {
        values.fault("the field of view is 0", "no light would be received");
        return;
    }
    if (on && angle && *on) {
        context.spec.sensor_half_angle_deg = *angle;
    }
}

void read_depth(Values& values, DirectiveContext& context) {
    constexpr std::int64_t kWithoutLimit = 1000;
    const auto depth = values.integer("the number of hits", {-1, 1e9});
    if (depth && *depth == 0) {
        values.fault("the number of hits is 0", "no ray would be counted", "write -1 for no limit");
    } else if (depth) {
        context.spec.run.max_depth =
            *depth < 0 || *depth > kWithoutLimit ? 0 : static_cast<std::uint32_t>(*depth);
    }
}

void read_runs(Values& values, DirectiveContext& context) {
    if (const auto runs = values.integer("the number of runs", {1, 10000})) {
        context.spec.run.replicates = static_cast<std::uint32_t>(*runs);
    }
}

void read_rays(Values& values, DirectiveContext& context) {
    if (const auto rays = values.integer("the number of rays", {1, kMaxPaths})) {
        context.spec.run.paths = static_cast<std::uint64_t>(*rays);
    }
}

void read_one_ray(Values& values, DirectiveContext& context) {
    context.spec.one_ray_per_spectrum = values.yes_no().value_or(true);
}

void read_ignore_direct(Values& values, DirectiveContext& context) {
    const bool ignores = values.yes_no().value_or(false);
    context.spec.run.direct_light = ignores ? DirectLight::excluded : DirectLight::included;
}

void read_roulette(Values& values, DirectiveContext& context) {
    const auto threshold = values.number("the threshold", kNotNegativeNumber);
    const auto probability = values.number_or(0.7, "the probability", {0, 1});
    if (!threshold || !probability || *threshold == 0) {
        return;
    }
    // Russian roulette: below this weight a path survives with a probability equal to its weight.
    context.spec.run.roulette_threshold = std::min(*threshold, 1.0);
}

void read_sampler(Values& values, DirectiveContext& context) {
    constexpr std::array<std::string_view, 6> kNames{"monte carlo", "korobov", "sobol",
                                                     "halton",      "faure",   "poly-korobov"};
    constexpr std::array<std::string_view, 6> kSamplers{"monte_carlo", "korobov", "sobol",
                                                        "halton",      "faure",   "sobol"};
    const std::string given = lower_case(values.word());
    static_cast<void>(values.rest());  // "monte carlo": the first word is enough
    if (given.empty()) {
        values.fault("the value is missing", "", did_you_mean(given, kNames));
        return;
    }
    // An unknown name means Monte Carlo, as in the original program.
    const auto* const found = std::find(kNames.begin(), kNames.end(), given);
    const bool is_known = found != kNames.end();
    context.spec.run.sampler = is_known ? kSamplers[found - kNames.begin()] : kSamplers.front();
    if (!is_known && !given.starts_with("monte")) {
        values.notice(fmt::format(
            "{} is unknown: Monte Carlo is used; {}", shown(given), did_you_mean(given, kNames)));
    } else if (given == "poly-korobov") {
        values.notice("polynomial lattices are not supported: Sobol' points are used");
    }
}

void read_method(Values& values, DirectiveContext& context) {
    std::vector<std::string_view> names{"auto"};
    for (const SolverEntry& solver : solver_catalogue()) {
        names.push_back(solver.name);
    }
    if (const auto chosen = values.choice(names)) {
        context.spec.run.method =
            *chosen == 0 ? Method::automatic : solver_catalogue()[*chosen - 1].method;
    }
}

void read_seed(Values& values, DirectiveContext& context) {
    if (const auto seed = values.integer("the seed", {0, 0x1p53})) {
        context.spec.run.seed = static_cast<std::uint64_t>(*seed);
    }
}

void read_threads(Values& values, DirectiveContext& context) {
    if (const auto threads = values.integer("the number of threads", {0, 4096})) {
        context.spec.run.threads = static_cast<unsigned>(*threads);
    }
}

void read_target(Values& values, DirectiveContext& context) {
    const auto target = values.number("the relative standard error", {0, 0.999});
    const auto fraction = values.number_or(0.95, "the fraction of the organs", {1e-6, 1});
    if (!target || !fraction) {
        return;
    }
    RunSpec& run = context.spec.run;
    run.target_error = *target;
    run.target_fraction = *fraction;
}

void read_seconds(Values& values, DirectiveContext& context) {
    if (const auto seconds = values.number("the time", kNotNegativeNumber)) {
        context.spec.run.max_seconds = *seconds;
    }
}

void read_return_type(Values& values, DirectiveContext& context) {
    constexpr std::array<std::string_view, 5> kLetters{"F", "D", "U", "L", "H"};
    std::vector<ReturnType> types;
    while (!values.at_end() && !values.failed()) {
        if (const auto type = values.choice(kLetters)) {
            types.push_back(static_cast<ReturnType>(*type));
        }
    }
    const std::size_t bands = context.spec.band_count();
    if (!values.failed() && types.empty()) {
        values.fault("the letters are missing", "", "give one for each band: F, D, U, L or H");
    } else if (types.size() > bands) {
        values.notice(fmt::format(
            "{} letters for the {} of 'spectrum samples'; the first ones are used", types.size(),
            counted(bands, "band")));
        types.resize(bands);
    }
    context.spec.returns = types;
}

/// A name of the table of quantities, with "_error" behind it for the standard error.
std::optional<ReturnQuantity> quantity_named(std::string_view word) {
    constexpr std::string_view kError = "_error";
    const bool is_error = word.ends_with(kError);
    if (is_error) {
        word.remove_suffix(kError.size());
    }
    if (word == "sunlit_fraction") {
        return ReturnQuantity{std::nullopt, is_error};
    }
    for (const QuantityEntry& entry : quantity_table()) {
        if (entry.name == word) {
            return ReturnQuantity{entry.quantity, is_error};
        }
    }
    return std::nullopt;
}

void read_quantities(Values& values, DirectiveContext& context) {
    std::vector<std::string_view> names{"sunlit_fraction"};
    names.reserve(1 + kQuantities);
    for (const QuantityEntry& entry : quantity_table()) {
        names.push_back(entry.name);
    }
    context.spec.quantities.clear();
    while (!values.at_end()) {
        const std::string_view word = values.word();
        const auto quantity = quantity_named(word);
        if (!quantity) {
            values.fault(
                fmt::format("{} is not a quantity", shown(word)), "", did_you_mean(word, names));
            return;
        }
        context.spec.quantities.push_back(*quantity);
    }
    if (context.spec.quantities.empty()) {
        values.fault("a quantity is missing", "", did_you_mean("", names));
    }
}

void read_variance(Values& values, DirectiveContext& context) {
    const std::optional<bool> on = values.yes_no();
    const std::string name = values.rest();
    auto& file = context.spec.variance_file;
    if (on && *on) {
        // The directive has two names; the first may include the name of the file.
        file = VarianceFile{name.empty() && file ? file->name : name};
    } else if (on) {
        context.spec.variance_file.reset();
    }
}

void read_picture(Values& values, DirectiveContext& context) {
    const std::string name = values.rest();
    if (name.empty()) {
        values.fault("the name of a file is missing");
        return;
    }
    context.spec.picture_file = name;
}

void read_view(Values& values, DirectiveContext& context) {
    constexpr double kLastPort = 65535;
    const std::optional<bool> on = values.yes_no();
    const std::optional<std::int64_t> port =
        values.at_end() ? 0 : values.integer("the port", {0, kLastPort});
    if (on && port) {
        context.spec.view_port = *on ? std::optional(static_cast<int>(*port)) : std::nullopt;
    }
}

void read_density(Values& values, DirectiveContext& context) {
    const auto density = values.number("the number of rays per unit of area", kNotNegativeNumber);
    if (density && *density == 0) {
        values.fault("the density is 0", "no ray would be started");
    } else if (density) {
        context.spec.ray_density = *density;
    }
}

constexpr std::array kRunDirectives{
    DirectiveEntry{"verbose", Dialect::both, read_verbose},
    DirectiveEntry{"remove objects", Dialect::both, ignore},
    DirectiveEntry{"visualization", Dialect::both, ignore},
    DirectiveEntry{"grid size", Dialect::both, ignore},
    DirectiveEntry{"stratified sampling", Dialect::montecarlo, ignore},
    DirectiveEntry{"rays from objects", Dialect::both, read_sensors},
    DirectiveEntry{"maximum depth", Dialect::both, read_depth},
    DirectiveEntry{"number of runs", Dialect::both, read_runs},
    DirectiveEntry{"number of rays", Dialect::quasimc, read_rays},
    DirectiveEntry{"ray density", Dialect::montecarlo, read_density},
    DirectiveEntry{"one ray per spectrum", Dialect::both, read_one_ray},
    DirectiveEntry{"ignore direct light", Dialect::both, read_ignore_direct},
    DirectiveEntry{"russian roulette", Dialect::both, read_roulette},
    DirectiveEntry{"sampling method", Dialect::quasimc, read_sampler},
    DirectiveEntry{"method", Dialect::both, read_method},
    DirectiveEntry{"seed", Dialect::both, read_seed},
    DirectiveEntry{"number of threads", Dialect::both, read_threads},
    DirectiveEntry{"target error", Dialect::both, read_target},
    DirectiveEntry{"maximum seconds", Dialect::both, read_seconds},
    DirectiveEntry{"return type", Dialect::quasimc, read_return_type},
    DirectiveEntry{"quantities", Dialect::both, read_quantities},
    DirectiveEntry{"return variance", Dialect::both, read_variance},
    DirectiveEntry{"output file", Dialect::both, read_variance},
    DirectiveEntry{"picture file", Dialect::both, read_picture},
    DirectiveEntry{"view", Dialect::both, read_view},
};

}  // namespace

std::span<const DirectiveEntry> run_directives() {
    return kRunDirectives;
}

}  // namespace quasimc
