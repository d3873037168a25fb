#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "light/models/source.h"
#include "light/source_origins.h"
#include "raster/scene_projection.h"

namespace quasimc {

/// A source bound to the scene. Weights are relative: in each band the flux of all sources is 1. A
/// path that picks a source with `probability` carries start_weights[b] in band b, on average 1.
struct BoundSource {
    const Source* source = nullptr;
    std::unique_ptr<SourceSampler> source_sampler;
    double probability = 0;             ///< probability of being picked, over all lights
    double before = 0;                  ///< sum of the probabilities of the previous lights
    std::vector<double> start_weights;  ///< per band
    std::size_t origin = 0;             ///< index in BoundLights::origins()
    /// Suns of one origin with equal start weights share one, so do skies, lamps.
    std::size_t spectrum = 0;
    double sun_share = 0;  ///< fraction of the irradiance of all directional lights; 0 for others
    double lit_area = 0;   ///< area across its direction that a path represents, times sun_share;
                           ///< unit sun_area / paths
    double usual_irradiance =
        1;  ///< for a spectrum of 1; lamps: flux over a face of the scene's box

    /// Whether paths that leave the scene may hit it: only skies.
    [[nodiscard]] bool is_extended() const { return !source->is_sun() && !source->is_lamp(); }
};

/// A light picked by a random number.
struct LightPick {
    std::size_t index = 0;
    double u = 0;            ///< the number, rescaled to [0, 1) for another use
    double probability = 1;  ///< probability of the light
};

/// The lights with flux into a scene, in the order of their sources. Const after construction.
class BoundLights {
  public:
    /// @param origins  as RunSpec::origins
    /// @throws StopRequested  if a stop is requested before they are ready
    BoundLights(
        const Sources& sources,
        const SceneProjection& projection,
        std::size_t bands,
        std::span<const std::string> origins = {},
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
    /// The names of the origins whose light is kept apart; none: it is not.
    [[nodiscard]] const std::vector<std::string>& origins() const { return origins_; }
    /// Number of parts that light is kept in: 1 without origins.
    [[nodiscard]] std::size_t origin_count() const {
        return origins_.empty() ? 1 : origins_.size();
    }
    /// Sum of the cross-sections of all suns, square scene units.
    [[nodiscard]] double sun_area() const { return sun_area_; }

  private:
    void bind(
        const Sources& sources,
        SourceOrigins origins,
        const SceneProjection& projection,
        const std::stop_token& stop);
    void set_sun(BoundSource& light, double all_suns, double world_area) const;
    void set_spectrum(BoundSource& light);

    std::vector<BoundSource> lights_;
    std::vector<std::vector<double>> spectra_;
    std::vector<double> flux_;
    std::vector<std::string> origins_;
    double sun_area_ = 0;
};

}  // namespace quasimc
