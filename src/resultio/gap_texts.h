#pragma once

#include <string>
#include <vector>

#include "quasimc/gap_fraction.h"

namespace quasimc {

/// The meaning of the columns of a table of gap fractions as comments, and the header line.
/// @param first  columns before its own
[[nodiscard]] std::string gap_header(const std::vector<std::string>& first);
/// The rows of gap fractions, each number in one row.
/// @param first  beginning of each row
[[nodiscard]] std::string gap_rows(const GapFractions& found, const std::string& first);

/// Gap fractions and indices in words, for a terminal.
[[nodiscard]] std::string describe_gaps(const GapFractions& found);

}  // namespace quasimc
