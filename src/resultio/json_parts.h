#pragma once

// The parts that results in JSON are made of. Included by their writers and readers only.

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/series.h"
#include "runfile/run_file.h"
#include "runfile/written.h"
#include "text/json.h"

namespace quasimc {

/// The format_version of results.
inline constexpr int kResultVersion = 2;

// Members of the outermost object, as objects.
/// The members that are known before the run: program, files, settings, scene.
[[nodiscard]] Json json_head(const RunFile& run);
[[nodiscard]] Json json_warnings(const RunFile& run);
/// A value of a run file.
[[nodiscard]] Json json_value(const Node& node);

/// "time_limit".
[[nodiscard]] std::string_view stop_name(StopReason stop);
/// A result without groups and organs: method, completed work, rounds, energy.
[[nodiscard]] Json json_light(
    std::span<const Band> bands, const std::string& length_unit, const Result& result);
/// A result of a run file: also requested method, audit, canopy and detectors.
[[nodiscard]] Json json_light(const RunFile& run, const Result& result);
/// The light on the horizontal, and the fractions of a canopy. @param units  of fluxes, by band
[[nodiscard]] Json json_canopy(
    const Scene& scene,
    const std::vector<CanopyFractions>& canopy,
    const std::vector<std::string>& units);
[[nodiscard]] Json json_estimate(const Estimate& estimate);
[[nodiscard]] Json json_vector(const Vec3& vector);

/// The names of quantities, bands and ratios, quoted, and which of them are written.
struct JsonNames {
    std::vector<std::string> quantities, bands, ratios;  // all
    WrittenColumns columns;
};
[[nodiscard]] JsonNames json_names(const RunFile& run, WrittenColumns columns);

/// The member "control" of a series: its lamps under control, sums in the unit of summed_unit().
[[nodiscard]] Json json_controls(const RunFile& run);

// Rows, each on one line: there may be millions.
/// An organ with its estimates.
[[nodiscard]] std::string json_organ(
    const Organ& organ, const Result& result, std::size_t index, const JsonNames& names);
/// An organ with its sums, in the units of the sum.
[[nodiscard]] std::string json_organ(
    const Organ& organ, const SeriesSum& sum, std::size_t index, const JsonNames& names);
/// A sensor.
struct SensorRow {
    const Organ& sensor;
    Vec3 position;  ///< the file's axes
    Receiver receiver;
    std::vector<Estimate> transmittance = {};  ///< by band; empty: it has none
};
/// A sensor with its estimates: on a sphere the fluence rate, on others the light by sides.
[[nodiscard]] std::string json_sensor(
    const SensorRow& row, const Result& sensors, std::size_t index, const JsonNames& names);
[[nodiscard]] std::string json_sensor(
    const SensorRow& row, const SeriesSum& sensors, std::size_t index, const JsonNames& names);
/// The groups of an origin of light.
struct OriginGroups {
    std::string_view name;
    const GroupResults* groups;
};
/// A group with its estimates. @param times  days: they are sums, in the units of the sum
[[nodiscard]] std::string json_group(
    const GroupResults& groups,
    std::size_t index,
    const JsonNames& names,
    const std::vector<OriginGroups>& origins = {},
    CsvTimes times = CsvTimes::time_steps);

}  // namespace quasimc
