#pragma once

// The parts that results in JSON are made of. Included by their writer and reader only.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/results/json_stream.h"
#include "io/results/written.h"
#include "io/runfile/run_file.h"
#include "quasimc/result.h"
#include "quasimc/series.h"

namespace quasimc {

/// The format_version of results (docs/formats/json.md says what each changed).
inline constexpr int kResultVersion = 2;

// json_head.cpp: members of the outermost object.
/// What is known before anything is traced.
void json_head(JsonStream& json, const RunFile& run);
void json_warnings(JsonStream& json, const RunFile& run);
/// A value of a run file.
void json_value(JsonStream& json, const Node& node, JsonLayout layout);

// json_parts.cpp: members on one result. Their objects stand in `layout`.
void json_method(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout);
/// "time_is_up".
[[nodiscard]] std::string_view stop_name(StopReason stop);
void json_done(JsonStream& json, const Result& result, JsonLayout layout);
/// A list with what was known after each round; none if there was one round.
void json_rounds(JsonStream& json, const Result& result, JsonLayout layout);
/// null without one.
void json_audit(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout);
/// @param bands  of the result
void json_energy(
    JsonStream& json,
    std::span<const Band> bands,
    const std::string& length_unit,
    const Result& result,
    JsonLayout layout);
inline void json_energy(
    JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout) {
    json_energy(json, run.scene.bands(), run.scene.length_unit(), result, layout);
}

/// "key": {"mean": ..., ...}.
void json_estimate(JsonStream& json, std::string_view key, const Estimate& e, JsonLayout layout);

/// An estimate as an object on one line.
void json_compact_estimate(JsonStream& json, const Estimate& e);

// json_detectors.cpp: a member on one result; none if there are no detectors.
void json_detectors(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout);

// json_organs.cpp
/// The names of quantities, bands and ratios, quoted, and which of them are written.
struct JsonNames {
    std::vector<std::string> quantities, bands, ratios;  // all
    WrittenColumns columns;
};
[[nodiscard]] JsonNames json_names(const RunFile& run, WrittenColumns columns);
/// An organ on one line: there may be millions.
[[nodiscard]] std::string json_organ(
    const Organ& organ, const Result& result, std::size_t index, const JsonNames& names);
/// The same of a sum, whose values are in the units of the sum.
[[nodiscard]] std::string json_organ_sum(
    const Organ& organ, const SeriesSum& sum, std::size_t index, const JsonNames& names);
/// The estimates of every quantity and band that is written.
/// @param light  a Result, a SeriesSum or a GroupResults
template <typename Light>
void json_quantities(
    JsonStream& json, const Light& light, std::size_t index, const JsonNames& names) {
    for (const QuantityEntry& entry : names.columns.quantities) {
        json.quoted_key(names.quantities[static_cast<std::size_t>(entry.quantity)]);
        json.begin_object(JsonLayout::compact);
        for (const std::size_t b : names.columns.bands) {
            if (b < light.bands) {  // a total that nobody wanted has none
                json.quoted_key(names.bands[b]);
                json_compact_estimate(json, light.at(index, entry.quantity, b));
            }
        }
        json.end_object();
    }
}

// json_groups.cpp: members on one result, or on a sum; none if there is nothing to tell.
void json_groups(JsonStream& json, const RunFile& run, const GroupResults& groups);
void json_canopy(JsonStream& json, const RunFile& run, const Result& result, JsonLayout layout);

}  // namespace quasimc
