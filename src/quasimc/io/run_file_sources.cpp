#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "quasimc/io/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// One row of the table of kinds of sources.
struct SourceKind {
    std::string_view name;
    std::optional<NotedSource> (*read)(
        TableReader& table, const std::string& name, const RunFileContext& context);
};

// To add a kind of source to the run file: a function in a file of its own, declared in
// run_file_source_kinds.h, a row here, a section in docs/formats/run-file.md.
constexpr std::array kKinds{
    SourceKind{"directional", read_directional},
    SourceKind{"sun", read_sun},
    SourceKind{"sky", read_sky},
    SourceKind{"uniform_sky", read_uniform_sky},
    SourceKind{"point", read_lamp},
    SourceKind{"spot", read_lamp},
    SourceKind{"rectangle", read_lamp},
    SourceKind{"disk", read_lamp},
    SourceKind{"line", read_lamp},
    SourceKind{"sphere", read_lamp},
    SourceKind{"ies", read_lamp}};

std::optional<NotedSource> read_source(const Node& node, const RunFileContext& context) {
    std::array<std::string_view, kKinds.size()> names;
    std::transform(kKinds.begin(), kKinds.end(), names.begin(), [](const SourceKind& kind) {
        return kind.name;
    });
    TableReader table(node, "source", *context.reporter);
    const std::optional<std::string> type = table.required("type", table.choice("type", names));
    const std::string name = table.text("name").value_or(type.value_or("source"));
    table.rename(fmt::format("source '{}'", name));
    std::optional<NotedSource> source;
    if (!type) {
        return source;  // which keys are meant can't be told
    }
    for (const SourceKind& kind : kKinds) {
        if (kind.name == *type) {
            source = kind.read(table, name, context);
        }
    }
    table.finish();
    return source;
}

}  // namespace

SourceList read_sources(TableReader& top, RunFileContext& context) {
    const std::vector<const Node*> tables = top.tables("source");
    std::vector<std::optional<NotedSource>> sources(tables.size());
    // The suns first: skies are brighter around them.
    const auto is_sun = [](const Node& node) {
        const Node* type = node.find("type");
        const auto* text = type == nullptr ? nullptr : type->as<std::string>();
        return text != nullptr && *text == "sun";
    };
    for (const bool suns : {true, false}) {
        for (std::size_t i = 0; i < tables.size(); ++i) {
            if (is_sun(*tables[i]) == suns) {
                sources[i] = read_source(*tables[i], context);
                if (sources[i] && !context.sun) {
                    context.sun = sources[i]->sun;
                }
            }
        }
    }
    SourceList list;
    for (std::optional<NotedSource>& source : sources) {
        if (source) {
            list.sources.push_back(std::move(source->source));
            list.notes.push_back(std::move(source->note));
        }
    }
    if (tables.empty() && top.any("time") == nullptr) {
        top.fault("no source of light is given", "", "add a [[source]] or [time]");
    }
    return list;
}

}  // namespace quasimc
