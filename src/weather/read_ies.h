#pragma once

#include <string>
#include <string_view>

#include "quasimc/source.h"
#include "text/table_reader.h"

namespace quasimc {

/// A photometric file (docs/reference/ies.md): how a luminaire shines, and the size of its opening.
struct IesFile {
    PhotometricWeb web;                ///< ballast factor and multiplier included
    double length_m = 0, width_m = 0;  ///< of the opening, along and across the 0 degree plane
    double radius_m = 0;               ///< of a round opening; then length and width are 0
};

/// Reads IES LM-63 (1986, 1991, 1995, 2002, 2019), type C. What is wrong goes to the reporter;
/// nothing is to be used then.
[[nodiscard]] IesFile read_ies(std::string_view text, Reporter& reporter);

}  // namespace quasimc
