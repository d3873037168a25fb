#include "results/sensor_transmittance.h"

#include <algorithm>
#include <cmath>

#include "results/groups.h"

namespace quasimc {

bool receives_horizontal(const SensorSet& set) {
    constexpr double kRounding = 1e-9;
    return set.receiver == Receiver::cosine && set.field_of_view_deg == 90 &&
           std::ranges::all_of(
               set.points, [](const SensorPoint& point) { return point.facing.z > 1 - kRounding; });
}

SensorTransmittance::SensorTransmittance(const Scene& scene) {
    for (const SensorSet& set : scene.sensors()) {
        rows_.insert(rows_.end(), set.rows(), receives_horizontal(set));
    }
    const bool has_one = std::ranges::find(rows_, true) != rows_.end();
    const double area = has_one ? horizontal_area(scene) : 0;
    area_ = std::isnan(area) ? 0 : area;
}

}  // namespace quasimc
