// Reads [[table]]: output tables in CSV.

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "results/group_request.h"
#include "results/groups.h"
#include "results/sensor_transmittance.h"
#include "runfile/run_file_sections.h"
#include "runfile/table_rows.h"
#include "runfile/written.h"

namespace quasimc {
namespace {

template <typename Enum, std::size_t kCount>
using NamesOf = std::array<std::pair<std::string_view, Enum>, kCount>;

constexpr NamesOf<CsvRows, 5> kRows{
    {{"organs", CsvRows::organs},
     {"groups", CsvRows::groups},
     {"sensors", CsvRows::sensors},
     {"detectors", CsvRows::detectors},
     {"control", CsvRows::control}}};
constexpr NamesOf<CsvTimes, 4> kTimes{
    {{"time", CsvTimes::time_steps},
     {"day", CsvTimes::days},
     {"period", CsvTimes::period},
     {"sweep", CsvTimes::sweep}}};
constexpr NamesOf<CsvForm, 2> kForms{{{"wide", CsvForm::wide}, {"long", CsvForm::narrow}}};
constexpr NamesOf<CsvStatistic, 4> kStatisticNames{
    {{"mean", CsvStatistic::mean},
     {"se", CsvStatistic::standard_error},
     {"ci95_low", CsvStatistic::ci95_low},
     {"ci95_high", CsvStatistic::ci95_high}}};

template <typename Names>
std::vector<std::string_view> first_of(const Names& names) {
    std::vector<std::string_view> all;
    all.reserve(names.size());
    for (const auto& each : names) {
        all.push_back(each.first);
    }
    return all;
}

/// Reads a choice; the first by default.
template <typename Names>
auto read_choice_of(TableReader& table, std::string_view key, const Names& names) {
    const std::vector<std::string_view> known = first_of(names);
    const std::optional<std::string> given = table.choice(key, known);
    const auto found = std::find_if(
        names.begin(), names.end(), [&](const auto& each) { return given == each.first; });
    return (found == names.end() ? names.front() : *found).second;
}

void check_list(
    TableReader& table,
    std::string_view key,
    const std::vector<std::string>& names,
    const std::vector<std::string_view>& known) {
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            table.fault_at(
                key, fmt::format("{}: there is no '{}' in such a table", key, name), "",
                did_you_mean(name, known));
        }
    }
}

void read_statistics(TableReader& table, TableSpec& spec) {
    const auto names = table.texts("statistics");
    if (!names) {
        return;
    }
    check_list(table, "statistics", *names, first_of(kStatisticNames));
    spec.statistics.clear();
    for (const auto& [name, statistic] : kStatisticNames) {
        if (std::find(names->begin(), names->end(), name) != names->end()) {
            spec.statistics.push_back(statistic);
        }
    }
    if (names->empty()) {
        table.fault_at("statistics", "statistics is empty", "", "give \"mean\"");
    }
}

/// Refuses keys that the table of detectors has no use for.
void check_detectors_table(TableReader& table, TableReader& top) {
    for (const std::string_view key :
         {"per", "form", "where", "quantities", "bands", "origins", "statistics", "digits"}) {
        if (table.any(key) != nullptr) {
            table.fault_at(
                key, fmt::format("{} in a table of detectors", key),
                "it always has a row for each detector, bin and band", "remove it");
        }
    }
    if (top.any("detector") == nullptr) {
        table.fault_at("rows", "rows = \"detectors\" without [[detector]]");
    }
}

/// Refuses keys that the table of controls has no use for.
void check_control_table(TableReader& table, TableReader& top) {
    for (const std::string_view key :
         {"form", "where", "quantities", "bands", "origins", "statistics", "digits"}) {
        if (table.any(key) != nullptr) {
            table.fault_at(
                key, fmt::format("{} in a table of controls", key),
                "it always has a row for each control and time or day", "remove it");
        }
    }
    const std::string per = table.text("per").value_or("");
    if (per == "period" || per == "sweep") {
        table.fault_at(
            "per", fmt::format("per = \"{}\" in a table of controls", per),
            "it has rows by time or day", "give \"day\"");
    }
    if (top.any("control") == nullptr) {
        table.fault_at("rows", "rows = \"control\" without [[control]]");
    }
}

TableSpec read_table(
    const Node& node, TableReader& top, const InputFiles& files, const std::vector<Band>& bands) {
    constexpr Range kDigits{1, 17};
    TableReader table(node, "table", top.reporter());
    const std::optional<std::string> file = read_output_path(table, "file", files);
    TableSpec spec{.file = table.required("file", file).value_or("")};
    if (!spec.file.empty()) {
        table.rename(fmt::format("table '{}'", *table.text("file")));
    }
    spec.location = fmt::format("{}: {}", table.where(), table.what());
    spec.rows = read_choice_of(table, "rows", kRows);
    spec.times = read_choice_of(table, "per", kTimes);
    spec.form = read_choice_of(table, "form", kForms);
    spec.quantities = read_selection(table, "quantities");
    spec.bands = read_selection(table, "bands");
    spec.origins = table.texts("origins");
    spec.digits = static_cast<int>(table.integer("digits", kDigits).value_or(spec.digits));
    spec.where = table.text("where").value_or("");
    read_statistics(table, spec);
    if (spec.rows == CsvRows::detectors) {
        check_detectors_table(table, top);
    }
    if (spec.rows == CsvRows::control) {
        check_control_table(table, top);
    }
    if (spec.rows == CsvRows::sensors && top.any("sensors") == nullptr) {
        table.fault_at("rows", "rows = \"sensors\" without [[sensors]]");
    }
    const bool has_times = top.any("time") != nullptr;
    check_list(
        table, "quantities", spec.quantities, table_quantities(spec.rows, spec.times, has_times));
    check_list(table, "bands", spec.bands, names_in(bands));
    const bool is_over_times = is_summed(spec.times) && spec.times != CsvTimes::sweep;
    if (is_over_times && !has_times) {
        table.fault_at(
            "per", fmt::format("per = \"{}\" without [time]", *table.text("per")),
            "sums over time need [time]");
    }
    table.finish();
    return spec;
}

/// Refuses origins that a run does not have.
void check_origins(
    const TableSpec& table, const std::vector<std::string>& origins, Reporter& reporter) {
    const std::vector<std::string_view> known(origins.begin(), origins.end());
    for (const std::string& name : table.origins.value_or(std::vector<std::string>{})) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            reporter.faults.add(
                {table.location, fmt::format("origins: the run has no origin '{}'", name),
                 origins.empty() ? "[run] has no origins"
                                 : fmt::format("origins are {}", joined(known, ", ")),
                 did_you_mean(name, known)});
        }
    }
}

/// Refuses light on sides in tables of spheres, and light on spheres in tables without one.
void check_receivers(const TableSpec& table, const Scene& scene, Reporter& reporter) {
    const auto has = [&](Receiver receiver) {
        return std::ranges::any_of(
            scene.sensors(), [&](const SensorSet& set) { return set.receiver == receiver; });
    };
    for (const std::string& name : table.quantities) {
        const bool is_of_sphere = name == kFluenceRate;
        const bool is_of_side = name.starts_with("incident_");
        if (name == kTransmittance && !SensorTransmittance(scene).exists()) {
            reporter.faults.add(
                {table.location, "quantities: no sensor has a transmittance",
                 "it is the light on sensors that face up with their whole view, over that on the "
                 "horizontal above a ground or cell",
                 "give \"incident_upper\""});
        }
        if (is_of_sphere && !has(Receiver::sphere)) {
            reporter.faults.add(
                {table.location, "quantities: no sensor has a fluence_rate",
                 "it is the light on a sphere", "give sensors receiver = \"sphere\""});
        } else if (is_of_side && !has(Receiver::cosine)) {
            reporter.faults.add(
                {table.location, fmt::format("quantities: no sensor has an {}", name),
                 "all are spheres, which have no sides", "give \"fluence_rate\""});
        }
    }
}

/// Refuses a condition with an error, and warns of one that no row fulfils.
void check_condition(const TableSpec& table, RunFile& run, Reporter& reporter) {
    try {
        const TableRows rows(run, table);
        if (!table.where.empty() && rows.is_empty(run)) {
            run.warnings.push_back(
                {table.location,
                 fmt::format("where: no row of the table fulfils \"{}\"", table.where)});
        }
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            reporter.faults.add(
                {table.location, "where: " + fault.problem, fault.why, fault.suggestion});
        }
    }
}

/// Warns of groups whose condition no organ fulfils.
void warn_of_empty_groups(RunFile& run, const std::string& file) {
    const std::vector<std::string_view> known = label_keys(run.scene);
    const std::vector<OrganGroup> groups = make_groups(run.scene, group_spec(run.spec));
    for (const std::string& text : run.spec.groups) {
        const std::string by = parse_group(text, known).by;
        if (std::ranges::none_of(groups, [&](const OrganGroup& group) { return group.by == by; })) {
            run.warnings.push_back(
                {file, fmt::format("[run]: groups: no organ belongs to \"{}\"", text)});
        }
    }
}

/// Whether the groups of a run that has faults can be made.
bool knows_groups(const RunFile& run, const KnownParts& known) {
    Faults faults;
    if (known.knows_groups()) {
        check_groups(run.scene, group_spec(run.spec), faults);
    }
    return known.knows_groups() && faults.empty();
}

}  // namespace

void read_tables(
    TableReader& top, const InputFiles& files, const std::vector<Band>& bands, OutputSpec& output) {
    for (const Node* node : top.tables("table")) {
        TableSpec table = read_table(*node, top, files, bands);
        const auto has_path = [&](const auto& other) { return other.file == table.file; };
        const auto is_same = [&](const auto& other) { return other.second == table.file; };
        if (!table.file.empty() &&
            (std::any_of(output.tables.begin(), output.tables.end(), has_path) ||
             std::any_of(output.files.begin(), output.files.end(), is_same))) {
            TableReader(*node, "table", top.reporter())
                .fault_at("file", fmt::format("{} is the file of another output", table.file));
        }
        output.tables.push_back(std::move(table));
    }
}

void check_rows(RunFile& run, const KnownParts& known, Reporter& reporter) {
    const bool has_groups = reporter.faults.empty() || knows_groups(run, known);
    for (const TableSpec& table : run.output.tables) {
        if (known.sources && known.knows({"origins"})) {
            check_origins(table, all_columns(run).origins, reporter);
        }
        if (known.sensors && table.rows == CsvRows::sensors) {
            check_receivers(table, run.scene, reporter);
        }
        const bool has_labels = table.rows == CsvRows::groups    ? has_groups
                                : table.rows == CsvRows::sensors ? known.sensors
                                                                 : known.knows_groups();  // layers
        if (has_labels) {
            check_condition(table, run, reporter);
        }
    }
    if (has_groups) {
        warn_of_empty_groups(run, reporter.file);
    }
}

}  // namespace quasimc
