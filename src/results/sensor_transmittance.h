#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/scene.h"

namespace quasimc {

/// The light from above on a sensor, as a fraction of that on the horizontal above the canopy.
inline constexpr std::string_view kTransmittance = "transmittance";

/// Whether the upper sides of sensors receive the light that a horizontal surface would: they face
/// up and see the whole hemisphere.
[[nodiscard]] bool receives_horizontal(const SensorSet& set);

/// The transmittance of sensors that receive horizontal light, of a scene whose light on the
/// horizontal may be known (Result::canopy).
class SensorTransmittance {
  public:
    explicit SensorTransmittance(const Scene& scene);

    /// Whether some sensor may have one.
    [[nodiscard]] bool exists() const { return area_ > 0; }
    [[nodiscard]] bool has(std::size_t row) const { return area_ > 0 && rows_[row]; }
    /// @param light  a Result or a SeriesSum with sensors
    /// @returns a quotient of means, or of sums; unknown where the sensor has none, or the light on
    /// the horizontal is unknown or 0
    template <typename Light>
    [[nodiscard]] Estimate at(const Light& light, std::size_t row, std::size_t band) const {
        const bool is_known = has(row) && !light.canopy.empty() && light.canopy[band].incident > 0;
        return is_known ? scaled(
                              light.sensors->at(row, Quantity::incident_upper, band),
                              area_ / light.canopy[band].incident)
                        : kUnknownEstimate;
    }

  private:
    double area_ = 0;         // horizontal; 0: no sensor has one
    std::vector<bool> rows_;  // by result of sensors
};

}  // namespace quasimc
