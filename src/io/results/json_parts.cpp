#include "io/results/json_parts.h"

#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/version.h"
#include "io/runfile/options.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

using Json = nlohmann::ordered_json;

std::string dumped(const Json& json, int indent = -1) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

Json to_json(const Node& node) {
    if (const auto* table = node.as<Node::Table>()) {
        Json json = Json::object();
        for (const Member& member : *table) {
            json[member.key] = to_json(member.node);
        }
        return json;
    }
    if (const auto* list = node.as<Node::List>()) {
        Json json = Json::array();
        for (const Node& item : *list) {
            json.push_back(to_json(item));
        }
        return json;
    }
    if (const auto* text = node.as<std::string>()) {
        return *text;
    }
    if (const auto* integer = node.as<std::int64_t>()) {
        return *integer;
    }
    if (const auto* real = node.as<double>()) {
        return *real;
    }
    if (const auto* other = node.as<Node::Other>(); other != nullptr && !other->text.empty()) {
        return other->text;
    }
    const auto* boolean = node.as<bool>();
    return boolean ? Json(*boolean) : Json();
}

Json estimate_json(const Estimate& e) {
    return {
        {"mean", e.mean}, {"standard_error", e.standard_error}, {"low", e.low}, {"high", e.high}};
}

Json inputs_json(const std::vector<InputFile>& inputs) {
    Json list = Json::array();
    for (const InputFile& input : inputs) {
        list.push_back(
            {{"path", input.path},
             {"resolved", input.resolved},
             {"sha256", input.sha256},
             {"bytes", input.bytes},
             {"is_run_file", input.is_run_file}});
    }
    return list;
}

Json axes_json(const Orientation& axes) {
    return {
        {"up", axes.up() == UpAxis::z ? "z" : "y"},
        {"north", {axes.north().x, axes.north().y, axes.north().z}}};
}

Json quantities_json(const Scene& scene) {
    Json list = Json::array();
    for (const QuantityEntry& entry : quantity_table()) {
        Json units = Json::object();
        for (const Band& band : scene.bands()) {
            units[band.name] = unit_of(entry, band, scene.length_unit());
        }
        list.push_back({{"name", entry.name}, {"meaning", entry.summary}, {"unit", units}});
    }
    return list;
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

Json energy_json(const Scene& scene, const Result& result) {
    Json energy = Json::object();
    for (std::size_t b = 0; b < result.budget.size(); ++b) {
        const Band& band = scene.bands()[b];
        const BandBudget& budget = result.budget[b];
        energy[band.name] = {
            {"unit", flux_unit(band.unit, scene.length_unit())},
            {"emitted", budget.emitted},
            {"absorbed_by_organs", estimate_json(budget.absorbed_by_organs)},
            {"absorbed_by_ground", estimate_json(budget.absorbed_by_ground)},
            {"escaped", estimate_json(budget.escaped)},
            {"cut_off", estimate_json(budget.cut_off)},
            {"roulette", estimate_json(budget.roulette)},
            {"closure_error", budget.closure_error}};
    }
    return energy;
}

Json warnings_json(const std::vector<Warning>& warnings) {
    Json list = Json::array();
    for (const Warning& warning : warnings) {
        list.push_back({{"place", warning.place}, {"text", warning.text}});
    }
    return list;
}

Json done_json(const Result& result) {
    return {
        {"paths", result.paths},
        {"replicates", result.replicates},
        {"rays", result.rays},
        {"stop", stop_name(result.stop)},
        {"fraction_at_target", result.fraction_at_target}};
}

Json method_json(const RunSpec& spec, const Result& result) {
    return {
        {"trace_from", method_name(result.chosen.method)},
        {"asked", method_name(spec.method)},
        {"reason", result.chosen.reason}};
}

Json audit_json(const RunFile& run, const Result& result) {
    if (!result.audit) {
        return {};
    }
    const Audit& audit = *result.audit;
    Json bands = Json::object();
    for (std::size_t b = 0; b < audit.bands.size(); ++b) {
        const Band& band = run.scene.bands()[b];
        const BandAudit& own = audit.bands[b];
        bands[band.name] = {
            {"unit", flux_unit(band.unit, run.scene.length_unit())},
            {"chi", own.reduced_chi_square},
            {"chi_freedom", own.freedom},
            {"chi_chance", own.chi_chance},
            {"difference", own.difference},
            {"standard_error", own.standard_error},
            {"difference_chance", own.difference_chance}};
    }
    return {{"paths", audit.paths}, {"replicates", audit.replicates}, {"chance", audit.chance},
            {"level", kAuditLevel}, {"agrees", audit.agrees()},       {"bands", bands}};
}

/// What is known before anything is traced.
Json head_json(const RunFile& run) {
    const Scene& scene = run.scene;
    Json head;
    head["format"] = "quasimc-result";
    head["format_version"] = 1;
    head["program_version"] = version();
    head["title"] = run.title;
    head["run_file"] = run.path;
    head["folder"] = run.folder;
    head["inputs"] = inputs_json(run.inputs);
    head["run"] = to_json(run.document);
    head["scene"] = {
        {"organs", scene.organs().size()},
        {"triangles", scene.triangles().size()},
        {"length_unit", scene.length_unit()},
        {"axes", axes_json(scene.orientation())}};
    head["sources"] = run.source_notes;
    head["quantities"] = quantities_json(scene);
    return head;
}

/// The members of an object, each on lines of its own.
std::string members(const Json& json) {
    std::string text;
    for (const auto& [key, value] : json.items()) {
        text += fmt::format("{}: {},\n", dumped(key), dumped(value, 2));
    }
    return text;
}

/// The part of an organ's object that tells which organ it is, open at the end.
std::string organ_head(const Organ& organ) {
    Json labels = Json::object();
    for (const auto& [key, value] : organ.labels) {
        labels[key] = value;
    }
    std::string out = fmt::format(
        R"({{"id":{},"name":{},"labels":{})", organ.id, dumped(organ.name), dumped(labels));
    out += organ.is_ground ? R"(,"ground":true,"area":)" : R"(,"area":)";
    append_json(out, organ.area);
    return out;
}

}  // namespace

std::string json_head(const RunFile& run) {
    return members(head_json(run));
}

std::string json_result_head(const RunFile& run, const Result& result) {
    Json head;
    head["method"] = method_json(run.spec, result);
    head["done"] = done_json(result);
    head["seconds"] = {
        {"build", result.build_seconds},
        {"trace", result.trace_seconds},
        {"trace_cpu", result.trace_cpu_seconds}};
    head["audit"] = audit_json(run, result);
    head["energy"] = energy_json(run.scene, result);
    head["escaped_is_remainder"] = result.escaped_is_remainder;
    return members(head);
}

std::string json_warnings(const RunFile& run) {
    return members({{"warnings", warnings_json(run.warnings)}});
}

std::string json_quoted(std::string_view text) {
    return dumped(std::string(text));
}

std::string json_method(const RunFile& run, const Result& result) {
    return dumped(method_json(run.spec, result));
}

std::string json_audit(const RunFile& run, const Result& result) {
    return dumped(audit_json(run, result));
}

std::string json_done(const Result& result) {
    return dumped(done_json(result));
}

std::string json_energy(const RunFile& run, const Result& result) {
    return dumped(energy_json(run.scene, result));
}

void append_json(std::string& out, double value) {
    if (std::isfinite(value)) {
        fmt::format_to(std::back_inserter(out), "{}", value);
    } else {
        out += "null";
    }
}

void append_json(std::string& out, const Estimate& e) {
    out += R"({"mean":)";
    append_json(out, e.mean);
    out += R"(,"standard_error":)";
    append_json(out, e.standard_error);
    out += R"(,"low":)";
    append_json(out, e.low);
    out += R"(,"high":)";
    append_json(out, e.high);
    out += '}';
}

std::string json_organ(
    const Organ& organ, const Result& result, std::size_t index, const JsonNames& names) {
    std::string out = organ_head(organ);
    for (const QuantityEntry& entry : quantity_table()) {
        fmt::format_to(std::back_inserter(out), R"(,"{}":{{)", entry.name);
        for (std::size_t b = 0; b < result.bands; ++b) {
            out += (b == 0 ? "" : ",") + names.bands[b] + ":";
            append_json(out, result.at(index, entry.quantity, b));
        }
        out += '}';
    }
    if (!result.sunlit_fraction.empty()) {
        out += R"(,"sunlit_fraction":)";
        append_json(out, result.sunlit_fraction[index]);
    }
    out += R"(,"ratios":{)";
    for (std::size_t i = 0; i < result.ratios; ++i) {
        out += (i == 0 ? "" : ",") + names.ratios[i] + ":";
        append_json(out, result.ratio(index, i));
    }
    return out + "}}";
}

JsonNames json_names(const RunFile& run) {
    JsonNames names;
    for (const Band& band : run.scene.bands()) {
        names.bands.push_back(dumped(band.name));
    }
    for (const std::string& ratio : run.spec.ratios) {
        names.ratios.push_back(dumped(ratio));
    }
    return names;
}

std::string json_organ_sum(
    const Organ& organ, const SeriesSum& sum, std::size_t index, const JsonNames& names) {
    std::string out = organ_head(organ);
    for (const QuantityEntry& entry : quantity_table()) {
        fmt::format_to(std::back_inserter(out), R"(,"{}":{{)", entry.name);
        for (std::size_t b = 0; b < sum.bands; ++b) {
            out += (b == 0 ? "" : ",") + names.bands[b] + ":";
            append_json(out, sum.at(index, entry.quantity, b));
        }
        out += '}';
    }
    return out + "}";
}

}  // namespace quasimc
