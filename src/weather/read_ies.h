#pragma once

#include <string>
#include <string_view>

#include "quasimc/source.h"
#include "text/table_reader.h"

namespace quasimc {

/// A photometric file (docs/reference/ies.md): angular distribution of a luminaire, and size of its
/// opening.
struct IesFile {
    PhotometricWeb web;                ///< ballast factor and multiplier included
    double length_m = 0, width_m = 0;  ///< size of the opening along and across the 0 degree plane
    double radius_m = 0;               ///< radius of a round opening; then length and width are 0
};

/// Reads IES LM-63 (1986, 1991, 1995, 2002, 2019), type C. Faults go to the reporter; the result is
/// then invalid.
[[nodiscard]] IesFile read_ies(std::string_view text, Reporter& reporter);

}  // namespace quasimc
