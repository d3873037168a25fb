#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "stress/compare.h"
#include "stress/ways.h"

namespace quasimc::stress {

/// What was found in a scene.
struct Finding {
    enum class Kind {
        refused,     ///< the reader or the run refuses what the grammar means to be right
        impossible,  ///< a number that can't be, whatever the scene
        identity,    ///< threads, or `auto`, change a number
        difference,  ///< two ways have different means
        interval     ///< 95 % intervals that hold the truth far less often
    };
    Kind kind = Kind::difference;
    Way a = Way::light_tracing, b = Way::light_tracing;
    std::string words;
};
[[nodiscard]] std::string name_of(Finding::Kind kind);

/// How scenes are judged. Screening is cheap, and decides nothing but where to look again. What
/// differs in it is computed a second time, with new numbers and more paths; what differs there too
/// a third, with new numbers once more, and that sample alone decides: at `family_level` over all
/// comparisons of `scenes` scenes.
struct Rules {
    Effort screen{256, 16, 1, 1};
    double screen_chance = .01;  ///< that a right scene is looked at again; over all comparisons
    Effort second{kClosePaths, 16, 1, 1};
    double second_level = 1e-3;  ///< of each comparison
    Effort last{kClosePaths, 16, 1, 1};
    unsigned last_seeds = 24;
    double family_level = 1e-3;
    double scenes = 1e5;
    /// Share of the intervals that may miss: those of a few finds are known to hold 86 %.
    double misses = .15;
};

struct Verdict {
    std::vector<Finding> findings;
    std::size_t comparisons = 0;  ///< of the screening
    bool looked_again = false, looked_closely = false;
    /// What differs is left to rounding: has_near_surfaces().
    bool is_rounding = false;
};

/// Judges a run file. Its scene number only seeds the randomizations.
/// @param with_identity  whether threads and `auto` are compared as well, bit by bit
[[nodiscard]] Verdict judge(
    const Node& document, std::uint64_t number, const Rules& rules, bool with_identity);

/// The last look alone: two ways of a case, all numbers, at that level for each.
[[nodiscard]] std::vector<Finding> compare_closely(
    const Case& it,
    const std::vector<Disagreement>& suspects,
    std::uint64_t number,
    const Rules& rules,
    double level);

}  // namespace quasimc::stress
