#pragma once

// Selection of results by [output] of the run file.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The columns of a run, in the order of the tables.
struct WrittenColumns {
    std::vector<QuantityEntry> quantities;
    std::vector<std::size_t> bands;
    std::vector<std::string> origins;       ///< their light is written too
    std::vector<SunShadeEntry> parts = {};  ///< quantities of sunlit and shaded parts
    bool has_sunlit = true;                 ///< sunlit fractions
    bool has_sunlit_hours = false;          ///< sunlit hours, in sums over time
    bool is_all = true;                     ///< whether all columns are written
};
[[nodiscard]] WrittenColumns written_columns(const RunFile& run);
/// All columns.
[[nodiscard]] WrittenColumns all_columns(const RunFile& run);

/// "absorbed_flux_PAR", ...: all quantities, band by band; then "absorbed_flux_PAR_from_sun", ...:
/// the same for each origin.
[[nodiscard]] std::vector<std::string> light_columns_of(
    const RunFile& run, const WrittenColumns& columns);

/// Sums over time that need SunShade::apart, beside those of sun_shade_table().
inline constexpr std::string_view kSunlitHours = "sunlit_hours",
                                  kSunlitAreaHours = "sunlit_area_hours";

/// Whether the name is that of a quantity which needs SunShade::apart, in results or in sums.
[[nodiscard]] bool needs_parts(std::string_view quantity);
/// Whether some output names such a quantity.
[[nodiscard]] bool needs_parts(const OutputSpec& output);

/// Whether a time step begins within the selected hours.
[[nodiscard]] bool is_selected(const RunFile& run, std::size_t time_step);

/// Whether a time step is written: by default not at night, and only within the selected hours.
[[nodiscard]] bool is_written(const RunFile& run, std::size_t time_step, const Result& result);

/// "paths = 1024, material.leaf.reflectance = 0.1".
[[nodiscard]] std::string describe_point(const SweepPoint& point);

/// Adds a fault for each unknown quantity or band of a selection; their locations are "quantities"
/// and "bands".
void check_written(const OutputSpec& output, const std::vector<Band>& bands, Faults& faults);

}  // namespace quasimc
