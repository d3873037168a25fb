#include "runfile/table_rows.h"

#include <algorithm>
#include <cstdint>

#include "results/fraction_table.h"
#include "results/group_request.h"
#include "results/groups.h"
#include "results/sensor_transmittance.h"
#include "runfile/written.h"
#include "scene/sensors.h"
#include "text/numbers.h"

namespace quasimc {

TableRows::TableRows(const RunFile& run, const TableSpec& table) {
    if (table.where.empty()) {
        return;
    }
    const WhereExpression where(table.where);
    if (table.rows == CsvRows::groups) {
        const std::vector<std::string> keys = group_keys(run);
        std::vector<std::string_view> known(keys.begin(), keys.end());
        known.insert(known.end(), {"by", "value", "area", kLayer});
        where.check_names(known, "label");
        where_ = where;
        return;
    }
    if (table.rows == CsvRows::sensors) {
        select_sensors(run.scene, where);
        return;
    }
    const OrganValues values(run.scene, group_spec(run.spec));
    where.check_names(values.names(), "label");
    for (const Organ& organ : run.scene.organs()) {
        organs_.push_back(values.holds(where, organ));
    }
}

void TableRows::select_sensors(const Scene& scene, const WhereExpression& where) {
    const Scene sensors = scene_of_sensors(scene);
    const std::vector<Vec3> positions = sensor_positions(scene);
    std::vector<std::string_view> known = label_keys(sensors);
    known.insert(known.end(), {"id", "name", "x", "y", "z"});
    where.check_names(known, "label");
    for (std::size_t i = 0; i < positions.size(); ++i) {
        const Organ& sensor = sensors.organs()[i];
        const Vec3 p = scene.orientation().outward(positions[i]);
        const auto value = [&](std::string_view name) -> std::optional<WhereValue> {
            if (const std::string* label = find_label(sensor.labels, name)) {
                return WhereValue::of_text(*label);
            }
            return name == "id"     ? std::optional(WhereValue::of_text(std::to_string(sensor.id)))
                   : name == "name" ? std::optional(WhereValue{sensor.name})
                   : name == "x"    ? std::optional(WhereValue::of_number(p.x))
                   : name == "y"    ? std::optional(WhereValue::of_number(p.y))
                   : name == "z"    ? std::optional(WhereValue::of_number(p.z))
                                    : std::nullopt;
        };
        organs_.push_back(where.holds(value));
    }
}

bool TableRows::has(const OrganGroup& group) const {
    return !where_ || where_->holds([&](std::string_view name) -> std::optional<WhereValue> {
        if (const std::string* label = find_label(group.labels, name)) {
            return WhereValue::of_text(*label);
        }
        if (name == "by") {
            return WhereValue{group.by};
        }
        if (name == "value") {
            return WhereValue::of_text(group.value);
        }
        return name == "area" ? std::optional(WhereValue::of_number(group.area)) : std::nullopt;
    });
}

std::vector<QuantityEntry> sensor_quantities(
    const std::vector<QuantityEntry>& quantities, Receiver receiver) {
    std::vector<QuantityEntry> own;
    for (QuantityEntry entry : quantities) {
        if (receiver == Receiver::sphere && entry.quantity == Quantity::incident_upper) {
            entry.name = kFluenceRate;
            entry.summary = "light from all directions, on a sphere";
        }
        const bool is_lower = entry.quantity == Quantity::incident_lower;
        if (is_of_sensors(entry.quantity) && !(receiver == Receiver::sphere && is_lower)) {
            own.push_back(entry);
        }
    }
    return own;
}

std::vector<std::size_t> sensor_shape(const SensorSet& set) {
    if (set.is_averaged) {
        return {};
    }
    const Labels& last = set.points.back().labels;
    const auto number_in = [&](std::string_view key) {
        const std::string* text = find_label(last, key);
        const std::int64_t number = text != nullptr ? parse_integer(*text).value_or(0) : 0;
        return static_cast<std::size_t>(std::max<std::int64_t>(number, 0));
    };
    const bool is_array = set.counts[0] > 0;
    const std::size_t columns = is_array ? set.counts[0] : number_in("i");
    const std::size_t lines = is_array ? set.counts[1] : number_in("j");
    const std::size_t count = set.points.size();
    return lines > 1 && count % lines == 0 && count / lines == columns ? std::vector{lines, columns}
                                                                       : std::vector{count};
}

bool TableRows::is_empty(const RunFile& run) const {
    if (where_) {
        const std::vector<OrganGroup> groups = make_groups(run.scene, group_spec(run.spec));
        return std::ranges::none_of(groups, [&](const OrganGroup& group) { return has(group); });
    }
    return !organs_.empty() && std::ranges::find(organs_, true) == organs_.end();
}

std::vector<std::string> group_keys(const RunFile& run) {
    const std::vector<std::string_view> known = label_keys(run.scene);
    std::vector<std::string> keys;
    for (const std::string& text : run.spec.groups) {
        for (const std::string& key : parse_group(text, known).keys) {
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                keys.push_back(key);
            }
        }
    }
    return keys;
}

std::vector<std::string_view> table_quantities(CsvRows rows, CsvTimes times, bool has_times) {
    const bool is_of_sweep = times == CsvTimes::sweep;
    const bool is_over_time = is_summed(times) && (!is_of_sweep || has_times);
    std::vector<std::string_view> names;
    for (const QuantityEntry& entry : quantity_table()) {
        if (rows != CsvRows::sensors || is_of_sensors(entry.quantity)) {
            names.push_back(entry.name);
        }
    }
    if (rows == CsvRows::sensors) {
        names.insert(
            names.end(),
            {kFluenceRate, kTransmittance, is_over_time ? kSunlitHours : "sunlit_fraction"});
        if (!is_summed(times)) {
            names.emplace_back("ratios");
        }
        return names;
    }
    const bool is_of_groups = rows == CsvRows::groups;
    for (std::size_t i = 0; is_of_groups && i < share_table().size(); ++i) {
        names.push_back(share_table()[i].name);
    }
    for (std::size_t i = 0; is_of_groups && i < fraction_table().size(); ++i) {
        names.push_back(fraction_table()[i].name);
    }
    for (const SunShadeEntry& entry : sun_shade_table()) {
        names.push_back(is_over_time ? entry.of_sums : entry.name);
    }
    names.push_back(is_over_time ? kSunlitHours : "sunlit_fraction");
    if (!is_summed(times)) {
        names.emplace_back("ratios");
    }
    if (is_of_groups) {
        names.push_back(is_over_time ? kSunlitAreaHours : "sunlit_area");
    }
    return names;
}

}  // namespace quasimc
