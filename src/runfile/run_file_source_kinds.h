#pragma once

// What the readers of the kinds of sources share. Included by the run_file_*.cpp of sources only.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "light/models/catalogue.h"
#include "quasimc/source.h"
#include "runfile/run_file_sections.h"

namespace quasimc {

/// A source with the words that tell it in a header.
struct NotedSource {
    std::shared_ptr<const Source> source;
    std::string note;
    std::optional<SunSpec> sun = {};       ///< of a source of type "sun"
    std::optional<DailyHours> hours = {};  ///< within which it shines
};

/// "irradiance on the horizontal: PAR 400 W m-2, ..."
[[nodiscard]] std::string format_irradiance(
    std::string_view plane, const std::vector<double>& values, const std::vector<Band>& bands);
/// A unit vector; what is but rounding is 0.
[[nodiscard]] std::string format_vector(const Vec3& v);
/// Where light that travels along `travel` comes from: azimuth from north over east, elevation.
[[nodiscard]] std::string format_angles(const Vec3& travel, const Orientation& orientation);

/// The irradiance of a source, on exactly one plane.
struct Irradiance {
    std::vector<double> values;
    bool on_horizontal = false;
};

/// Nothing after a fault.
[[nodiscard]] std::optional<Irradiance> read_irradiance(
    TableReader& table, const std::vector<Band>& bands);
/// On the plane facing light from `sine` = sin(elevation); nothing after a fault.
[[nodiscard]] std::optional<std::vector<double>> facing_irradiance(
    TableReader& table, Irradiance irradiance, double sine);

/// The direction of `azimuth_deg` and `elevation_deg`, unit, z up; nothing after a fault.
/// run_file_sun.cpp
[[nodiscard]] std::optional<Vec3> read_towards(TableReader& table, const Orientation& orientation);
/// Where the sun stands, by `time` (and [site]) or by `azimuth_deg` and `elevation_deg`; nothing
/// after a fault. run_file_sun.cpp
[[nodiscard]] std::optional<SunSpec> read_stated_sun(
    TableReader& table, const RunFileContext& context);
/// "2024-06-21T12:00+02:00 at latitude 50, longitude 8, sun towards (...) (azimuth ...)"
[[nodiscard]] std::string describe_sun(const SunSpec& sun, const Orientation& orientation);

/// The shape of a sky, and the words that tell it.
struct SkyShapeSpec {
    SkyShape shape;
    std::string words;
};

/// A vector of some length, as a unit vector with z up; nothing after a fault. run_file_lamps.cpp
/// @param usual  if none is stated; nothing: it must be
[[nodiscard]] std::optional<Vec3> read_direction(
    TableReader& table,
    std::string_view key,
    const std::optional<Vec3>& usual,
    const RunFileContext& context);

// The kinds of sources: nothing after a fault.
// run_file_directional.cpp
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
// run_file_lamps.cpp: of every type of lamp
[[nodiscard]] std::optional<NotedSource> read_lamp(
    TableReader& table, const std::string& name, const RunFileContext& context);

}  // namespace quasimc
