#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>

#include "base/checks.h"
#include "io/runfile/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// A kind of source whose keys depend on each other, so that its row in the catalogue
/// (sources/catalogue.cpp, the one table of kinds) does not tell all of it.
struct OwnReader {
    std::string_view name;
    std::optional<NotedSource> (*read)(
        TableReader& table, const std::string& name, const RunFileContext& context);
};
constexpr std::array kOwnReaders{
    OwnReader{"directional", read_directional},
    OwnReader{"sun", read_sun},
    OwnReader{"sky", read_sky},
    OwnReader{"point", read_lamp},
    OwnReader{"spot", read_lamp},
    OwnReader{"rectangle", read_lamp},
    OwnReader{"disk", read_lamp},
    OwnReader{"line", read_lamp},
    OwnReader{"sphere", read_lamp},
    OwnReader{"ies", read_lamp}};

std::optional<NotedSource> read_kind(
    const SourceEntry& kind,
    TableReader& table,
    const std::string& name,
    const RunFileContext& context) {
    if (kind.make != nullptr) {
        return read_stated_source(kind, table, name, context);
    }
    const auto* own = std::find_if(
        kOwnReaders.begin(), kOwnReaders.end(),
        [&](const OwnReader& reader) { return reader.name == kind.name; });
    EXPECT(own != kOwnReaders.end());
    return own->read(table, name, context);
}

/// One pair of hours; nothing after a fault.
std::optional<DailyHours::Span> read_span_of_hours(TableReader& table, const Node& node) {
    const auto* pair = node.as<Node::List>();
    if (pair == nullptr || pair->size() != 2) {
        table.fault_at(
            "on_hours", "on_hours has no pair of numbers", "",
            "write on_hours = [6, 22] or [[5, 9], [16, 22]]");
        return std::nullopt;
    }
    const auto from = table.real_at("on_hours", (*pair)[0], {0, 24});
    const auto to = table.real_at("on_hours", (*pair)[1], {0, 24});
    if (!from || !to) {
        return std::nullopt;
    }
    if (*from == *to) {
        table.fault_at(
            "on_hours", "on_hours ends where it begins", "", "leave it out if all day is meant");
        return std::nullopt;
    }
    return DailyHours::Span{*from, *to};
}

/// When the source shines; nothing if always, or after a fault.
std::optional<DailyHours> read_on_hours(TableReader& table, const RunFileContext& context) {
    const Node* node = table.any("on_hours");
    if (node == nullptr) {
        return std::nullopt;
    }
    if (!context.has_time) {
        table.fault_at(
            "on_hours", "on_hours without [time]", "a run without times has no clock",
            "add [time], or leave it out");
        return std::nullopt;
    }
    const auto* list = node->as<Node::List>();
    const bool is_many =
        list != nullptr && !list->empty() && (*list)[0].as<Node::List>() != nullptr;
    DailyHours hours;
    for (std::size_t i = 0; i < (is_many ? list->size() : 1); ++i) {
        if (const auto span = read_span_of_hours(table, is_many ? (*list)[i] : *node)) {
            hours.spans.push_back(*span);
        }
    }
    if (hours.overlap()) {
        table.fault_at("on_hours", "parts of on_hours overlap");
    }
    return hours;
}

std::optional<NotedSource> read_source(const Node& node, const RunFileContext& context) {
    std::vector<std::string_view> names;
    for (const SourceEntry& kind : source_catalogue()) {
        names.push_back(kind.name);
    }
    TableReader table(node, "source", *context.reporter);
    const std::optional<std::string> type = table.required("type", table.choice("type", names));
    const std::string name = table.text("name").value_or(type.value_or("source"));
    table.rename(fmt::format("source '{}'", name));
    if (!type) {
        return std::nullopt;  // which keys are meant can't be told
    }
    std::optional<NotedSource> source = read_kind(*find_source(*type), table, name, context);
    const std::optional<DailyHours> hours = read_on_hours(table, context);
    if (source && hours) {
        source->hours = hours;
        source->note += "; on " + hours->words();
    }
    table.finish();
    return source;
}

bool is_sun(const Node& source) {
    const Node* type = source.find("type");
    const auto* text = type == nullptr ? nullptr : type->as<std::string>();
    return text != nullptr && *text == "sun";
}

}  // namespace

SourceList read_sources(TableReader& top, RunFileContext& context) {
    const std::vector<const Node*> tables = top.tables("source");
    // The suns first: skies are brighter around them.
    std::vector<std::size_t> order(tables.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(
        order.begin(), order.end(), [&](std::size_t i) { return is_sun(*tables[i]); });
    std::vector<std::optional<NotedSource>> sources(tables.size());
    for (const std::size_t i : order) {
        sources[i] = read_source(*tables[i], context);
        if (sources[i] && !context.sun) {
            context.sun = sources[i]->sun;
        }
    }
    SourceList list;
    for (std::optional<NotedSource>& source : sources) {
        if (source) {
            list.sources.push_back(std::move(source->source));
            list.notes.push_back(std::move(source->note));
            list.hours.push_back(std::move(source->hours));
        }
    }
    const bool has_files = read_light_files(top, context, list);
    if (tables.empty() && !has_files && top.any("time") == nullptr) {
        top.fault("no source of light is given", "", "add a [[source]] or [time]");
    }
    return list;
}

}  // namespace quasimc
