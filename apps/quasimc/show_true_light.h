#pragma once

#include "picture/true_light.h"
#include "show_values.h"

/// The sources of a result, and the light that surfaces scatter according to it.
/// @throws quasimc::InputError  if the result has no scattered light of a single time step, or no
///         band is visible
[[nodiscard]] quasimc::TrueLightSpec true_light_of(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice);
