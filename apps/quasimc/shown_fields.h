#pragma once

#include <vector>

#include "resultio/field_formats.h"
#include "show_values.h"

/// A scene with numbers and their standard errors, under names of their own.
/// @param colored  of which organs have the colours, on the scale that pictures have; or null
[[nodiscard]] quasimc::FieldScene field_scene(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all, const ShownValues* colored);

/// Those of the quantity and the band that are chosen; of the first band if none is.
/// @throws quasimc::InputError  if there are none
[[nodiscard]] const ShownValues& chosen_values(
    const quasimc::Scene& scene, const std::vector<ShownValues>& all, const ValueChoice& choice);
