#include "io/results/json_parts.h"
#include "io/runfile/units.h"
#include "quasimc/version.h"

namespace quasimc {
namespace {

constexpr JsonLayout kHeadLayout = JsonLayout::pretty;

void write_inputs(JsonStream& json, const std::vector<InputFile>& inputs) {
    json.key("inputs");
    json.begin_list(kHeadLayout);
    for (const InputFile& input : inputs) {
        json.begin_object(kHeadLayout);
        json.text("path", input.path);
        json.text("resolved", input.resolved);
        json.text("sha256", input.sha256);
        json.count("bytes", input.bytes);
        json.boolean("is_run_file", input.is_run_file);
        json.end_object();
    }
    json.end_list();
}

void write_axes(JsonStream& json, const Orientation& axes) {
    json.key("axes");
    json.begin_object(kHeadLayout);
    json.text("up", axes.up() == UpAxis::z ? "z" : "y");
    json.key("north");
    json.begin_list(kHeadLayout);
    for (const double x : {axes.north().x, axes.north().y, axes.north().z}) {
        json.real(x);
    }
    json.end_list();
    json.end_object();
}

void write_scene(JsonStream& json, const Scene& scene) {
    json.key("scene");
    json.begin_object(kHeadLayout);
    json.count("organs", scene.organs().size());
    json.count("triangles", scene.triangles().size());
    json.text("length_unit", scene.length_unit());
    write_axes(json, scene.orientation());
    json.end_object();
}

void write_sources(JsonStream& json, const std::vector<std::string>& notes) {
    json.key("sources");
    json.begin_list(kHeadLayout);
    for (const std::string& note : notes) {
        json.text(note);
    }
    json.end_list();
}

void write_quantities(JsonStream& json, const RunFile& run) {
    const WrittenColumns columns = written_columns(run);
    json.key("quantities");
    json.begin_list(kHeadLayout);
    for (const QuantityEntry& entry : columns.quantities) {
        json.begin_object(kHeadLayout);
        json.text("name", entry.name);
        json.text("meaning", entry.summary);
        json.key("unit");
        json.begin_object(kHeadLayout);
        for (const std::size_t b : columns.bands) {
            const Band& band = run.scene.bands()[b];
            json.text(band.name, unit_of(entry, band, run.scene.length_unit()));
        }
        json.end_object();
        json.end_object();
    }
    json.end_list();
}

}  // namespace

void json_head(JsonStream& json, const RunFile& run) {
    json.text("format", "quasimc-result");
    json.count("format_version", kResultVersion);
    json.text("program_version", version());
    json.text("title", run.title);
    json.text("run_file", run.path);
    json.text("folder", run.folder);
    write_inputs(json, run.inputs);
    json.key("run");
    json_value(json, *run.document, kHeadLayout);
    write_scene(json, run.scene);
    write_sources(json, run.source_notes);
    write_quantities(json, run);
}

void json_value(JsonStream& json, const Node& node, JsonLayout layout) {
    if (const auto* table = node.as<Node::Table>()) {
        json.begin_object(layout);
        for (const Member& member : *table) {
            json.key(member.key);
            json_value(json, member.node, layout);
        }
        json.end_object();
    } else if (const auto* list = node.as<Node::List>()) {
        json.begin_list(layout);
        for (const Node& item : *list) {
            json_value(json, item, layout);
        }
        json.end_list();
    } else if (const auto* text = node.as<std::string>()) {
        json.text(*text);
    } else if (const auto* integer = node.as<std::int64_t>()) {
        json.integer(*integer);
    } else if (const auto* real = node.as<double>()) {
        json.real(*real);
    } else if (const auto* boolean = node.as<bool>()) {
        json.boolean(*boolean);
    } else if (const auto* other = node.as<Node::Other>(); other && !other->text.empty()) {
        json.text(other->text);
    } else {
        json.null();
    }
}

void json_warnings(JsonStream& json, const RunFile& run) {
    json.key("warnings");
    json.begin_list(kHeadLayout);
    for (const Warning& warning : run.warnings) {
        json.begin_object(kHeadLayout);
        json.text("place", warning.place);
        json.text("text", warning.text);
        json.end_object();
    }
    json.end_list();
}

}  // namespace quasimc
