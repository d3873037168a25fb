#include "resultio/json_parts.h"

#include <nlohmann/json.hpp>

#include "options/options.h"
#include "quasimc/version.h"
#include "results/fraction_table.h"
#include "results/units.h"

namespace quasimc {
namespace {

Json inputs_of(const std::vector<InputFile>& inputs) {
    Json list = Json::array();
    for (const InputFile& input : inputs) {
        list.push_back(
            {{"path", input.path},
             {"absolute_path", input.absolute_path},
             {"sha256", input.sha256},
             {"bytes", input.bytes},
             {"is_run_file", input.is_run_file}});
    }
    return list;
}

Json scene_of(const Scene& scene) {
    const Orientation& axes = scene.orientation();
    return {
        {"organs", scene.organs().size()},
        {"triangles", scene.triangle_count()},
        {"length_unit", scene.length_unit()},
        {"axes",
         {{"up", axes.up() == UpAxis::z ? "z" : "y"}, {"north", json_vector(axes.north())}}}};
}

Json quantities_of(const RunFile& run) {
    const WrittenColumns columns = written_columns(run);
    Json list = Json::array();
    for (const QuantityEntry& entry : columns.quantities) {
        Json units = Json::object();
        for (const std::size_t b : columns.bands) {
            const Band& band = run.scene.bands()[b];
            units[band.name] = unit_of(entry, band, run.scene.length_unit());
        }
        list.push_back({{"name", entry.name}, {"meaning", entry.summary}, {"unit", units}});
    }
    for (const SunShadeEntry& entry : columns.parts) {
        Json unit = "1";
        if (entry.has_bands()) {
            unit = Json::object();
            for (const std::size_t b : columns.bands) {
                unit[run.scene.bands()[b].name] = run.scene.bands()[b].unit;
            }
        }
        list.push_back({{"name", entry.name}, {"meaning", entry.summary}, {"unit", unit}});
    }
    return list;
}

Json rounds_of(const Result& result) {
    Json list = Json::array();
    for (const RoundErrors& round : result.rounds) {
        list.push_back(
            {{"paths", round.paths},
             {"seconds", round.seconds},
             {"median_error", round.median},
             {"worst_error", round.worst},
             {"fraction_at_target", round.fraction_at_target}});
    }
    return list;
}

Json energy_of(std::span<const Band> bands, const std::string& length_unit, const Result& result) {
    Json object = Json::object();
    for (std::size_t b = 0; b < result.budget.size(); ++b) {
        const BandBudget& budget = result.budget[b];
        object[bands[b].name] = {
            {"unit", flux_unit(bands[b].unit, length_unit)},
            {"emitted", budget.emitted.mean},
            {"emitted_standard_error", budget.emitted.standard_error},
            {"absorbed_by_organs", json_estimate(budget.absorbed_by_organs)},
            {"absorbed_by_ground", json_estimate(budget.absorbed_by_ground)},
            {"escaped", json_estimate(budget.escaped)},
            {"cut_off", json_estimate(budget.cut_off)},
            {"imbalance", json_estimate(budget.imbalance)},
            {"closure_error", budget.closure_error}};
    }
    return object;
}

Json audit_of(const Scene& scene, const std::optional<Audit>& audit) {
    if (!audit) {
        return nullptr;
    }
    Json bands = Json::object();
    for (std::size_t b = 0; b < audit->bands.size(); ++b) {
        const Band& band = scene.bands()[b];
        const BandAudit& found = audit->bands[b];
        bands[band.name] = {
            {"unit", flux_unit(band.unit, scene.length_unit())},
            {"reduced_chi_square", found.reduced_chi_square},
            {"degrees_of_freedom", found.freedom},
            {"chi_square_p_value", found.chi_square_p_value},
            {"difference", found.difference},
            {"standard_error", found.standard_error},
            {"difference_p_value", found.difference_p_value}};
    }
    return {{"paths", audit->paths}, {"replicates", audit->replicates}, {"p_value", audit->p_value},
            {"level", kAuditLevel},  {"agrees", audit->agrees()},       {"bands", bands}};
}

Json detectors_of(const Scene& scene, const Result& result) {
    Json list = Json::array();
    for (const DetectorResult& detector : result.detectors) {
        Json units = Json::object(), bins = Json::array();
        for (const Band& band : scene.bands()) {
            units[band.name] = flux_unit(band.unit, scene.length_unit());
        }
        for (std::size_t i = 0; i < detector.bins.size(); ++i) {
            Json flux = Json::object();
            for (std::size_t b = 0; b < scene.bands().size(); ++b) {
                flux[scene.bands()[b].name] = json_estimate(detector.at(i, b));
            }
            bins.push_back({{"bin", detector.bins[i]}, {"flux", flux}});
        }
        list.push_back(
            {{"name", detector.name},
             {"type", detector.type},
             {"quantity", detector.quantity},
             {"unit", units},
             {"bins", bins}});
    }
    return list;
}

}  // namespace

Json json_estimate(const Estimate& estimate) {
    const Estimate e = reported(estimate);
    return {
        {"mean", e.mean},
        {"standard_error", e.standard_error},
        {"ci95_low", e.ci95_low},
        {"ci95_high", e.ci95_high}};
}

Json json_head(const RunFile& run) {
    return {{"format", "quasimc-result"},      {"format_version", kResultVersion},
            {"program_version", version()},    {"title", run.title},
            {"run_file_path", run.path},       {"directory", run.folder},
            {"inputs", inputs_of(run.inputs)}, {"run_file", json_value(*run.document)},
            {"scene", scene_of(run.scene)},    {"sources", run.source_notes},
            {"quantities", quantities_of(run)}};
}

Json json_value(const Node& node) {
    if (const auto* table = node.as<Node::Table>()) {
        Json object = Json::object();
        for (const Member& member : *table) {
            object.emplace(member.key, json_value(member.node));
        }
        return object;
    }
    if (const auto* list = node.as<Node::List>()) {
        Json array = Json::array();
        for (const Node& item : *list) {
            array.push_back(json_value(item));
        }
        return array;
    }
    if (const auto* other = node.as<Node::Other>()) {
        return other->text.empty() ? Json() : Json(other->text);
    }
    if (const auto* text = node.as<std::string>()) {
        return *text;
    }
    if (const auto* integer = node.as<std::int64_t>()) {
        return *integer;
    }
    if (const auto* boolean = node.as<bool>()) {
        return *boolean;
    }
    return *node.as<double>();
}

Json json_warnings(const RunFile& run) {
    Json list = Json::array();
    for (const Warning& warning : run.warnings) {
        list.push_back({{"where", warning.where}, {"text", warning.text}});
    }
    return {{"warnings", list}};
}

std::string_view stop_name(StopReason stop) {
    switch (stop) {
        case StopReason::target_reached:
            return "target_reached";
        case StopReason::time_limit:
            return "time_limit";
        case StopReason::path_limit:
            return "path_limit";
        case StopReason::interrupted:
            return "interrupted";
        case StopReason::no_light:
            return "no_light";
        default:
            return "finished";
    }
}

Json json_canopy(
    const Scene& scene,
    const std::vector<CanopyFractions>& canopy,
    const std::vector<std::string>& units) {
    Json object = Json::object();
    for (std::size_t b = 0; b < canopy.size(); ++b) {
        Json& one = object[scene.bands()[b].name];
        one["unit"] = units[b];
        one["incident"] = canopy[b].incident;
        for (const FractionEntry& entry : fraction_table()) {
            one[std::string(entry.name)] = json_estimate(canopy[b].*entry.part);
        }
    }
    return object;
}

Json json_light(std::span<const Band> bands, const std::string& length_unit, const Result& result) {
    Json light = {
        {"method", {{"used", method_name(result.chosen.method)}, {"reason", result.chosen.reason}}},
        {"completed",
         {{"paths", result.paths},
          {"replicates", result.replicates},
          {"rays", result.rays},
          {"stop", stop_name(result.stop)},
          {"fraction_at_target", result.fraction_at_target}}},
        {"energy", energy_of(bands, length_unit, result)},
        {"escaped_by_difference", result.escaped_by_difference}};
    if (!result.rounds.empty()) {
        light["rounds"] = rounds_of(result);
    }
    return light;
}

Json json_light(const RunFile& run, const Result& result) {
    Json light = json_light(run.scene.bands(), run.scene.length_unit(), result);
    light["method"]["requested"] = method_name(run.spec.method);
    light["audit"] = audit_of(run.scene, result.audit);
    if (!result.canopy.empty()) {
        std::vector<std::string> units;
        for (const Band& band : run.scene.bands()) {
            units.push_back(flux_unit(band.unit, run.scene.length_unit()));
        }
        light["canopy"] = json_canopy(run.scene, result.canopy, units);
    }
    if (!result.detectors.empty()) {
        light["detectors"] = detectors_of(run.scene, result);
    }
    return light;
}

Json json_vector(const Vec3& vector) {
    return {vector.x, vector.y, vector.z};
}

}  // namespace quasimc
