#pragma once

#include <optional>
#include <string>

#include "coupling/vlab/directive.h"
#include "light/models/sky_table.h"

namespace quasimc {

/// A sky file without its comments, in one line.
[[nodiscard]] std::string sky_file_numbers(std::string_view text);

/// The sky of a sky file. How many numbers follow the two counts tells the form: three for each
/// cell (azimuth, elevation, radiance), or one or two for each sample of a distribution function,
/// as MonteCarlo has them. What is wrong becomes a fault, and the answer nothing.
[[nodiscard]] std::optional<SkyTable> read_sky_table(Values& numbers);

}  // namespace quasimc
