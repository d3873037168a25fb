#include "planner/near_lamp.h"

#include <algorithm>
#include <cmath>

#include "base/vec3.h"

namespace quasimc {

namespace {

Illumination light_of(const Source& source, const Vec3& position) {
    constexpr double kMiddle = 0.5;
    return model_of(source).illuminate(position, kMiddle, kMiddle);
}

/// The least light on the centre of the box and half way from `nearest` to its corners, if lit.
double dimmest_light(const Source& source, const Bounds& bounds, const Vec3& nearest) {
    double dimmest = light_of(source, bounds.center()).weight;
    for (const Vec3& corner : corners_of(bounds)) {
        const double weight = light_of(source, nearest + 0.5 * (corner - nearest)).weight;
        dimmest = weight > 0 ? std::min(dimmest, weight) : dimmest;
    }
    return dimmest;
}

}  // namespace

std::optional<Vec3> position_of_lamp(const Source& source, const Bounds& bounds) {
    if (!source.is_lamp()) {
        return std::nullopt;
    }
    const Illumination middle = light_of(source, bounds.center());
    if (!(middle.weight > 0 && std::isfinite(middle.distance))) {
        return std::nullopt;
    }
    return bounds.center() + middle.distance * middle.to_light;
}

bool is_near_lamp(const Source& source, const Bounds& bounds) {
    if (!source.is_lamp()) {
        return false;
    }
    constexpr double kMuchBrighter = 16;
    const std::optional<Vec3> known = position_of_lamp(source, bounds);
    if (!known) {
        return true;
    }
    const Vec3 position = *known;
    const Vec3 nearest{
        std::clamp(position.x, bounds.low.x, bounds.high.x),
        std::clamp(position.y, bounds.low.y, bounds.high.y),
        std::clamp(position.z, bounds.low.z, bounds.high.z)};
    const Vec3 gap = position - nearest;
    return dot(gap, gap) == 0 || light_of(source, nearest).weight >
                                     kMuchBrighter * dimmest_light(source, bounds, nearest);
}

}  // namespace quasimc
