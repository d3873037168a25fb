#include "solvers/near_lamp.h"

#include <algorithm>
#include <cmath>

namespace quasimc {

bool is_near_lamp(const Source& source, const Bounds& bounds) {
    if (!source.is_lamp()) {
        return false;
    }
    constexpr double kMiddle = 0.5;
    constexpr double kMuchBrighter = 16;
    const Illumination middle = source.illuminate(bounds.center(), kMiddle, kMiddle);
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
           source.illuminate(nearest, kMiddle, kMiddle).weight > kMuchBrighter * middle.weight;
}

}  // namespace quasimc
