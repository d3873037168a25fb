#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/bounds/organ_reader.h"
#include "scene/scene.h"

namespace quasimc {

/// Estimates the light of the sunlit and the shaded part of organs and groups.
class SunShadeEvaluator {
  public:
    /// The arguments must outlive this object.
    SunShadeEvaluator(const Sums& sums, const Scene& scene, const EvaluationSpec& spec)
        : sums_(sums), reader_(sums), scene_(scene), spec_(spec) {}

    /// @param values  get the estimates, [quantity][band]
    void evaluate(const Organ& organ, std::span<Estimate> values) const;
    /// Organs count by their sunlit or shaded areas.
    void evaluate(const OrganGroup& group, std::span<Estimate> values) const;

  private:
    const Sums& sums_;
    SumReader reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
};

/// The light of parts of all groups.
[[nodiscard]] SunShadeLight evaluate_sun_shade(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<OrganGroup>& groups);

/// The light of parts of organs or groups where no source shines: zeros, and unknown light of
/// sunlit parts.
/// @param rows  their number
[[nodiscard]] SunShadeLight zero_sun_shade(std::size_t rows, std::size_t bands);

}  // namespace quasimc
