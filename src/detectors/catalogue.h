#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "detectors/detector.h"
#include "quasimc/error.h"
#include "quasimc/scene.h"

namespace quasimc {

/// Light that a detector receives.
enum class DetectedLight {
    escaped,  ///< scattered light that leaves the scene; excludes solvers that do not follow it
};

/// One row of the table of types of detectors.
struct DetectorEntry {
    std::string_view name;     ///< value of `type = "..."`
    std::string_view summary;  ///< one line for the manual
    DetectedLight light = DetectedLight::escaped;
    std::span<const DetectorParameter> parameters = {};
    /// @param values  one for each of the parameters, in their order and domains
    std::unique_ptr<Detector> (*make)(std::span<const double> values) = nullptr;
};

/// All types, in the order of the manual.
[[nodiscard]] std::span<const DetectorEntry> detector_catalogue();
/// The row with a name, or null.
[[nodiscard]] const DetectorEntry* find_detector(std::string_view name);

/// Makes the detector of a specification that check_detectors() has accepted.
[[nodiscard]] std::unique_ptr<Detector> make_detector(const DetectorSpec& spec);

/// Returns the specifications with names. Adds a fault for each unknown type or parameter, value
/// outside its domain, missing required parameter, and repeated name.
[[nodiscard]] std::vector<DetectorSpec> check_detectors(
    std::vector<DetectorSpec> specs, Faults& faults);

/// Whether any of them receives escaped light.
[[nodiscard]] bool need_escaped_light(std::span<const DetectorSpec> specs);

/// "rings 1 ... 180" for the manual; "" for a type without parameters.
[[nodiscard]] std::string describe_parameters(const DetectorEntry& type);

}  // namespace quasimc
