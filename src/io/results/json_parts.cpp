#include "io/results/json_parts.h"

#include "io/runfile/options.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

void write_band_audit(
    JsonStream& json, const std::string& unit, const BandAudit& audit, JsonLayout layout) {
    json.begin_object(layout);
    json.text("unit", unit);
    json.real("reduced_chi_square", audit.reduced_chi_square);
    json.real("degrees_of_freedom", audit.freedom);
    json.real("chi_square_chance", audit.chi_chance);
    json.real("difference", audit.difference);
    json.real("standard_error", audit.standard_error);
    json.real("difference_chance", audit.difference_chance);
    json.end_object();
}

void write_budget(
    JsonStream& json, const std::string& unit, const BandBudget& budget, JsonLayout layout) {
    json.begin_object(layout);
    json.text("unit", unit);
    json.real("emitted", budget.emitted.mean);
    json.real("emitted_standard_error", budget.emitted.standard_error);
    json_estimate(json, "absorbed_by_organs", budget.absorbed_by_organs, layout);
    json_estimate(json, "absorbed_by_ground", budget.absorbed_by_ground, layout);
    json_estimate(json, "escaped", budget.escaped, layout);
    json_estimate(json, "cut_off", budget.cut_off, layout);
    json_estimate(json, "roulette", budget.roulette, layout);
    json.real("closure_error", budget.closure_error);
    json.end_object();
}

}  // namespace

std::string_view stop_name(StopReason stop) {
    switch (stop) {
        case StopReason::target_reached:
            return "target_reached";
        case StopReason::time_is_up:
            return "time_is_up";
        case StopReason::path_limit:
            return "path_limit";
        case StopReason::interrupted:
            return "interrupted";
        case StopReason::no_light:
            return "no_light";
        default:
            return "paths_done";
    }
}

void json_estimate(
    JsonStream& json, std::string_view key, const Estimate& estimate, JsonLayout layout) {
    const Estimate e = reported(estimate);
    json.key(key);
    json.begin_object(layout);
    json.real("mean", e.mean);
    json.real("standard_error", e.standard_error);
    json.real("low", e.low);
    json.real("high", e.high);
    json.end_object();
}

void json_method(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    json.key("method");
    json.begin_object(layout);
    json.text("used", method_name(result.chosen.method));
    json.text("asked", method_name(run.spec.method));
    json.text("reason", result.chosen.reason);
    json.end_object();
}

void json_done(JsonStream& json, const Result& result, JsonLayout layout) {
    json.key("done");
    json.begin_object(layout);
    json.count("paths", result.paths);
    json.count("replicates", result.replicates);
    json.count("rays", result.rays);
    json.text("stop", stop_name(result.stop));
    json.real("fraction_at_target", result.fraction_at_target);
    json.end_object();
}

void json_rounds(JsonStream& json, const Result& result, JsonLayout layout) {
    if (result.rounds.empty()) {
        return;
    }
    json.key("rounds");
    json.begin_list(layout);
    for (const RoundErrors& round : result.rounds) {
        json.begin_object(layout);
        json.count("paths", round.paths);
        json.real("seconds", round.seconds);
        json.real("median_error", round.median);
        json.real("worst_error", round.worst);
        json.real("fraction_at_target", round.fraction_at_target);
        json.end_object();
    }
    json.end_list();
}

void json_audit(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    json.key("audit");
    if (!result.audit) {
        json.null();
        return;
    }
    const Audit& audit = *result.audit;
    const Scene& scene = run.scene;
    json.begin_object(layout);
    json.count("paths", audit.paths);
    json.count("replicates", audit.replicates);
    json.real("chance", audit.chance);
    json.real("level", kAuditLevel);
    json.boolean("agrees", audit.agrees());
    json.key("bands");
    json.begin_object(layout);
    for (std::size_t b = 0; b < audit.bands.size(); ++b) {
        const Band& band = scene.bands()[b];
        json.key(band.name);
        write_band_audit(json, flux_unit(band.unit, scene.length_unit()), audit.bands[b], layout);
    }
    json.end_object();
    json.end_object();
}

void json_energy(
    JsonStream& json,
    std::span<const Band> bands,
    const std::string& length_unit,
    const Result& result,
    JsonLayout layout) {
    json.key("energy");
    json.begin_object(layout);
    for (std::size_t b = 0; b < result.budget.size(); ++b) {
        json.key(bands[b].name);
        write_budget(json, flux_unit(bands[b].unit, length_unit), result.budget[b], layout);
    }
    json.end_object();
}

}  // namespace quasimc
