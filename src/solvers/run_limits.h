#pragma once

#include <cstdint>

namespace quasimc {

// The ranges of options of a run, for its check (check_run) and for the table of options.
inline constexpr std::uint64_t kMostPaths = std::uint64_t{1} << 30U;
inline constexpr std::uint32_t kMostReplicates = 10000;
inline constexpr unsigned kMostThreads = 4096;

}  // namespace quasimc
