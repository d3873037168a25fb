#pragma once

// What of a result is written: [output] of the run file.

#include <cstddef>
#include <string>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The columns that a run asks for, in the order of the tables.
struct WrittenColumns {
    std::vector<QuantityEntry> quantities;
    std::vector<std::size_t> bands;
    bool has_sunlit = true;  ///< what is sunlit
    bool is_all = true;      ///< whether nothing is left out
};
[[nodiscard]] WrittenColumns written_columns(const RunFile& run);
/// Everything that there is.
[[nodiscard]] WrittenColumns all_columns(const RunFile& run);

/// "absorbed_flux_PAR", ...: each quantity of each band, band by band.
[[nodiscard]] std::vector<std::string> light_columns_of(
    const RunFile& run, const WrittenColumns& columns);

/// Whether a time of a run is written: not one without light, nor outside the hours, unless they
/// are asked for.
[[nodiscard]] bool is_written(const RunFile& run, std::size_t time_step, const Result& result);

/// "paths = 1024, material.leaf.reflectance = 0.1".
[[nodiscard]] std::string describe_point(const SweepPoint& point);

/// Adds a fault for each unknown quantity or band of that choice; their locations are
/// "quantities" and "bands".
void check_written(const OutputSpec& output, const std::vector<Band>& bands, Faults& faults);

}  // namespace quasimc
