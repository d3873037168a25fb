#pragma once

#include "picture/true_light.h"
#include "show_values.h"

/// The light in which a result was computed, and what surfaces scatter of it by that result.
/// @throws quasimc::InputError  if the result has no scattered light of one moment, or no band is
///         visible
[[nodiscard]] quasimc::TrueLightSpec true_light_of(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice);
