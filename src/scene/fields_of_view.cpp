// Fields of view: sensors that count only light near their normals.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "base/text.h"
#include "scene/scene_checks.h"
#include "scene/scene_draft.h"

namespace quasimc {
namespace {

constexpr double kHemisphere = 90;

bool passes_everything(const std::vector<SideOptics>& side) {
    return std::all_of(side.begin(), side.end(), [](const SideOptics& optics) {
        return optics.transmittance == 1 && optics.transmission_model == "mirror";
    });
}

}  // namespace

bool passes_everything(const MaterialSpec& material) {
    return passes_everything(material.upper) && passes_everything(material.lower);
}

double least_cosine(double field_of_view_deg) {
    return field_of_view_deg >= kHemisphere ? 0
                                            : std::cos(field_of_view_deg * std::numbers::pi / 180);
}

void check_fields_of_view(
    const SceneDraft& draft,
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    OrganFaults& faults) {
    std::unordered_map<std::string_view, bool> is_sensor;
    for (const auto& [material, where] : materials) {
        is_sensor[material.name] = passes_everything(material);
    }
    for (std::size_t i = 0; i < draft.organs.size(); ++i) {
        const double angle = draft.given[i].field_of_view_deg;
        if (angle == kHemisphere) {
            continue;
        }
        if (!(angle > 0 && angle < kHemisphere)) {
            faults.add(
                draft, i,
                {"", "its field of view is " + shortest(angle) + " degrees",
                 "the half angle about the normal must be above 0 and at most 90", ""});
        }
        const std::span<const DraftPart> parts = draft.parts_of(i);
        const bool all_sensors =
            std::all_of(parts.begin(), parts.end(), [&](const DraftPart& part) {
                const auto found = is_sensor.find(draft.material_names[part.material]);
                return found == is_sensor.end() || found->second;
            });
        if (!all_sensors) {
            faults.add(
                draft, i,
                {"", "it has a field of view but is not a sensor",
                 "absorbing and scattering surfaces receive light from all directions",
                 "give it a material with transmittance 1 and transmission_model \"mirror\", or "
                 "remove the field of view"});
        }
    }
}

}  // namespace quasimc
