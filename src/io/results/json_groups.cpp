#include <cmath>

#include "io/results/fraction_table.h"
#include "io/results/json_parts.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

constexpr JsonLayout kLine = JsonLayout::compact;

void write_group(JsonStream& json, const OrganGroup& group) {
    json.text("by", group.by);
    json.text("value", group.value);
    json.count("organs", group.organs.size());
    json.number("area", group.area);
    if (group.by != kLayer || std::isnan(group.low)) {
        return;
    }
    json.number("low", group.low);
    json.number("high", group.high);
    json.number("plant_area_index", group.plant_area_index);
    json.number("cumulative_plant_area_index", group.cumulative_plant_area_index);
}

void write_sunlit_part(JsonStream& json, const GroupResults& groups, std::size_t index) {
    if (groups.sunlit_fraction.empty()) {
        return;
    }
    json.key("sunlit_fraction");
    json_compact_estimate(json, groups.sunlit_fraction[index]);
    json.key("sunlit_area");
    json_compact_estimate(json, groups.sunlit_area[index]);
}

void write_group_ratios(
    JsonStream& json, const GroupResults& groups, std::size_t index, const JsonNames& names) {
    if (groups.ratio_values.empty()) {
        return;
    }
    json.key("ratios");
    json.begin_object(kLine);
    for (std::size_t i = 0; i < groups.ratios; ++i) {
        json.quoted_key(names.ratios[i]);
        json_compact_estimate(json, groups.ratio(index, i));
    }
    json.end_object();
}

}  // namespace

void json_groups(JsonStream& json, const RunFile& run, const GroupResults& groups) {
    if (groups.groups.empty()) {
        return;
    }
    const JsonNames names = json_names(run, written_columns(run));
    json.key("groups");
    json.begin_list(JsonLayout::rows);
    for (std::size_t i = 0; i < groups.groups.size(); ++i) {
        json.begin_object(kLine);
        write_group(json, groups.groups[i]);
        json_quantities(json, groups, i, names);
        if (names.columns.has_sunlit) {
            write_sunlit_part(json, groups, i);
        }
        write_group_ratios(json, groups, i, names);
        json.end_object();
    }
    json.end_list();
}

void json_canopy(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    if (result.canopy.empty()) {
        return;
    }
    json.key("canopy");
    json.begin_object(layout);
    for (std::size_t b = 0; b < result.canopy.size(); ++b) {
        const Band& band = run.scene.bands()[b];
        json.key(band.name);
        json.begin_object(layout);
        json.text("unit", flux_unit(band.unit, run.scene.length_unit()));
        json.real("incident", result.canopy[b].incident);
        for (const FractionEntry& entry : fraction_table()) {
            json_estimate(json, entry.name, result.canopy[b].*entry.part, layout);
        }
        json.end_object();
    }
    json.end_object();
}

}  // namespace quasimc
