#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// The most light that an organ, or several, can get: flux per band, infinite where it is not
/// known. See docs/theory/statistics.md.
struct OrganLimits {
    /// Nothing. @param emitted  flux into the scene, per band
    explicit OrganLimits(std::vector<double> all_emitted)
        : direct_upper(all_emitted.size()),
          direct_lower(all_emitted.size()),
          scattered(all_emitted.size()),
          emitted(std::move(all_emitted)) {}

    std::vector<double> direct_upper, direct_lower;  ///< if nothing stood in its way
    std::vector<double> scattered;                   ///< on both sides together
    std::vector<double> emitted;                     ///< into the scene
    double sunlit_area = 0;

    /// Of a quantity: flux.
    [[nodiscard]] double of(Quantity quantity, std::size_t band) const;
    /// Of both together.
    OrganLimits& operator+=(const OrganLimits& other);
};

/// What the sources of a scene can bring to its organs, at most.
class PhysicalBounds {
  public:
    /// What `scene` and `spec` hold must outlive this.
    /// @param emitted  flux into the scene, per band; empty: not known
    PhysicalBounds(const Scene& scene, const EvaluationSpec& spec, std::span<const double> emitted);

    /// Of no organ yet.
    [[nodiscard]] OrganLimits none() const { return OrganLimits(emitted_); }
    /// Those of an organ, written over `limits`, which were made by `none`.
    void find(const Organ& organ, OrganLimits& limits) const;

  private:
    // Of more sources only how bright they are is looked at, not from where they shine.
    static constexpr std::size_t kMaxDirectLights = 16;
    struct UnoccludedSides {
        std::array<double, kMaxDirectLights> upper{}, lower{};  // per source looked at, times area
        double sunlit_area = 0;
    };

    [[nodiscard]] UnoccludedSides unoccluded_sides(const Organ& organ) const;

    const Scene& scene_;
    std::vector<const Source*> looked_at_;  // each by itself, triangle after triangle
    std::vector<double> facing_;            // per band: irradiance of the others, whatever faces
    std::vector<double> lamps_;             // per band: flux
    std::vector<double> emitted_, scattered_;
    bool is_known_;
    bool knows_suns_;  ///< whether each sun is among those looked at
};

}  // namespace quasimc
