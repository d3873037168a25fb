#pragma once

#include <vector>

#include "quasimc/scene.h"

namespace quasimc {

/// Replaces more than three warnings that differ only in names and numbers by one: the text of the
/// first, with the first three locations and the count. Folded warnings can be folded again.
/// @param others  appended unchanged
[[nodiscard]] std::vector<Warning> fold_warnings(
    std::vector<Warning> warnings, std::vector<Warning> others = {});

}  // namespace quasimc
