#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <stop_token>
#include <vector>

#include "detectors/detector.h"
#include "geometry/cast/ray_caster.h"
#include "light/models/source.h"
#include "raster/scene_projection.h"
#include "scene/scene.h"

namespace quasimc {

/// A source bound to the scene. Weights are relative: in each band the flux of all sources is 1,
/// shared out so that a path that picks a source with `probability` brings start_weights[b] to band
/// b, on average 1.
struct BoundSource {
    const Source* source = nullptr;
    std::unique_ptr<SourceSampler> source_sampler;
    double probability = 0;             ///< of being picked, over all lights
    double before = 0;                  ///< sum of the probabilities of the lights before
    std::vector<double> start_weights;  ///< per band
    std::size_t spectrum = 0;  ///< suns with equal start weights share one, so do skies, lamps
    double sun_share = 0;      ///< share in the irradiance of all directional lights; 0 for others
    double lit_area =
        0;  ///< what a path of it lights facing it, times sun_share, in units of sun_area / paths
    double usual_irradiance = 1;  ///< for a spectrum of 1; of a lamp: spread over the scene's box

    /// Whether paths that leave the scene find it by chance, as they do a sky.
    [[nodiscard]] bool is_extended() const { return !source->is_sun() && !source->is_lamp(); }
};

/// What a triangle of the mesh belongs to.
struct PrimitiveInfo {
    std::uint32_t region = 0;
    std::uint32_t material = 0;
};

/// The cosine up to which light runs along a surface: corners are told apart in single precision.
inline constexpr double kEdgeOn = 0x1p-24;

/// A light that a number picks.
struct LightPick {
    std::size_t index = 0;
    double u = 0;            ///< what is left of the number
    double probability = 1;  ///< of the light
};

/// A scene with its lights, ready to trace: what all solvers and threads share. Const after
/// construction.
class PreparedScene {
  public:
    /// @param caster  of the scene's triangles and cell
    /// @throws StopRequested  if a stop is requested before it is ready
    PreparedScene(
        const Scene& scene,
        const Sources& sources,
        CrossSectionShape window,
        std::shared_ptr<const RayCaster> caster,
        const std::stop_token& stop = {});
    ~PreparedScene() = default;
    PreparedScene(const PreparedScene&) = delete;
    PreparedScene& operator=(const PreparedScene&) = delete;

    [[nodiscard]] const Scene& scene() const { return *scene_; }
    [[nodiscard]] const RayCaster& caster() const { return *caster_; }
    [[nodiscard]] std::size_t bands() const { return scene_->bands().size(); }
    /// Where light from far away enters.
    [[nodiscard]] const SceneProjection& projection() const { return projection_; }
    /// Square scene units per square local unit.
    [[nodiscard]] double world_area() const { return projection_.world_area(); }

    /// Lights that send something into the scene, in the order of the sources.
    [[nodiscard]] const std::vector<BoundSource>& lights() const { return lights_; }
    /// The light that a number in [0, 1) picks.
    [[nodiscard]] LightPick pick_light(double u) const;
    /// The distinct start weights, [spectrum][band].
    [[nodiscard]] const std::vector<std::vector<double>>& spectra() const { return spectra_; }
    /// Flux of all sources into the scene, per band, irradiance unit x square scene unit.
    [[nodiscard]] const std::vector<double>& flux() const { return flux_; }

    /// Area of all suns' cross-sections together, square scene units.
    [[nodiscard]] double sun_area() const { return sun_area_; }

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
    /// Whether a region counts light that comes at this cosine from its normal: all but sensors
    /// with a narrow field of view do.
    [[nodiscard]] bool in_field_of_view(std::uint32_t region, double cosine) const {
        return !has_narrow_ || cosine >= least_cosine_[region];
    }
    /// Cosine of the largest angle at which a region counts light; 0 if it counts all.
    [[nodiscard]] double least_cosine(std::uint32_t region) const {
        return has_narrow_ ? least_cosine_[region] : 0;
    }
    [[nodiscard]] bool has_narrow() const { return has_narrow_; }
    /// How much of the area of a triangle that is_sunlit() is lit over what is of its rounded
    /// corners, which may be turned as well: what is lit of these is seen along their own cosine.
    [[nodiscard]] double sunlit_share(std::uint32_t mesh_triangle) const {
        return caster_->mesh().exact_area_share(mesh_triangle);
    }
    /// How much light along `direction` falls on a triangle of the mesh, over what falls on its
    /// rounded corners: not 1 of thin triangles (LocalMesh::exact_share), nor of those that
    /// rounding turns where light grazes them. @param cosine  dot(unit normal, direction) as traced
    [[nodiscard]] double exact_share(
        std::uint32_t mesh_triangle, const Vec3& direction, double cosine) const {
        const double share = caster_->mesh().exact_share(mesh_triangle, direction);
        return share != 1 || std::abs(cosine) > grazing_ ? share
                                                         : grazed_share(mesh_triangle, direction);
    }
    /// Whether light of a sun along `direction` (of either sign) makes a triangle of the mesh count
    /// as sunlit: not where it runs along the surface as given, to rounding (kEdgeOn).
    /// @param cosine  dot(unit normal, direction) as traced
    [[nodiscard]] bool is_sunlit(
        std::uint32_t mesh_triangle, const Vec3& direction, double cosine) const {
        // Rounding of the corners hardly turns a surface by more.
        constexpr double kSteep = 1e-3;
        return std::abs(cosine) > kSteep || lights_as_given(mesh_triangle, direction);
    }
    /// Regions of the ground, which stand last.
    [[nodiscard]] std::size_t ground_regions() const { return ground_regions_; }
    /// Of Scene::detectors(), in their order.
    [[nodiscard]] const std::vector<std::unique_ptr<const Detector>>& detectors() const {
        return detectors_;
    }
    /// peak_brightness() of the sharpest lobe of a material in use, sensors left out.
    [[nodiscard]] double sharpest_peak() const { return sharpest_peak_; }
    /// Whether no albedo depends on the angle of the light.
    [[nodiscard]] bool has_constant_albedos() const { return has_constant_albedos_; }
    /// Whether some material is a sensor that light passes.
    [[nodiscard]] bool has_transparent() const { return has_transparent_; }

  private:
    [[nodiscard]] double grazed_share(std::uint32_t mesh_triangle, const Vec3& direction) const;
    [[nodiscard]] bool lights_as_given(std::uint32_t mesh_triangle, const Vec3& direction) const;
    void set_regions();
    void set_fields_of_view();
    void set_lights(const Sources& sources, const std::stop_token& stop);
    void set_spectrum(BoundSource& light);

    const Scene* scene_;
    std::shared_ptr<const RayCaster> caster_;
    SceneProjection projection_;
    // Of the triangles that belong to no instance: the scene's own list, unless the caster counts
    // images of them.
    std::span<const RegionIndex> triangle_regions_;
    std::vector<RegionIndex> image_regions_;
    const Material* materials_ = nullptr;  // those of the scene
    std::vector<MaterialId> region_materials_;
    std::vector<std::unique_ptr<const Detector>> detectors_;
    std::vector<BoundSource> lights_;
    std::vector<std::vector<double>> spectra_;
    std::vector<double> flux_;
    double sun_area_ = 0;
    std::size_t ground_regions_ = 0;
    std::vector<double> least_cosine_;  // by region; empty if no sensor is narrow
    double sharpest_peak_ = 0;
    double grazing_;  ///< cosine beyond which rounding changes no light by what would be mended
    bool has_transparent_ = false, has_narrow_ = false;
    bool has_constant_albedos_ = true;
};

}  // namespace quasimc
