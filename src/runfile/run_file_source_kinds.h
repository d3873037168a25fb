#pragma once

// Functions shared by the readers of kinds of sources. Included only by the run_file_*.cpp of
// sources.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "light/models/catalogue.h"
#include "quasimc/source.h"
#include "runfile/run_file_sections.h"

namespace quasimc {

/// A source with its description for headers.
struct NotedSource {
    std::shared_ptr<const Source> source;
    std::string note;
    std::optional<SunSpec> sun = {};       ///< sun of a source of type "sun"
    std::optional<DailyHours> hours = {};  ///< hours in which it shines
};

/// "irradiance on the horizontal: PAR 400 W m-2, ..."
[[nodiscard]] std::string format_irradiance(
    std::string_view plane, const std::vector<double>& values, const std::vector<Band>& bands);
/// The text of a unit vector, with values within rounding of 0 as 0.
[[nodiscard]] std::string format_vector(const Vec3& v);
/// The text of the direction opposite to `travel`: azimuth from north over east, elevation.
[[nodiscard]] std::string format_angles(const Vec3& travel, const Orientation& orientation);

/// The irradiance of a source, on exactly one plane.
struct Irradiance {
    std::vector<double> values;
    bool on_horizontal = false;
};

/// Reads the irradiance of a source; empty after a fault.
[[nodiscard]] std::optional<Irradiance> read_irradiance(
    TableReader& table, const std::vector<Band>& bands);
/// Reads the irradiance on the plane facing light from `sine` = sin(elevation); empty after a
/// fault.
[[nodiscard]] std::optional<std::vector<double>> facing_irradiance(
    TableReader& table, Irradiance irradiance, double sine);

/// The direction of `azimuth_deg` and `elevation_deg`, unit, z up; empty after a fault.
/// run_file_sun.cpp
[[nodiscard]] std::optional<Vec3> read_towards(TableReader& table, const Orientation& orientation);
/// Position of the sun by `time` (and [site]) or by `azimuth_deg` and `elevation_deg`; empty
/// after a fault. run_file_sun.cpp
[[nodiscard]] std::optional<SunSpec> read_sun_spec(
    TableReader& table, const RunFileContext& context);
/// "2024-06-21T12:00+02:00 at latitude 50, longitude 8, sun towards (...) (azimuth ...)"
[[nodiscard]] std::string describe_sun(const SunSpec& sun, const Orientation& orientation);

/// The shape of a sky, and its description.
struct SkyShapeSpec {
    SkyShape shape;
    std::string description;
};

/// Reads a vector of any length as a unit vector, z up; empty after a fault. run_file_lamps.cpp
/// @param usual  default; empty: the key is required
[[nodiscard]] std::optional<Vec3> read_direction(
    TableReader& table,
    std::string_view key,
    const std::optional<Vec3>& usual,
    const RunFileContext& context);

// The readers of kinds of sources; empty after a fault. run_file_directional.cpp
[[nodiscard]] std::optional<NotedSource> read_directional(
    TableReader& table, const std::string& name, const RunFileContext& context);
// run_file_sun.cpp
[[nodiscard]] std::optional<NotedSource> read_sun(
    TableReader& table, const std::string& name, const RunFileContext& context);
// run_file_sky.cpp
[[nodiscard]] std::optional<NotedSource> read_sky(
    TableReader& table, const std::string& name, const RunFileContext& context);
[[nodiscard]] std::optional<NotedSource> read_uniform_sky(
    TableReader& table, const std::string& name, const RunFileContext& context);
// run_file_lamp_copies.cpp: the tables of the copies of a lamp with `at`; empty after a fault
[[nodiscard]] std::vector<Node> lamp_tables(const Node& source, RunFileContext& context);
// run_file_lamps.cpp: all types of lamps
[[nodiscard]] std::optional<NotedSource> read_lamp(
    TableReader& table, const std::string& name, const RunFileContext& context);

}  // namespace quasimc
