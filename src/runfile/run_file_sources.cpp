#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "base/checks.h"
#include "runfile/run_file_source_kinds.h"

namespace quasimc {
namespace {

/// Reader of a kind of source, which light/models/catalogue.cpp describes.
struct KindReader {
    std::string_view name;
    std::optional<NotedSource> (*read)(
        TableReader& table, const std::string& name, const RunFileContext& context);
};
constexpr std::array kKindReaders{
    KindReader{"directional", read_directional},
    KindReader{"sun", read_sun},
    KindReader{"sky", read_sky},
    KindReader{"uniform_sky", read_uniform_sky},
    KindReader{"point", read_lamp},
    KindReader{"spot", read_lamp},
    KindReader{"rectangle", read_lamp},
    KindReader{"disk", read_lamp},
    KindReader{"line", read_lamp},
    KindReader{"sphere", read_lamp},
    KindReader{"ies", read_lamp}};

/// Reads one pair of hours; empty after a fault.
std::optional<DailyHours::Span> read_span_of_hours(TableReader& table, const Node& node) {
    const auto* pair = node.as<Node::List>();
    if (pair == nullptr || pair->size() != 2) {
        table.fault_at(
            "on_hours", "on_hours is not a pair of numbers", "",
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
            "on_hours", "on_hours ends where it begins", "", "remove it if the lamp is on all day");
        return std::nullopt;
    }
    return DailyHours::Span{*from, *to};
}

/// The hours in which a source shines; empty if always, or after a fault.
std::optional<DailyHours> read_on_hours(TableReader& table, const RunFileContext& context) {
    const Node* node = table.any("on_hours");
    if (node == nullptr) {
        return std::nullopt;
    }
    if (!context.has_time) {
        const std::string time = table.table_name("time");
        table.fault_at(
            "on_hours", "on_hours needs " + time,
            fmt::format("a run without {} has no clock", time),
            fmt::format("add {} or remove on_hours", time));
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
        table.fault_at("on_hours", "intervals of on_hours overlap");
    }
    return hours;
}

const KindReader* find_reader(std::string_view type) {
    const auto* kind = std::find_if(
        kKindReaders.begin(), kKindReaders.end(),
        [&](const KindReader& reader) { return reader.name == type; });
    return kind == kKindReaders.end() ? nullptr : kind;
}

std::optional<NotedSource> read_source(const Node& node, const RunFileContext& context) {
    TableReader table(node, "source", *context.reporter);
    const std::optional<std::string> type =
        table.required("type", table.choice("type", names_in(source_catalogue())));
    const std::string name = table.text("name").value_or(type.value_or("source"));
    table.rename(fmt::format("source '{}'", name));
    if (!type) {
        return std::nullopt;  // the type of the keys is unknown
    }
    const KindReader* kind = find_reader(*type);
    EXPECT(kind != nullptr);
    std::optional<NotedSource> source = kind->read(table, name, context);
    const std::optional<DailyHours> hours = read_on_hours(table, context);
    if (source && hours) {
        source->hours = hours;
        source->note += "; on " + hours->describe();
    }
    table.finish();
    return source;
}

std::string_view type_of(const Node& source) {
    const Node* type = source.find("type");
    const auto* text = type == nullptr ? nullptr : type->as<std::string>();
    return text == nullptr ? std::string_view() : std::string_view(*text);
}

/// The tables of all sources; of a lamp with `at`, one for each copy.
std::vector<Node> tables_of_sources(TableReader& top, RunFileContext& context) {
    std::vector<Node> tables;
    for (const Node* table : top.tables("source")) {
        const KindReader* kind = find_reader(type_of(*table));
        if (table->find("at") == nullptr || kind == nullptr) {
            tables.push_back(*table);
        } else if (kind->read == read_lamp) {
            std::vector<Node> copies = lamp_tables(*table, context);
            std::move(copies.begin(), copies.end(), std::back_inserter(tables));
        } else {
            TableReader(*table, fmt::format("source of type '{}'", kind->name), top.reporter())
                .fault_at("at", "at is for lamps", "suns and skies have no position");
        }
    }
    return tables;
}

/// Reads sources in the given order; after one with faults, other copies of its table are left out.
void read_in_order(
    const std::vector<Node>& tables,
    const std::vector<std::size_t>& order,
    RunFileContext& context,
    std::vector<std::optional<NotedSource>>& sources) {
    std::set<std::uint32_t> failed;  // lines of tables
    for (const std::size_t i : order) {
        if (tables[i].line != 0 && failed.contains(tables[i].line)) {
            continue;
        }
        const std::size_t before = context.reporter->faults.size();
        sources[i] = read_source(tables[i], context);
        if (context.reporter->faults.size() > before) {
            failed.insert(tables[i].line);
        }
        if (sources[i] && !context.sun) {
            context.sun = sources[i]->sun;
        }
    }
}

}  // namespace

SourceList read_sources(TableReader& top, RunFileContext& context) {
    const std::size_t before = top.reporter().faults.size();
    const std::vector<Node> tables = tables_of_sources(top, context);
    // Suns first, as skies depend on them.
    std::vector<std::size_t> order(tables.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_partition(
        order.begin(), order.end(), [&](std::size_t i) { return type_of(tables[i]) == "sun"; });
    std::vector<std::optional<NotedSource>> sources(tables.size());
    read_in_order(tables, order, context, sources);
    SourceList list;
    for (std::optional<NotedSource>& source : sources) {
        if (source) {
            list.sources.push_back(std::move(source->source));
            list.notes.push_back(std::move(source->note));
            list.hours.push_back(std::move(source->hours));
        }
    }
    const bool has_files = read_light_files(top, context, list);
    if (top.any("source") == nullptr && !has_files && top.any("time") == nullptr) {
        top.fault("no source of light is given", "", "add a source or " + top.table_name("time"));
    }
    list.is_whole = top.reporter().faults.size() == before;
    return list;
}

}  // namespace quasimc
