#pragma once

#include <cstdint>
#include <vector>

#include "base/vec3.h"

namespace quasimc {

/// Suns with too little light for scan lines of their own. Each replicate picks some of them, which
/// represent the light of all: systematic sampling in proportion to light (Cochran 1977, chapter
/// 8).
class ManySuns {
  public:
    struct Sun {
        std::uint32_t light = 0;  ///< its index
        double probability = 0;   ///< over all lights, above 0
        double paths = 0;         ///< that take as long as its lines
        Vec3 direction;           ///< unit
    };
    /// A sun that represents light of others as well.
    struct Pick {
        std::uint32_t light = 0;
        double probability = 0;  ///< probability of all light that it represents
    };

    ManySuns() = default;
    /// Suns that follow each other are represented by the same ones: they are taken in the order in
    /// which directions change less, the given one (a day) or along a curve (all days of a year).
    explicit ManySuns(std::vector<Sun> suns);

    [[nodiscard]] bool empty() const { return suns_.empty(); }
    [[nodiscard]] const std::vector<Sun>& suns() const { return suns_; }
    /// The number of suns whose lines take as long as the paths of all; at most that of the suns.
    /// @param paths  of all lights
    [[nodiscard]] std::uint32_t affordable(double paths) const;
    /// The light that each of `count` picks represents.
    [[nodiscard]] double light_of_each(std::uint32_t count) const { return probability_ / count; }
    /// The suns that are picked, in their order; a sun of more light than each pick may represent
    /// that of several. If all are picked, each represents itself.
    /// @param u  uniform in [0, 1): then the expected light of each sun is its own
    [[nodiscard]] std::vector<Pick> pick(std::uint32_t count, double u) const;

  private:
    std::vector<Sun> suns_;
    double probability_ = 0;
    double paths_of_each_ = 1;  // mean over the light
};

}  // namespace quasimc
