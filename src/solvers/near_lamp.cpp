#include "solvers/near_lamp.h"

#include <algorithm>
#include <cmath>

namespace quasimc {

namespace {

Illumination light_of(const Source& source, const Vec3& place) {
    constexpr double kMiddle = 0.5;
    return source.illuminate(place, kMiddle, kMiddle);
}

/// On the middle of the box and half way to its corners, of those that are lit.
double dimmest_light(const Source& source, const Bounds& bounds) {
    const Vec3 quarter = 0.25 * bounds.size();
    double dimmest = light_of(source, bounds.center()).weight;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const Vec3 half_way{
            (corner & 1U) != 0 ? quarter.x : -quarter.x,
            (corner & 2U) != 0 ? quarter.y : -quarter.y,
            (corner & 4U) != 0 ? quarter.z : -quarter.z};
        const double weight = light_of(source, bounds.center() + half_way).weight;
        dimmest = weight > 0 ? std::min(dimmest, weight) : dimmest;
    }
    return dimmest;
}

}  // namespace

bool is_near_lamp(const Source& source, const Bounds& bounds) {
    if (!source.is_lamp()) {
        return false;
    }
    constexpr double kMuchBrighter = 16;
    const Illumination middle = light_of(source, bounds.center());
    if (!(middle.weight > 0 && std::isfinite(middle.distance))) {
        return true;
    }
    const Vec3 place = bounds.center() + middle.distance * middle.to_light;
    const Vec3 nearest{
        std::clamp(place.x, bounds.low.x, bounds.high.x),
        std::clamp(place.y, bounds.low.y, bounds.high.y),
        std::clamp(place.z, bounds.low.z, bounds.high.z)};
    const Vec3 gap = place - nearest;
    return dot(gap, gap) == 0 ||
           light_of(source, nearest).weight > kMuchBrighter * dimmest_light(source, bounds);
}

}  // namespace quasimc
