#pragma once

// What the readers of the kinds of sources share. Included by the run_file_*.cpp of sources only.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/io/run_file_sections.h"

namespace quasimc {

/// A source with the words that tell it in a header.
struct NotedSource {
    std::shared_ptr<const Source> source;
    std::string note;
};

/// "irradiance on the horizontal: PAR 400 W m-2, ..."
[[nodiscard]] std::string irradiance_words(
    std::string_view plane, const std::vector<double>& values, const std::vector<Band>& bands);
/// A unit vector; what is but rounding is 0.
[[nodiscard]] std::string vector_words(const Vec3& v);
/// Where light that travels along `travel` comes from: azimuth from north over east, elevation.
[[nodiscard]] std::string angles_words(const Vec3& travel, const Orientation& orientation);

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

// The kinds: nothing after a fault.
// run_file_directional.cpp
[[nodiscard]] std::optional<NotedSource> read_directional(
    TableReader& table, const std::string& name, const RunFileContext& context);
// run_file_sky.cpp
[[nodiscard]] std::optional<NotedSource> read_uniform_sky(
    TableReader& table, const std::string& name, const RunFileContext& context);

}  // namespace quasimc
