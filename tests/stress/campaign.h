#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include "stress/coverage.h"
#include "stress/judge.h"

namespace quasimc::stress {

/// Many scenes, one after the other.
struct Campaign {
    std::uint64_t first = 1;  ///< number of the first scene
    std::uint64_t scenes = 1000;
    double seconds = 0;                ///< no new scene after that; 0: no limit
    unsigned seconds_per_scene = 300;  ///< a longer computation counts as a hang
    std::filesystem::path out;         ///< folder of findings and the log
    std::uint64_t identity_every = 8;  ///< interval of scenes whose threads and `auto` are compared
    std::uint64_t coverage_every = 0;  ///< interval of scenes whose coverage is counted; 0: none
    unsigned coverage_seeds = 200;
    Effort coverage{1024, 8, 1, 1};
    unsigned shrinking_tries = 80;
    Rules rules;
    Rules gap_rules = stress::gap_rules();  ///< for scenes from kFirstOfGaps on
};

/// Counts of a campaign: plain numbers in memory that two processes share.
struct Tally {
    std::uint64_t scene = 0;  ///< current scene
    std::uint64_t scenes = 0, comparisons = 0;
    std::uint64_t retested = 0, closely_tested = 0;
    std::uint64_t roundings = 0;  ///< scenes with differences due to rounding
    std::uint64_t findings = 0;   ///< scenes with any
    std::uint64_t deaths = 0;     ///< scenes that ended the process, or hung
    std::uint64_t covered_scenes = 0;
    std::uint64_t coverage_counts[12] =
        {};  ///< ways with coverage below 0.88, 0.88 to 0.89, ... above 0.98
};

/// Judges the scenes, each in a process that a crash or a hang may end. Findings are shrunk and
/// written to <out>/<scene>-<kind>.toml, run files with a description in comments; the log is
/// <out>/log.txt.
[[nodiscard]] Tally run_campaign(const Campaign& campaign);

/// Text of a tally.
[[nodiscard]] std::string describe(const Tally& tally);

}  // namespace quasimc::stress
