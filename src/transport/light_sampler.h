#pragma once

#include <cstdint>
#include <vector>

#include "base/distribution.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Which light each point of a set picks, in proportion to flux, or nearly so.
///
/// Where lights are few, their shares are whole numbers of points, at least one: by flux, to the
/// nearest end. Else replicates would have one point more or less of a light, most of them the same
/// number, and could not tell how often.
class LightSampler {
  public:
    /// @param points  of a set that is spread evenly; best a power of two
    LightSampler(const PreparedScene& prepared, std::uint64_t points);

    [[nodiscard]] LightPick pick(double u) const {
        if (ends_.empty()) {
            return prepared_.lights().pick(u);
        }
        const IntervalPick share = pick_interval(ends_, u);
        return {share.index, share.part, share.width};
    }
    /// What a point that picks a light counts, so that the mean is by flux.
    [[nodiscard]] double weight(std::size_t light) const {
        return ends_.empty() ? 1
                             : prepared_.lights()[light].probability / interval_width(ends_, light);
    }

  private:
    const PreparedScene& prepared_;
    std::vector<double> ends_;  // where a light's share of [0, 1) ends; empty: by flux
};

}  // namespace quasimc
