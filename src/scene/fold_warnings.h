#pragma once

#include <vector>

#include "quasimc/scene.h"

namespace quasimc {

/// Makes one warning of more than three that differ in names and numbers alone: the text of the
/// first, with the first three locations and the count. Folded warnings can be folded again.
/// @param others  follow as they are
[[nodiscard]] std::vector<Warning> fold_warnings(
    std::vector<Warning> warnings, std::vector<Warning> others = {});

}  // namespace quasimc
