#include "series/control_rules.h"

#include <algorithm>

namespace quasimc {
namespace {

/// The factor while the lamps are on, from set point and smallest factor.
double dimmed(const LampControl& control, const ControlledLight& light) {
    if (!control.set_point) {
        return 1;
    }
    const double missing = *control.set_point - light.daylight - light.other_lamps;
    const double factor = std::clamp(missing / light.lamps, 0.0, 1.0);
    return factor < control.dim_min ? 0 : factor;
}

}  // namespace

LampFactor lamp_factor(
    const LampControl& control, const ControlledLight& light, double seconds, const DaySoFar& day) {
    const bool is_bright = control.on_below && light.daylight >= *control.on_below;
    if (is_bright || day.is_reached || !(light.lamps > 0)) {
        return {};
    }
    const double factor = dimmed(control, light);
    if (factor == 0 || !control.daily_target) {
        return {factor, factor > 0 ? 1.0 : 0.0};
    }
    const double missing = *control.daily_target - day.light;
    const double all = (light.daylight + light.other_lamps + factor * light.lamps) * seconds;
    if (all < missing) {
        return {factor, 1};
    }
    const double part = std::max(0.0, missing / all);
    return {part * factor, part, true};
}

}  // namespace quasimc
