#pragma once

#include <cstddef>
#include <memory>
#include <stop_token>
#include <vector>

#include "light/models/source.h"
#include "raster/scene_projection.h"

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

/// A light that a number picks.
struct LightPick {
    std::size_t index = 0;
    double u = 0;            ///< what is left of the number
    double probability = 1;  ///< of the light
};

/// The lights that send something into a scene, in the order of their sources. Const after
/// construction.
class BoundLights {
  public:
    /// @throws StopRequested  if a stop is requested before they are ready
    BoundLights(
        const Sources& sources,
        const SceneProjection& projection,
        std::size_t bands,
        const std::stop_token& stop = {});

    [[nodiscard]] auto begin() const { return lights_.begin(); }
    [[nodiscard]] auto end() const { return lights_.end(); }
    [[nodiscard]] std::size_t size() const { return lights_.size(); }
    [[nodiscard]] bool empty() const { return lights_.empty(); }
    [[nodiscard]] const BoundSource& operator[](std::size_t i) const { return lights_[i]; }
    /// The index of one of these lights.
    [[nodiscard]] std::size_t index_of(const BoundSource& light) const {
        return static_cast<std::size_t>(&light - lights_.data());
    }

    /// The light that a number in [0, 1) picks.
    [[nodiscard]] LightPick pick(double u) const;
    /// The distinct start weights, [spectrum][band].
    [[nodiscard]] const std::vector<std::vector<double>>& spectra() const { return spectra_; }
    /// Flux of all lights into the scene, per band, irradiance unit x square scene unit.
    [[nodiscard]] const std::vector<double>& flux() const { return flux_; }
    /// Area of all suns' cross-sections together, square scene units.
    [[nodiscard]] double sun_area() const { return sun_area_; }

  private:
    void bind(
        const Sources& sources, const SceneProjection& projection, const std::stop_token& stop);
    void set_sun(BoundSource& light, double all_suns, double world_area) const;
    void set_spectrum(BoundSource& light);

    std::vector<BoundSource> lights_;
    std::vector<std::vector<double>> spectra_;
    std::vector<double> flux_;
    double sun_area_ = 0;
};

}  // namespace quasimc
