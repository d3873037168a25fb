#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// The most light that an organ, or several, can get: flux per band, infinite where it is not
/// known. See docs/theory/statistics.md.
struct OrganLimits {
    explicit OrganLimits(std::size_t bands)
        : direct_upper(bands), direct_lower(bands), scattered(bands), absorbed(bands) {}

    std::vector<double> direct_upper, direct_lower;  ///< if nothing stood in its way
    std::vector<double> scattered;                   ///< on both sides together
    std::vector<double> absorbed;                    ///< all that is emitted
    double sunlit_area = 0;

    /// Of a quantity: flux.
    [[nodiscard]] double of(Quantity quantity, std::size_t band) const;
    /// Of both together.
    OrganLimits& operator+=(const OrganLimits& other);
};

/// What the sources of a scene can bring to its organs, at most.
class LightLimits {
  public:
    /// What `scene` and `spec` hold must outlive this.
    /// @param emitted  flux into the scene, per band; empty: not known
    LightLimits(const Scene& scene, const EvaluationSpec& spec, std::span<const double> emitted);

    [[nodiscard]] OrganLimits of(const Organ& organ) const;

  private:
    const Scene& scene_;
    std::vector<const Source*> looked_at_;  // each by itself, triangle after triangle
    std::vector<double> facing_;            // per band: irradiance of the others, whatever faces
    std::vector<double> lamps_;             // per band: flux
    std::vector<double> emitted_, scattered_;
    bool is_known_;
    bool knows_suns_;  ///< whether each sun is among those looked at
};

}  // namespace quasimc
