#include "light/models/sky_table.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "base/angles.h"
#include "base/checks.h"

namespace quasimc {
namespace {

std::size_t last_at_most(double position, std::size_t count) {
    const auto index = static_cast<std::size_t>(std::max(0.0, position));
    return std::min(index, count - 1);
}

}  // namespace

double SkyTable::towards(const Vec3& to_light) const {
    const double elevation = std::asin(std::clamp(to_light.z, 0.0, 1.0));
    const double turned = turn * (std::atan2(to_light.y, to_light.x) - first_azimuth) / kFullTurn;
    const auto columns = static_cast<double>(azimuths);
    const auto rows = static_cast<double>(elevations);
    return at(
        last_at_most((turned - std::floor(turned)) * columns, azimuths),
        last_at_most(elevation / (kFullTurn / 4) * rows, elevations));
}

SkyShape table_shape(SkyTable table) {
    EXPECT(table.azimuths > 0 && table.elevations > 0);
    EXPECT(table.radiance.size() == table.azimuths * table.elevations);
    SkyShape shape;
    shape.inside = InsideCells::constant;
    for (std::size_t i = 0; i < table.azimuths; ++i) {
        shape.azimuths.push_back(
            table.first_azimuth +
            table.turn * kFullTurn * static_cast<double>(i) / static_cast<double>(table.azimuths));
    }
    for (std::size_t i = 1; i < table.elevations; ++i) {
        shape.sines.push_back(std::sin(
            kFullTurn / 4 * static_cast<double>(i) / static_cast<double>(table.elevations)));
    }
    shape.radiance = [shared = std::make_shared<const SkyTable>(std::move(table))](
                         const Vec3& to_light) { return shared->towards(to_light); };
    return shape;
}

}  // namespace quasimc
