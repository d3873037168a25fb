#include <cmath>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "resultio/json_parts.h"
#include "results/fraction_table.h"
#include "runfile/table_rows.h"

namespace quasimc {
namespace {

/// The shortest exact text, so that results can be compared as text; null if it is not finite.
void append_number(std::string& row, double value) {
    std::isfinite(value) ? fmt::format_to(std::back_inserter(row), "{}", value)
                         : fmt::format_to(std::back_inserter(row), "null");
}

/// A key, with the comma before it if it is not the first. @param quoted  with its quotes
void append_key(std::string& row, std::string_view quoted) {
    row += row.back() == '{' ? "" : ",";
    row.append(quoted).append(":");
}

void append_estimate_value(std::string& row, const Estimate& estimate) {
    const Estimate e = reported(estimate);
    row += '{';
    for (const auto& [key, value] :
         {std::pair(R"("mean")", e.mean), std::pair(R"("standard_error")", e.standard_error),
          std::pair(R"("ci95_low")", e.ci95_low), std::pair(R"("ci95_high")", e.ci95_high)}) {
        append_key(row, key);
        append_number(row, value);
    }
    row += '}';
}

void append_estimate(std::string& row, std::string_view quoted, const Estimate& estimate) {
    append_key(row, quoted);
    append_estimate_value(row, estimate);
}

/// The estimates of every quantity and band that is written.
/// @param light  a Result, a SeriesSum or a GroupResults
template <typename Light>
void append_quantities(
    std::string& row, const Light& light, std::size_t index, const JsonNames& names) {
    for (const QuantityEntry& entry : names.columns.quantities) {
        append_key(row, names.quantities[static_cast<std::size_t>(entry.quantity)]);
        row += '{';
        for (const std::size_t b : names.columns.bands) {
            if (b < light.bands) {  // a total that was not requested has none
                append_estimate(row, names.bands[b], light.at(index, entry.quantity, b));
            }
        }
        row += '}';
    }
}

/// The estimates of every origin of light, if there are any.
/// @param light_of  the light of an origin: a Result, a SeriesSum or a GroupResults
template <typename Origins, typename LightOf>
void append_origins(
    std::string& row,
    const Origins& origins,
    const LightOf& light_of,
    std::size_t index,
    const JsonNames& names) {
    if (origins.empty()) {
        return;
    }
    append_key(row, R"("origins")");
    row += '{';
    for (const auto& origin : origins) {
        append_key(row, json_text(origin.name));
        row += '{';
        append_quantities(row, light_of(origin), index, names);
        row += '}';
    }
    row += '}';
}

/// The estimates of sunlit and shaded parts, if there are any.
void append_parts(
    std::string& row,
    const SunShadeLight& light,
    std::size_t index,
    const JsonNames& names,
    CsvTimes times) {
    for (const SunShadeEntry& entry : names.columns.parts) {
        if (light.empty()) {
            return;
        }
        append_key(row, json_text(times == CsvTimes::days ? entry.of_sums : entry.name));
        if (!entry.has_bands()) {
            append_estimate_value(row, light.at(index, entry.quantity));
            continue;
        }
        row += '{';
        for (const std::size_t b : names.columns.bands) {
            append_estimate(row, names.bands[b], light.at(index, entry.quantity, b));
        }
        row += '}';
    }
}

/// @param light  a Result or a GroupResults
template <typename Light>
void append_ratios(
    std::string& row, const Light& light, std::size_t index, const JsonNames& names) {
    append_key(row, R"("ratios")");
    row += '{';
    for (std::size_t i = 0; i < light.ratios; ++i) {
        append_estimate(row, names.ratios[i], light.ratio(index, i));
    }
    row += '}';
}

/// The shares of a group by band; none in sums over times.
void append_shares(
    std::string& row, const GroupResults& groups, std::size_t index, const JsonNames& names) {
    for (std::size_t i = 0; !groups.shares.empty() && i < share_table().size(); ++i) {
        const ShareEntry entry = share_table()[i];
        append_key(row, fmt::format("\"{}\"", entry.name));
        row += '{';
        for (const std::size_t b : names.columns.bands) {
            append_estimate(row, names.bands[b], groups.share(index, entry.share, b));
        }
        row += '}';
    }
}

/// Sunlit hours, if they are written and known.
void append_hours(
    std::string& row, const SeriesSum& sum, std::size_t index, const JsonNames& names) {
    if (names.columns.has_sunlit_hours && !sum.sunlit_hours.empty()) {
        append_estimate(row, R"("sunlit_hours")", sum.sunlit_hours[index]);
    }
}

/// The text of an object to which members are added.
std::string begin_row(const Json& object) {
    std::string row = json_text(object);
    row.pop_back();
    return row;
}

Json named_object(const Organ& organ) {
    Json object = {{"id", organ.id}, {"name", organ.name}, {"labels", Json::object()}};
    for (const auto& [key, value] : organ.labels) {
        object["labels"].emplace(key, value);
    }
    return object;
}

std::string begin_organ(const Organ& organ) {
    Json object = named_object(organ);
    if (organ.is_ground) {
        object["ground"] = true;
    }
    std::string row = begin_row(object);
    append_key(row, R"("area")");
    append_number(row, organ.area);
    return row;
}

}  // namespace

JsonNames json_names(const RunFile& run, WrittenColumns columns) {
    JsonNames names;
    names.columns = std::move(columns);
    for (const QuantityEntry& entry : quantity_table()) {
        names.quantities.push_back(json_text(entry.name));
    }
    for (const Band& band : run.scene.bands()) {
        names.bands.push_back(json_text(band.name));
    }
    for (const std::string& ratio : run.spec.ratios) {
        names.ratios.push_back(json_text(ratio));
    }
    return names;
}

std::string json_organ(
    const Organ& organ, const Result& result, std::size_t index, const JsonNames& names) {
    std::string row = begin_organ(organ);
    append_quantities(row, result, index, names);
    append_parts(row, result.sun_shade, index, names, CsvTimes::time_steps);
    if (names.columns.has_sunlit && !result.sunlit_fraction.empty()) {
        append_estimate(row, R"("sunlit_fraction")", result.sunlit_fraction[index]);
    }
    append_ratios(row, result, index, names);
    append_origins(
        row, result.origins, [](const OriginLight& o) -> const Result& { return o.light; }, index,
        names);
    return row + "}";
}

std::string json_organ(
    const Organ& organ, const SeriesSum& sum, std::size_t index, const JsonNames& names) {
    std::string row = begin_organ(organ);
    append_quantities(row, sum, index, names);
    append_parts(row, sum.sun_shade, index, names, CsvTimes::days);
    append_hours(row, sum, index, names);
    append_origins(
        row, sum.origins, [](const OriginSum& o) -> const SeriesSum& { return o.light; }, index,
        names);
    return row + "}";
}

namespace {

/// The names of the quantities of a sensor.
JsonNames names_of_sensor(const JsonNames& names, Receiver receiver) {
    JsonNames own = names;
    own.columns.quantities = sensor_quantities(names.columns.quantities, receiver);
    for (const QuantityEntry& entry : own.columns.quantities) {
        own.quantities[static_cast<std::size_t>(entry.quantity)] = json_text(entry.name);
    }
    return own;
}

void append_transmittance(std::string& text, const SensorRow& row, const JsonNames& names) {
    if (row.transmittance.empty()) {
        return;
    }
    append_key(text, R"("transmittance")");
    text += '{';
    for (const std::size_t b : names.columns.bands) {
        append_estimate(text, names.bands[b], row.transmittance[b]);
    }
    text += '}';
}

std::string begin_sensor(const SensorRow& row) {
    Json object = named_object(row.sensor);
    object["position"] = json_vector(row.position);
    return begin_row(object);
}

}  // namespace

std::string json_sensor(
    const SensorRow& row, const Result& sensors, std::size_t index, const JsonNames& names) {
    const JsonNames own = names_of_sensor(names, row.receiver);
    std::string text = begin_sensor(row);
    append_quantities(text, sensors, index, own);
    append_transmittance(text, row, own);
    if (own.columns.has_sunlit && !sensors.sunlit_fraction.empty()) {
        append_estimate(text, R"("sunlit_fraction")", sensors.sunlit_fraction[index]);
    }
    append_ratios(text, sensors, index, own);
    append_origins(
        text, sensors.origins, [](const OriginLight& o) -> const Result& { return o.light; }, index,
        own);
    return text + "}";
}

std::string json_sensor(
    const SensorRow& row, const SeriesSum& sensors, std::size_t index, const JsonNames& names) {
    const JsonNames own = names_of_sensor(names, row.receiver);
    std::string text = begin_sensor(row);
    append_quantities(text, sensors, index, own);
    append_transmittance(text, row, own);
    append_hours(text, sensors, index, own);
    append_origins(
        text, sensors.origins, [](const OriginSum& o) -> const SeriesSum& { return o.light; },
        index, own);
    return text + "}";
}

std::string json_group(
    const GroupResults& groups,
    std::size_t index,
    const JsonNames& names,
    const std::vector<OriginGroups>& origins,
    CsvTimes times) {
    const OrganGroup& group = groups.groups[index];
    Json object = {
        {"by", group.by},
        {"value", group.value},
        {"organs", group.organs.size()},
        {"area", group.area}};
    if (group.by == kLayer && !std::isnan(group.height_min)) {
        object["height_min"] = group.height_min;
        object["height_max"] = group.height_max;
        object["plant_area_index"] = group.plant_area_index;
        object["cumulative_plant_area_index"] = group.cumulative_plant_area_index;
    }
    std::string row = begin_row(object);
    append_quantities(row, groups, index, names);
    append_parts(row, groups.sun_shade, index, names, times);
    if (names.columns.has_sunlit && !groups.sunlit_fraction.empty()) {
        const bool is_sum = times == CsvTimes::days;
        append_estimate(
            row, is_sum ? R"("sunlit_hours")" : R"("sunlit_fraction")",
            groups.sunlit_fraction[index]);
        append_estimate(
            row, is_sum ? R"("sunlit_area_hours")" : R"("sunlit_area")", groups.sunlit_area[index]);
    }
    if (!groups.ratio_values.empty()) {
        append_ratios(row, groups, index, names);
    }
    append_shares(row, groups, index, names);
    append_origins(
        row, origins, [](const OriginGroups& o) -> const GroupResults& { return *o.groups; }, index,
        names);
    return row + "}";
}

}  // namespace quasimc
