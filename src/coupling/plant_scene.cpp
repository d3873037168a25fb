#include "coupling/plant_scene.h"

#include <map>

#include <fmt/format.h>

#include "coupling/lighting.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

const std::string kSensorName = "sensor";

/// The materials of a scene: one for each pair of sides.
class SceneMaterials {
  public:
    SceneMaterials(const Specification& spec, std::span<const std::size_t> bands)
        : spec_(spec), bands_(bands) {}

    /// The material of a pair of sides; the first call adds it to the builder.
    const std::string& name_of(const SideMaterials& sides, SceneBuilder& builder) {
        const auto [entry, is_new] = names_.try_emplace(sides);
        if (is_new) {
            entry->second = fmt::format("{}/{}", sides.upper, sides.lower);
            builder.add_material({entry->second, optics_of(sides.upper), optics_of(sides.lower)});
        }
        return entry->second;
    }
    /// The material of sensors, which light passes unchanged.
    const std::string& sensor(SceneBuilder& builder) {
        if (!has_sensor_) {
            has_sensor_ = true;
            SideOptics open;
            open.transmittance = 1;
            open.transmission_model = "mirror";
            const std::vector<SideOptics> all(bands_.size(), open);
            builder.add_material({kSensorName, all, all});
        }
        return kSensorName;
    }

  private:
    [[nodiscard]] std::vector<SideOptics> optics_of(std::size_t material) const {
        std::vector<SideOptics> optics;
        optics.reserve(bands_.size());
        for (const std::size_t band : bands_) {
            optics.push_back(spec_.materials[material][band]);
        }
        return optics;
    }

    const Specification& spec_;
    std::span<const std::size_t> bands_;
    std::map<SideMaterials, std::string> names_;
    bool has_sensor_ = false;
};

}  // namespace

Scene build_plant_scene(
    const Specification& spec,
    std::span<const std::size_t> bands,
    const Pass& pass,
    std::span<const PlacedShape> shapes) {
    std::vector<Band> names;
    names.reserve(bands.size());
    for (const std::size_t band : bands) {
        names.push_back(spec.bands[band]);
    }
    SceneBuilder builder(std::move(names), plant_orientation());
    builder.set_length_unit("");  // the plant's lengths have no unit
    SceneMaterials materials(spec, bands);
    for (const PlacedShape& placed : shapes) {
        OrganSpec organ;
        organ.id = static_cast<std::int64_t>(placed.query) + 1;
        organ.name = pass.queries[placed.query].organ;
        if (placed.is_sensor) {
            organ.field_of_view_deg = *spec.sensor_half_angle_deg;
        } else {
            // Organs are not measured if there are sensors, or if they only shade.
            organ.measured =
                !spec.sensor_half_angle_deg && (spec.is_answered(pass.queries[placed.query].asks) ||
                                                spec.picture_file.has_value());
        }
        organ.parts.push_back(
            {placed.is_sensor ? materials.sensor(builder)
                              : materials.name_of(placed.shape.materials, builder),
             placed.shape.triangles});
        builder.add_organ(std::move(organ));
    }
    if (spec.ground) {
        const SideMaterials sides{spec.ground->material, spec.ground->material};
        GroundSpec ground;
        ground.material = materials.name_of(sides, builder);
        ground.height = spec.ground->height;
        builder.set_ground(std::move(ground));
    }
    if (spec.cell) {
        // Inward, the plant's z is x and its x is y.
        const CellDirective& c = *spec.cell;
        builder.set_cell({true, true, c.low_z, c.low_x, c.size_z, c.size_x});
    }
    return std::move(builder).build();
}

}  // namespace quasimc
