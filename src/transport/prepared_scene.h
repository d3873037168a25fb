#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "detectors/detector.h"
#include "geometry/cast/ray_caster.h"
#include "raster/scene_projection.h"
#include "scene/scene.h"
#include "transport/bound_lights.h"
#include "transport/fields_of_view.h"
#include "transport/rounding_correction.h"

namespace quasimc {

/// Region and material of a triangle of the mesh.
struct PrimitiveInfo {
    std::uint32_t region = 0;
    std::uint32_t material = 0;
};

/// Properties of all materials in use, by which faster or simpler methods are chosen.
struct OpticsTraits {
    double largest_peak = 0;           ///< largest peak_brightness() of a lobe, without sensors
    bool has_constant_albedos = true;  ///< no albedo depends on the angle of the light
    bool has_transparent = false;      ///< some material is a sensor that light passes
};

/// A scene with its lights, ready to trace, shared by all solvers and threads. Const after
/// construction.
class PreparedScene {
  public:
    /// @param caster  of the scene's triangles and cell
    /// @param origins  as RunSpec::origins
    /// @throws StopRequested  if a stop is requested before it is ready
    PreparedScene(
        const Scene& scene,
        const Sources& sources,
        StartArea start_area,
        std::shared_ptr<const RayCaster> caster,
        const std::stop_token& stop = {},
        std::span<const std::string> origins = {});
    ~PreparedScene() = default;
    PreparedScene(const PreparedScene&) = delete;
    PreparedScene& operator=(const PreparedScene&) = delete;

    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const RayCaster& caster() const { return *caster_; }
    [[nodiscard]] std::size_t bands() const { return scene_->bands().size(); }
    /// Where light from far away enters.
    [[nodiscard]] const SceneProjection& projection() const { return projection_; }
    [[nodiscard]] const BoundLights& lights() const { return lights_; }
    [[nodiscard]] const FieldsOfView& fields_of_view() const { return fields_of_view_; }
    [[nodiscard]] const RoundingCorrection& rounding() const { return rounding_; }
    [[nodiscard]] const OpticsTraits& optics() const { return optics_; }

    /// Region and material of a triangle of the caster's mesh.
    [[nodiscard]] PrimitiveInfo primitive(std::uint32_t mesh_triangle) const {
        const std::uint32_t e = region(mesh_triangle);
        return {e, region_materials_[e].value};
    }
    [[nodiscard]] std::uint32_t region(std::uint32_t mesh_triangle) const {
        if (mesh_triangle < triangle_regions_.size()) [[likely]] {
            return triangle_regions_[mesh_triangle].value;
        }
        return data_of(*scene_).region_of(caster_->source(mesh_triangle)).value;
    }
    [[nodiscard]] const Material& material(std::uint32_t region) const {
        return materials_[region_materials_[region].value];
    }
    /// Implementations of Scene::detectors(), in their order.
    [[nodiscard]] const std::vector<std::unique_ptr<const Detector>>& detectors() const {
        return detectors_;
    }

  private:
    void set_regions();

    const Scene* scene_;
    std::shared_ptr<const RayCaster> caster_;
    SceneProjection projection_;
    // Regions of the triangles that belong to no instance: the scene's own list, unless the caster
    // has periodic images of them.
    std::span<const RegionIndex> triangle_regions_;
    std::vector<RegionIndex> image_regions_;
    const Material* materials_ = nullptr;  // those of the scene
    std::vector<MaterialId> region_materials_;
    std::vector<std::unique_ptr<const Detector>> detectors_;
    BoundLights lights_;
    FieldsOfView fields_of_view_;
    RoundingCorrection rounding_;
    OpticsTraits optics_;
};

}  // namespace quasimc
