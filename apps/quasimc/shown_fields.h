#pragma once

#include <vector>

#include "resultio/field_formats.h"
#include "show_values.h"

/// A scene with numbers and their standard errors, as separate fields.
/// @param colored  values that the colours show, on the scale of pictures; or null
[[nodiscard]] quasimc::FieldScene field_scene(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all, const ShownValues* colored);

/// The values of the chosen quantity and band; of the first band if none is chosen.
/// @throws quasimc::InputError  if there are none
[[nodiscard]] const ShownValues& chosen_values(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all, const ValueChoice& choice);
