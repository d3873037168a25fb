#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stress/compare.h"
#include "stress/ways.h"

namespace quasimc::stress {

/// A finding in a scene.
struct Finding {
    enum class Kind {
        refused,     ///< the reader or the run refuses a scene that is valid by the grammar
        impossible,  ///< a number that is impossible for any scene
        identity,    ///< threads, or `auto`, change a number
        difference,  ///< two ways have different means
        interval     ///< 95 % intervals with a much lower coverage
    };
    Kind kind = Kind::difference;
    Way a = Way::light_tracing, b = Way::light_tracing;
    std::string words;
};
[[nodiscard]] std::string name_of(Finding::Kind kind);

/// Rules to judge scenes. The cheap screening selects differences for a second test, with new
/// random numbers and more paths; remaining ones get a third test with new random numbers, which
/// alone decides, at `family_level` over all comparisons of `scenes` scenes.
struct Rules {
    Effort screen{256, 16, 1, 1};
    double screen_level =
        .01;  ///< probability of a second test for a correct scene, over all comparisons
    Effort second{kClosePaths, 16, 1, 1};
    double second_level = 1e-3;  ///< level of each comparison
    Effort last{kClosePaths, 16, 1, 1};
    unsigned last_seeds = 24;
    double family_level = 1e-3;
    double scenes = 1e5;
    /// Fraction of the intervals that may miss: those of low counts have a coverage of 0.86.
    double misses = .15;
};

/// Rules for scenes of narrow gaps, whose light inside few paths carry: more paths, and more scenes
/// with a second test.
[[nodiscard]] Rules gap_rules();

struct Verdict {
    std::vector<Finding> findings;
    std::size_t comparisons = 0;  ///< comparisons of the screening
    bool retested = false, closely_tested = false;
    /// Whether differences are due to rounding: has_near_surfaces().
    bool is_rounding = false;
};

/// Judges a run file. Its scene number only seeds the randomizations.
/// @param with_identity  whether threads and `auto` are compared as well, bit by bit
[[nodiscard]] Verdict judge(
    const Node& document, std::uint64_t number, const Rules& rules, bool with_identity);

/// The last test alone: compares all numbers of two ways of a case at a level.
[[nodiscard]] std::vector<Finding> compare_closely(
    const Case& it,
    const std::vector<Disagreement>& suspects,
    std::uint64_t number,
    const Rules& rules,
    double level);

}  // namespace quasimc::stress
