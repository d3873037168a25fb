#pragma once

#include "quasimc/lamp_control.h"

namespace quasimc {

/// Mean irradiance at the sensors of a control at a time.
struct ControlledLight {
    double daylight = 0;
    double other_lamps = 0;
    double lamps = 0;  ///< light of the lamps of the control, undimmed
};

/// The sum of a day, irradiance unit x s.
struct DaySoFar {
    double light = 0;
    bool is_reached = false;  ///< whether the daily target ended the light of the lamps
};

/// The factor on the light of lamps, as in ControlStep.
struct LampFactor {
    double factor = 0, on = 0;
    bool reaches_target = false;  ///< whether the daily target ends it within this time
};

/// Applies the rules of a control to a time.
/// @param seconds  its duration
[[nodiscard]] LampFactor lamp_factor(
    const LampControl& control, const ControlledLight& light, double seconds, const DaySoFar& day);

}  // namespace quasimc
