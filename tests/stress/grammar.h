#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stress/nodes.h"
#include "stress/random.h"

// The grammar of random run files. A scene is a function of its number alone.

namespace quasimc::stress {

/// A point on an organ, to put other objects next to it.
struct Anchor {
    Vec3 position, normal;
};

/// A document under construction. Lengths are sampled in a unit cube, then scaled and moved.
struct Draft {
    Random random;
    Node document = empty_table();
    std::size_t bands = 1;
    double scale = 1;
    Vec3 origin = {};
    std::vector<std::string> materials = {}, sensors = {};
    std::vector<Anchor> anchors = {};  ///< in the unit cube
    bool is_periodic = false;

    [[nodiscard]] Vec3 placed(const Vec3& p) const { return origin + scale * p; }
    [[nodiscard]] std::vector<double> spectrum(double low, double high);
};

/// Scenes from this number on have light through narrow gaps: slits, slats, chinks, leaf bases.
inline constexpr std::uint64_t kFirstOfGaps = 1'000'000'000'000;

/// The run file with a number.
[[nodiscard]] Node random_run(std::uint64_t number);

/// A scene of narrow gaps. @param draft  with bands, options and scale
[[nodiscard]] Node random_gap_run(Draft draft);

// Its parts.
void add_materials(Draft& draft);
void add_organs(Draft& draft);
void add_sources(Draft& draft);
/// A sun, a sky or both.
void add_daylight(Draft& draft);

}  // namespace quasimc::stress
