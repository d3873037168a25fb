#pragma once

#include <cstdint>
#include <vector>

#include "base/distribution.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Picks a light for each point of a set, with a probability (nearly) proportional to flux.
///
/// If lights are few, each gets a whole number of points, at least one. Otherwise most replicates
/// would have the same number of points of a light, and their spread would underestimate the error.
class LightSampler {
  public:
    /// @param points  size of a well-spread set; best a power of two
    LightSampler(const PreparedScene& prepared, std::uint64_t points);

    [[nodiscard]] LightPick pick(double u) const {
        if (ends_.empty()) {
            return prepared_.lights().pick(u);
        }
        const IntervalPick share = pick_interval(ends_, u);
        return {share.index, share.part, share.width};
    }
    /// Weight of a point that picks a light, so that the mean is proportional to flux.
    [[nodiscard]] double weight(std::size_t light) const {
        return ends_.empty() ? 1
                             : prepared_.lights()[light].probability / interval_width(ends_, light);
    }

  private:
    const PreparedScene& prepared_;
    std::vector<double> ends_;  // upper end of each light's interval of [0, 1); empty: by flux
};

}  // namespace quasimc
