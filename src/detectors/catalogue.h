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

/// Which light a detector is told of.
enum class DetectedLight {
    escaped,  ///< scattered light that leaves the scene: solvers that do not follow it are refused
};

/// One row of the table of types of detectors.
struct DetectorEntry {
    std::string_view name;     ///< as in `type = "..."`
    std::string_view summary;  ///< one line for the manual
    DetectedLight light = DetectedLight::escaped;
    std::span<const DetectorParameter> parameters = {};
    /// @param values  one for each of the parameters, in their order and domains
    std::unique_ptr<Detector> (*make)(std::span<const double> values) = nullptr;
};

/// All types, in the order of the manual.
[[nodiscard]] std::span<const DetectorEntry> detector_catalogue();
/// The row of that name, or null.
[[nodiscard]] const DetectorEntry* find_detector(std::string_view name);

/// The detector of a specification that check_detectors() found no fault with.
[[nodiscard]] std::unique_ptr<Detector> make_detector(const DetectorSpec& spec);

/// The specifications with their names set. Adds a fault for each unknown type or parameter, value
/// outside its domain, parameter that must be stated and is not, and name that is there twice.
[[nodiscard]] std::vector<DetectorSpec> check_detectors(
    std::vector<DetectorSpec> specs, Faults& faults);

/// Whether some of them must be told of light that escapes.
[[nodiscard]] bool need_escaped_light(std::span<const DetectorSpec> specs);

/// "rings 1 ... 180" for the manual; "" for a type without parameters.
[[nodiscard]] std::string describe_parameters(const DetectorEntry& type);

}  // namespace quasimc
