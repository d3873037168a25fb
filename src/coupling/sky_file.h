#pragma once

#include <optional>
#include <string>

#include "coupling/vlab/directive.h"
#include "light/models/sky_table.h"

namespace quasimc {

/// The text of a sky file without comments, in one line.
[[nodiscard]] std::string sky_file_numbers(std::string_view text);

/// Reads the sky of a sky file. The count of numbers after the first two gives the form: three per
/// cell (azimuth, elevation, radiance), or one or two per sample of a distribution function
/// (MonteCarlo). Errors become faults; the result is then empty.
[[nodiscard]] std::optional<SkyTable> read_sky_table(Values& numbers);

}  // namespace quasimc
