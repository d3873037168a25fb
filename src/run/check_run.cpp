#include <algorithm>
#include <bit>
#include <cmath>

#include <fmt/format.h>

#include "base/checks.h"
#include "base/text.h"
#include "detectors/catalogue.h"
#include "quasimc/run.h"
#include "results/groups.h"
#include "results/question.h"
#include "run/known_parts.h"
#include "run/sensor_run.h"
#include "samplers/catalogue.h"
#include "solvers/catalogue.h"
#include "solvers/ray_bundles/bundle_memory.h"
#include "solvers/ray_bundles/ray_bundles.h"
#include "solvers/run_limits.h"

namespace quasimc {
namespace {

void check_sampler(const RunSpec& spec, Faults& faults) {
    std::vector<std::string_view> names;
    for (const SamplerEntry& entry : sampler_catalogue()) {
        names.push_back(entry.name);
    }
    if (std::find(names.begin(), names.end(), spec.sampler) == names.end()) {
        faults.add(
            {"sampler", fmt::format("'{}' is not a sampler", spec.sampler), "",
             did_you_mean(spec.sampler, names)});
        return;
    }
    if (make_sampler(spec.sampler)->needs_power_of_two() && spec.paths > 0 &&
        !std::has_single_bit(spec.paths)) {
        faults.add(
            {"paths", fmt::format("{} is not a power of two", spec.paths),
             fmt::format("the {} lattice is made for whole powers of two", spec.sampler),
             fmt::format("use {}", std::bit_ceil(spec.paths))});
    }
}

void check_numbers(const RunSpec& spec, Faults& faults) {
    const auto require = [&](bool good, std::string_view where, std::string problem,
                             std::string why) {
        if (!good) {
            faults.add({std::string(where), std::move(problem), std::move(why), ""});
        }
    };
    require(
        spec.paths >= 1 && spec.paths <= kMaxPaths, "paths", fmt::format("{}", spec.paths),
        "1 to 2^30");
    require(
        spec.replicates >= 1 && spec.replicates <= kMaxReplicates, "replicates",
        fmt::format("{}", spec.replicates), fmt::format("1 to {}", kMaxReplicates));
    require(
        spec.threads <= kMaxThreads, "threads", fmt::format("{}", spec.threads),
        fmt::format("0 to {}", kMaxThreads));
    require(
        spec.target_error >= 0 && spec.target_error < 1, "target_error",
        shortest(spec.target_error), "0 to 1, 0 for none");
    require(
        spec.target_fraction > 0 && spec.target_fraction <= 1, "target_fraction",
        shortest(spec.target_fraction), "above 0, at most 1");
    require(
        spec.max_seconds >= 0 && std::isfinite(spec.max_seconds), "max_seconds",
        shortest(spec.max_seconds), "0 for no limit, or more");
    require(
        spec.tally_memory_mb >= 0 && std::isfinite(spec.tally_memory_mb), "tally_memory_mb",
        shortest(spec.tally_memory_mb), "0 or more");
    require(
        spec.roulette_threshold > 0 && spec.roulette_threshold <= 1, "roulette_threshold",
        shortest(spec.roulette_threshold), "above 0, at most 1");
    require(
        spec.target_error == 0 || spec.replicates >= 2, "target_error",
        "at least 2 replicates are needed", "one replicate has no standard error");
    require(
        spec.audit >= 0 && spec.audit <= 1, "audit", shortest(spec.audit), "0 to 1, 0 for none");
    require(
        !(spec.audit > 0) || spec.replicates >= 2, "audit", "at least 2 replicates are needed",
        "one replicate has no standard error");
    require(
        spec.max_paths == 0 || (spec.max_paths >= spec.paths && spec.max_paths <= kMaxPaths),
        "max_paths", fmt::format("{}", spec.max_paths), "0, or from paths to 2^30");
}

void check_ratios(const Scene& scene, const RunSpec& spec, Faults& faults) {
    for (const std::string& ratio : spec.ratios) {
        const std::size_t colon = ratio.find(':');
        if (colon == std::string::npos || ratio.find(':', colon + 1) != std::string::npos) {
            faults.add(
                {"ratios", fmt::format("'{}' is not a ratio of two bands", ratio), "",
                 "write it as \"R:FR\""});
            continue;
        }
        for (const std::string& name : {ratio.substr(0, colon), ratio.substr(colon + 1)}) {
            check_band(scene, "ratios", name, faults);
        }
    }
}

/// Checks for labels with the name of other groups of the result, whose rows would be ambiguous.
void check_group_names(const Scene& scene, const RunSpec& spec, Faults& faults) {
    const bool has_layers = spec.layers > 0 || !spec.layer_heights.empty();
    for (const std::string& key : spec.groups) {
        const bool is_taken = key == kAllOrgans || (key == kLayer && has_layers);
        const auto has_label = [&](const Organ& organ) {
            return find_label(organ.labels, key) != nullptr;
        };
        if (is_taken && std::any_of(scene.organs().begin(), scene.organs().end(), has_label)) {
            faults.add(
                {"groups", fmt::format("'{}' is a label with the name of other groups", key),
                 "their rows could not be distinguished", "rename the label"});
        }
    }
}

void check_organs(const Scene& scene, const RunSpec& spec, Faults& faults) {
    const auto is_measured = [](const Organ& organ) { return organ.measured; };
    if (spec.method == Method::from_organs &&
        std::none_of(scene.organs().begin(), scene.organs().end(), is_measured)) {
        faults.add(
            {"method", "no organ is measured", "paths have no organs to start from",
             "remove measured = false from the organs whose light you need"});
    }
}

void check_irradiance(const Source& source, double x, Faults& faults) {
    const std::string where = fmt::format("source '{}'", source.name());
    if (!(x >= 0) || !std::isfinite(x)) {
        faults.add({where, fmt::format("irradiance {}", shortest(x)), "0 or more", ""});
    }
}

void check_sources(const Scene& scene, const Sources& sources, Faults& faults) {
    if (sources.empty()) {
        faults.add({"sources", "there are none", "", "add a source"});
    }
    bool dark = !sources.empty();
    for (const auto& source : sources) {
        const auto spectrum = source->spectrum();
        if (spectrum.size() != scene.bands().size()) {
            faults.add(
                {fmt::format("source '{}'", source->name()),
                 fmt::format("{} irradiances", spectrum.size()),
                 fmt::format("the scene has {} bands", scene.bands().size()), ""});
        }
        for (const double x : spectrum) {
            check_irradiance(*source, x, faults);
            dark = dark && x == 0;
        }
    }
    if (dark) {
        faults.add(
            {"sources", "no source gives light",
             fmt::format("irradiances below {} count as 0", shortest(kMinIrradiance)), ""});
    }
}

/// Checks for lamps in periodic scenes: points on organs would have to sample an infinite number of
/// them.
void check_lamps(const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults) {
    const bool has_lamp = std::any_of(
        sources.begin(), sources.end(), [](const auto& source) { return source->is_lamp(); });
    if (has_lamp && scene.cell().periodic() && spec.method == Method::from_organs) {
        faults.add(
            {"method", "from_organs does not support lamps in a periodic scene",
             "paths would have to choose one of infinitely many copies of the lamp",
             "use method = \"light_tracing\""});
    }
}

/// Checks for methods that do not trace escaping light, where some detector needs it.
void check_detected_light(const Scene& scene, const RunSpec& spec, Faults& faults) {
    const SolverEntry* solver = find_solver(spec.method);
    if (solver != nullptr && solver->escaped == EscapedLight::remainder &&
        need_escaped_light(scene.detectors())) {
        faults.add(
            {"method", fmt::format("{} does not follow escaping light", solver->name),
             "a detector needs it", "use method = \"light_tracing\""});
    }
}

/// Checks what depends on organs.
void check_on_scene(const Scene& scene, const RunSpec& spec, Faults& faults) {
    check_organs(scene, spec, faults);
    check_detected_light(scene, spec, faults);
    if (spec.method == Method::ray_bundles) {
        check_diffuse(scene, faults);
    }
}

/// Checks what depends on organs and sources.
void check_lit_scene(
    const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults) {
    check_lamps(scene, sources, spec, faults);
    check_sensor_light(scene, sources, faults);
    if (spec.method == Method::ray_bundles) {
        check_bundle_memory(scene, sources, spec, faults);
    }
}

}  // namespace

void check_run(const Scene& scene, const Sources& sources, const RunSpec& spec, Faults& faults) {
    check_known_parts(scene, sources, spec, {}, faults);
}

void check_known_parts(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const KnownParts& known,
    Faults& faults) {
    if (known.sources) {
        check_sources(scene, sources, faults);
    }
    if (known.sources && known.scene && known.sensors) {
        check_lit_scene(scene, sources, spec, faults);
    }
    if (known.knows({"sampler", "paths"})) {
        check_sampler(spec, faults);
    }
    if (known.knows({"paths", "max_paths", "replicates"})) {
        check_numbers(spec, faults);
    }
    if (known.bands) {
        check_ratios(scene, spec, faults);
    }
    if (known.knows_groups()) {
        check_groups(scene, group_spec(spec), faults);
        check_group_names(scene, spec, faults);
    } else {
        check_layer_heights(group_spec(spec), faults);
    }
    if (known.scene) {
        check_on_scene(scene, spec, faults);
    }
    if (known.sensors && known.knows_groups() && known.knows({"target"})) {
        check_target(scene, spec, faults);
    }
}

}  // namespace quasimc
