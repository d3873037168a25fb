#pragma once

#include <vector>

#include "sources/pattern.h"

namespace quasimc {

/// Intensities measured on a grid of angles, as photometric files of type C give them.
struct PhotometricWeb {
    std::vector<double> vertical_deg;    ///< from the aim (0) to behind (180), ascending
    std::vector<double> horizontal_deg;  ///< from the lamp's x axis, ascending from 0; to 0, 90,
                                         ///< 180 or 360, which tells the symmetry
    std::vector<double> candela;         ///< [horizontal][vertical]
};

/// The pattern of a web: bilinear in the two angles, mirrored as its symmetry says, 0 beyond its
/// vertical angles. total() is its flux in lumens.
/// @param web  of vertical and horizontal angles as said above, with some light
[[nodiscard]] Pattern web_pattern(PhotometricWeb web);

}  // namespace quasimc
