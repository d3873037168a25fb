#include "io/results/json_parts.h"

#include "io/runfile/options.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

void write_estimate(JsonStream& json, std::string_view key, const Estimate& e, JsonLayout layout) {
    json.key(key);
    json.begin_object(layout);
    write_real(json, "mean", e.mean);
    write_real(json, "standard_error", e.standard_error);
    write_real(json, "low", e.low);
    write_real(json, "high", e.high);
    json.end_object();
}

std::string_view stop_name(StopReason stop) {
    switch (stop) {
        case StopReason::target_reached:
            return "target_reached";
        case StopReason::time_is_up:
            return "time_is_up";
        case StopReason::path_limit:
            return "path_limit";
        default:
            return "paths_done";
    }
}

void write_band_audit(
    JsonStream& json, const std::string& unit, const BandAudit& audit, JsonLayout layout) {
    json.begin_object(layout);
    write_text(json, "unit", unit);
    write_real(json, "reduced_chi_square", audit.reduced_chi_square);
    write_real(json, "degrees_of_freedom", audit.freedom);
    write_real(json, "chi_square_chance", audit.chi_chance);
    write_real(json, "difference", audit.difference);
    write_real(json, "standard_error", audit.standard_error);
    write_real(json, "difference_chance", audit.difference_chance);
    json.end_object();
}

void write_budget(
    JsonStream& json, const std::string& unit, const BandBudget& budget, JsonLayout layout) {
    json.begin_object(layout);
    write_text(json, "unit", unit);
    write_real(json, "emitted", budget.emitted);
    write_estimate(json, "absorbed_by_organs", budget.absorbed_by_organs, layout);
    write_estimate(json, "absorbed_by_ground", budget.absorbed_by_ground, layout);
    write_estimate(json, "escaped", budget.escaped, layout);
    write_estimate(json, "cut_off", budget.cut_off, layout);
    write_estimate(json, "roulette", budget.roulette, layout);
    write_real(json, "closure_error", budget.closure_error);
    json.end_object();
}

}  // namespace

void json_method(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    json.key("method");
    json.begin_object(layout);
    write_text(json, "used", method_name(result.chosen.method));
    write_text(json, "asked", method_name(run.spec.method));
    write_text(json, "reason", result.chosen.reason);
    json.end_object();
}

void json_done(JsonStream& json, const Result& result, JsonLayout layout) {
    json.key("done");
    json.begin_object(layout);
    write_count(json, "paths", result.paths);
    write_count(json, "replicates", result.replicates);
    write_count(json, "rays", result.rays);
    write_text(json, "stop", stop_name(result.stop));
    write_real(json, "fraction_at_target", result.fraction_at_target);
    json.end_object();
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
    write_count(json, "paths", audit.paths);
    write_count(json, "replicates", audit.replicates);
    write_real(json, "chance", audit.chance);
    write_real(json, "level", kAuditLevel);
    json.key("agrees");
    json.boolean(audit.agrees());
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

void json_energy(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    const Scene& scene = run.scene;
    json.key("energy");
    json.begin_object(layout);
    for (std::size_t b = 0; b < result.budget.size(); ++b) {
        const Band& band = scene.bands()[b];
        json.key(band.name);
        write_budget(json, flux_unit(band.unit, scene.length_unit()), result.budget[b], layout);
    }
    json.end_object();
}

}  // namespace quasimc
