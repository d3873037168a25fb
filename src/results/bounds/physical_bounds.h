#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "results/quantities.h"
#include "scene/scene.h"

namespace quasimc {

/// Upper limits of the light of one or several organs: flux per band, infinite where unknown. See
/// docs/theory/statistics.md.
struct OrganLimits {
    /// Limits of 0. @param emitted  flux into the scene, per band
    explicit OrganLimits(std::vector<double> all_emitted)
        : direct_upper(all_emitted.size()),
          direct_lower(all_emitted.size()),
          scattered(all_emitted.size()),
          emitted(std::move(all_emitted)) {}

    std::vector<double> direct_upper, direct_lower;  ///< unoccluded
    std::vector<double> scattered;                   ///< on both sides together
    std::vector<double> emitted;                     ///< into the scene
    double sunlit_area = 0;

    /// Limit of a quantity, as flux: no more than what is emitted is absorbed.
    [[nodiscard]] double of(Quantity quantity, std::size_t band) const;
    /// Limit of the given parts of the light that falls on the organs, as flux.
    [[nodiscard]] double light(const LightParts& parts, std::size_t band) const;
    /// Adds the limits of light times a positive weight.
    void add(const OrganLimits& other, double weight);
    /// Adds the limits of both.
    OrganLimits& operator+=(const OrganLimits& other) {
        add(other, 1);
        return *this;
    }
};

/// Upper limits of the light that the sources of a scene deliver to its organs.
class PhysicalBounds {
  public:
    /// The contents of `scene` and `spec` must outlive this object.
    /// @param emitted  flux into the scene, per band; empty: not known
    PhysicalBounds(const Scene& scene, const EvaluationSpec& spec, std::span<const double> emitted);

    /// Limits of an empty set of organs.
    [[nodiscard]] OrganLimits none() const { return OrganLimits(emitted_); }
    /// Limits of one organ, written over `limits`, which `none` made.
    void find(const Organ& organ, OrganLimits& limits) const;

  private:
    // With more sources, their directions are ignored and only their brightness counts.
    static constexpr std::size_t kMaxDirectLights = 16;
    struct UnoccludedSides {
        std::array<double, kMaxDirectLights> upper{}, lower{};  // per single source, times area
        double sunlit_area = 0;
    };

    [[nodiscard]] UnoccludedSides unoccluded_sides(const Organ& organ) const;

    const Scene& scene_;
    std::vector<const Source*> single_sources_;  // treated individually, triangle by triangle
    std::vector<double> facing_;  // per band: irradiance of the others, at any orientation
    std::vector<double> lamps_;   // per band: flux
    std::vector<double> emitted_, scattered_;
    bool is_known_;
    bool knows_suns_;  ///< whether every sun is treated individually
};

}  // namespace quasimc
