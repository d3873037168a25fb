#include <algorithm>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "runfile/run_file_sections.h"
#include "runfile/unit_spelling.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::size_t kMaxWavebands = 10000;

/// The nodes of a value, one per band; empty after a fault.
std::vector<const Node*> nodes_of_value(
    TableReader& table, std::string_view key, const Node& node, const std::vector<Band>& bands) {
    const auto* list = node.as<Node::List>();
    const auto* by_name = node.as<Node::Table>();
    if (list == nullptr && by_name == nullptr) {
        return std::vector<const Node*>(bands.size(), &node);
    }
    std::vector<const Node*> nodes;
    if (list != nullptr) {
        if (list->size() != bands.size()) {
            table.fault_at(
                node, fmt::format("{} has {}", key, counted(list->size(), "value")),
                "the run has " + counted(bands.size(), "band"),
                "give one for all or one for each band");
            return nodes;
        }
        for (const Node& item : *list) {
            nodes.push_back(&item);
        }
        return nodes;
    }
    TableReader names(node, fmt::format("{}: {}", table.what(), key), table.reporter());
    for (const Band& band : bands) {
        const Node* item = names.any(band.name);
        if (item == nullptr) {
            names.missing(band.name, "give a value for every band");
        }
        nodes.push_back(item);
    }
    names.finish();
    return names.failed() ? std::vector<const Node*>() : nodes;
}

/// The unit of irradiance in a key, in its standard spelling. Refuses misspelled units.
std::string read_unit(TableReader& table, std::string_view key, const std::string& usual) {
    std::string unit = standard_unit(table.text(key).value_or(usual));
    const std::string_view meant = unit_of_same_letters(unit);
    if (!meant.empty() && meant != unit) {
        table.fault_at(
            key, fmt::format("the unit is '{}'", one_line(unit)),
            fmt::format("a unit is written as in '{}'", meant),
            fmt::format("did you mean '{}'?", meant));
    }
    return unit;
}

Band read_band(const Node& node, const std::string& unit, Reporter& reporter) {
    TableReader table(node, "band", reporter);
    Band band;
    band.name = table.required("name", table.text("name")).value_or("");
    band.unit = read_unit(table, "unit", unit);
    constexpr Range kWavelengths{100, 100000};
    const auto from = table.real("from_nm", kWavelengths);
    const auto to = table.real("to_nm", kWavelengths);
    if (from && to && *from >= *to) {
        table.fault_at("to_nm", "to_nm must be above from_nm");
    } else if (from.has_value() != to.has_value() && !table.failed()) {
        table.fault("give both from_nm and to_nm");
    }
    band.from_nm = from.value_or(0);
    band.to_nm = to.value_or(0);
    table.finish();
    return band;
}

/// Reports band names that are invalid in columns or in a ratio "A:B". (The scene checks the rest.)
void check_band_names(TableReader& top, const std::vector<Band>& bands, const Node& node) {
    for (const Band& band : bands) {
        if (band.name.find_first_of(":,\"\n\r#") != std::string::npos) {
            top.fault_at(
                node, fmt::format("the name of a band is {}", shown(band.name)),
                "a name must not contain ':', ',', '#', quotes or line breaks");
        }
    }
}

/// Largest plausible irradiance in a unit; no bound for unknown units.
double brightest_of(const std::string& unit) {
    constexpr double kBrightest = 1e5;
    constexpr double kBrightestLux = 1e7;
    if (unit.starts_with("W") || unit.starts_with("umol")) {
        return kBrightest;
    }
    return unit == "lx" ? kBrightestLux : TableReader::kFinite.high;
}

}  // namespace

std::vector<Band> read_bands(TableReader& top) {
    const std::string unit = read_unit(top, "irradiance_unit", Band{}.unit);
    std::vector<Band> bands;
    const Node* named = top.any("bands");
    const std::vector<const Node*> tables = top.tables("band");
    if (named != nullptr && top.any("band") != nullptr) {
        top.fault("both bands and [[band]] are given", "", "use one of them");
    }
    if (named != nullptr) {
        for (const std::string& name : top.texts("bands").value_or(std::vector<std::string>())) {
            bands.push_back({name, unit});
        }
    }
    for (const Node* node : tables) {
        bands.push_back(read_band(*node, unit, top.reporter()));
    }
    if (bands.empty() && !top.failed()) {
        top.fault("no band is given", "", "write bands = [\"PAR\"]");
    }
    if (bands.size() > kMaxWavebands) {
        top.fault_at(
            named ? *named : *tables.front(), fmt::format("{} bands", bands.size()),
            fmt::format("a run has {} at most", kMaxWavebands), "compute them in several runs");
        bands.resize(1);
    }
    if (!bands.empty()) {
        check_band_names(top, bands, named ? *named : *tables.front());
    }
    return bands.empty() ? std::vector<Band>{{"PAR", unit}} : bands;
}

std::vector<const Node*> nodes_per_band(
    TableReader& table, std::string_view key, const std::vector<Band>& bands) {
    const Node* node = table.any(key);
    return node ? nodes_of_value(table, key, *node, bands) : std::vector<const Node*>();
}

std::optional<std::vector<double>> read_irradiances(
    TableReader& table, std::string_view key, const std::vector<Band>& bands) {
    auto values = read_per_band(table, key, bands, TableReader::kLight);
    for (std::size_t b = 0; values && b < bands.size(); ++b) {
        if ((*values)[b] > brightest_of(bands[b].unit)) {
            table.warn_at(
                *table.any(key),
                fmt::format(
                    "{} of band {} is {} {}, but the sun gives 1361 W m-2 (about 6200 umol m-2 "
                    "s-1) outside the atmosphere: is the unit right?",
                    key, bands[b].name, shortest((*values)[b]), bands[b].unit));
            break;
        }
    }
    return values;
}

std::optional<std::vector<double>> read_per_band(
    TableReader& table, std::string_view key, const std::vector<Band>& bands, Range range) {
    std::vector<double> values;
    for (const Node* node : nodes_per_band(table, key, bands)) {
        const std::optional<double> value = table.real_at(key, *node, range);
        if (!value) {
            return std::nullopt;
        }
        values.push_back(*value);
    }
    return values.empty() ? std::nullopt : std::optional(values);
}

}  // namespace quasimc
