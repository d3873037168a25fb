#include <utility>

#include "io/results/json_parts.h"

namespace quasimc {
namespace {

constexpr JsonLayout kOrganLayout = JsonLayout::compact;

/// The object of an organ, begun with what tells which organ it is.
JsonStream begin_organ(const Organ& organ) {
    JsonStream json;
    json.begin_object(kOrganLayout);
    json.quoted_key("\"id\"");
    json.integer(organ.id);
    json.quoted_key("\"name\"");
    json.text(organ.name);
    json.quoted_key("\"labels\"");
    json.begin_object(kOrganLayout);
    for (const auto& [key, value] : organ.labels) {
        json.key(key);
        json.text(value);
    }
    json.end_object();
    if (organ.is_ground) {
        json.quoted_key("\"ground\"");
        json.boolean(true);
    }
    json.quoted_key("\"area\"");
    json.number(organ.area);
    return json;
}

}  // namespace

void json_compact_estimate(JsonStream& json, const Estimate& estimate) {
    const Estimate e = reported(estimate);
    json.begin_object(kOrganLayout);
    json.quoted_key("\"mean\"");
    json.number(e.mean);
    json.quoted_key("\"standard_error\"");
    json.number(e.standard_error);
    json.quoted_key("\"low\"");
    json.number(e.low);
    json.quoted_key("\"high\"");
    json.number(e.high);
    json.end_object();
}

JsonNames json_names(const RunFile& run, WrittenColumns columns) {
    JsonNames names;
    names.columns = std::move(columns);
    for (const QuantityEntry& entry : quantity_table()) {
        names.quantities.push_back(JsonStream::quoted(entry.name));
    }
    for (const Band& band : run.scene.bands()) {
        names.bands.push_back(JsonStream::quoted(band.name));
    }
    for (const std::string& ratio : run.spec.ratios) {
        names.ratios.push_back(JsonStream::quoted(ratio));
    }
    return names;
}

std::string json_organ(
    const Organ& organ, const Result& result, std::size_t index, const JsonNames& names) {
    JsonStream json = begin_organ(organ);
    json_quantities(json, result, index, names);
    if (names.columns.has_sunlit && !result.sunlit_fraction.empty()) {
        json.quoted_key("\"sunlit_fraction\"");
        json_compact_estimate(json, result.sunlit_fraction[index]);
    }
    json.quoted_key("\"ratios\"");
    json.begin_object(kOrganLayout);
    for (std::size_t i = 0; i < result.ratios; ++i) {
        json.quoted_key(names.ratios[i]);
        json_compact_estimate(json, result.ratio(index, i));
    }
    json.end_object();
    json.end_object();
    return json.take();
}

std::string json_organ_sum(
    const Organ& organ, const SeriesSum& sum, std::size_t index, const JsonNames& names) {
    JsonStream json = begin_organ(organ);
    json_quantities(json, sum, index, names);
    json.end_object();
    return json.take();
}

}  // namespace quasimc
