#pragma once

#include <optional>

#include "quasimc/error.h"
#include "quasimc/run_file.h"

namespace quasimc {

/// Why a table that sums over the points of a sweep can't add a point to the first: their rows, or
/// their numbers of replicates, differ. The problem is a part of a sentence: "has 2 organs, ...".
[[nodiscard]] std::optional<Fault> difference_of_rows(
    const RunFile& first, const RunFile& other, const TableSpec& table);

}  // namespace quasimc
