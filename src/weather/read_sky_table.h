#pragma once

#include <string>
#include <string_view>

#include "light/models/sky_table.h"
#include "quasimc/error.h"

namespace quasimc {

/// Format of a sky file.
enum class SkyFileFormat {
    cells,  ///< "azimuths elevations", then a line of values for each ring, from the horizon up;
            ///< the first value of a ring is that of the cell that begins in the north, the others
            ///< follow clockwise
    vlab,   ///< "azimuths elevations", then a line "azimuth elevation value" for each cell, azimuth
            ///< by azimuth; the angles don't count: the first azimuth begins in the north and they
            ///< run over west, as the original program has it
};
/// Quantity of a cell's value.
enum class SkyValues {
    radiance,  ///< proportional to radiance
    flux,  ///< proportional to radiance x solid angle: the light of the cell on a plane facing it
};

/// Reads cells of azimuth and elevation; azimuths begin in the north and run clockwise or, with
/// SkyFileFormat::vlab, over west.
/// @param name  of the file, for messages
/// @throws InputError  with all faults of the file
[[nodiscard]] SkyTable read_sky_table(
    std::string_view text, const std::string& name, SkyFileFormat format, SkyValues values);

}  // namespace quasimc
