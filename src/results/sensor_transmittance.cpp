#include "results/sensor_transmittance.h"

#include <algorithm>
#include <cmath>

#include "results/groups.h"
#include "sums/statistics.h"

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

Estimate SensorTransmittance::of(
    const Estimate& upper, const std::vector<CanopyFractions>& canopy, std::size_t band) const {
    const bool is_known = area_ > 0 && !canopy.empty() && canopy[band].incident > 0;
    return is_known ? scaled(upper, area_ / canopy[band].incident) : kUnknownEstimate;
}

}  // namespace quasimc
