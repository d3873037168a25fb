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
    unsigned seconds_per_scene = 300;  ///< what takes longer counts as a hang
    std::filesystem::path out;         ///< where findings and the log go
    std::uint64_t identity_every = 8;  ///< scenes of which threads and `auto` are compared
    std::uint64_t coverage_every = 0;  ///< scenes of which intervals are counted; 0: none
    unsigned coverage_seeds = 200;
    Effort coverage{1024, 8, 1, 1};
    unsigned shrinking_tries = 80;
    Rules rules;
};

/// What a campaign has done. Plain numbers: they stand in memory that two processes share.
struct Tally {
    std::uint64_t scene = 0;  ///< that is being judged
    std::uint64_t scenes = 0, comparisons = 0;
    std::uint64_t looked_again = 0, looked_closely = 0;
    std::uint64_t roundings = 0;  ///< scenes with differences that are left to rounding
    std::uint64_t findings = 0;   ///< scenes with any
    std::uint64_t deaths = 0;     ///< scenes that ended the process, or hung
    std::uint64_t covered_scenes = 0;
    std::uint64_t coverage_counts[12] = {};  ///< of ways: below .88, .88 to .89, ... .98 and more
};

/// Judges the scenes, each in a process that a crash or a hang may end. Findings are shrunk and
/// kept as <out>/<scene>-<kind>.toml, which `quasimc run` runs, with what they show in comments;
/// all is told in <out>/log.txt.
[[nodiscard]] Tally run_campaign(const Campaign& campaign);

/// A tally in words.
[[nodiscard]] std::string words_of(const Tally& tally);

}  // namespace quasimc::stress
