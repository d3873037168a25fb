// Fields of view: sensors that count only light from near their normals.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "base/text.h"
#include "scene/scene_checks.h"

namespace quasimc {
namespace {

constexpr double kHemisphere = 90;

bool passes_everything(const std::vector<SideOptics>& side) {
    return std::all_of(side.begin(), side.end(), [](const SideOptics& optics) {
        return optics.transmittance == 1 && optics.transmission_model == "mirror";
    });
}

}  // namespace

double least_cosine(double field_of_view_deg) {
    return field_of_view_deg >= kHemisphere ? 0
                                            : std::cos(field_of_view_deg * std::numbers::pi / 180);
}

void check_fields_of_view(
    std::span<const OrganSpec> organs,
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    OrganFaults& faults) {
    std::unordered_map<std::string_view, bool> is_sensor;
    for (const auto& [material, place] : materials) {
        is_sensor[material.name] =
            passes_everything(material.upper) && passes_everything(material.lower);
    }
    for (const OrganSpec& organ : organs) {
        const double angle = organ.field_of_view_deg;
        if (angle == kHemisphere) {
            continue;
        }
        if (!(angle > 0 && angle < kHemisphere)) {
            faults.add(
                organ, {"", "its field of view is " + shortest(angle) + " degrees",
                        "the half angle about the normal is above 0, at most 90", ""});
        }
        const bool all_sensors =
            std::all_of(organ.parts.begin(), organ.parts.end(), [&](const OrganPart& part) {
                const auto found = is_sensor.find(part.material);
                return found == is_sensor.end() || found->second;
            });
        if (!all_sensors) {
            faults.add(
                organ, {"", "it has a field of view but is no sensor",
                        "what absorbs or scatters does so with light from all directions",
                        "give it a material with transmittance 1 and transmission_model "
                        "\"mirror\", or leave the field of view out"});
        }
    }
}

}  // namespace quasimc
