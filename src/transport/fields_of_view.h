#pragma once

#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace quasimc {

/// The fields of view of the regions of a scene: narrow ones of sensors, all directions of others.
class FieldsOfView {
  public:
    explicit FieldsOfView(const Scene& scene);

    /// Whether the field of view of a region contains light at this cosine from its normal.
    [[nodiscard]] bool contain(std::uint32_t region, double cosine) const {
        return least_cosine_.empty() || cosine >= least_cosine_[region];
    }
    /// Cosine of the largest angle at which a region counts light; 0 if it counts all.
    [[nodiscard]] double least_cosine(std::uint32_t region) const {
        return least_cosine_.empty() ? 0 : least_cosine_[region];
    }
    [[nodiscard]] bool any_narrow() const { return !least_cosine_.empty(); }

  private:
    std::vector<double> least_cosine_;  // by region; empty if no sensor is narrow
};

}  // namespace quasimc
