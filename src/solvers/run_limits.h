#pragma once

#include <cstdint>

namespace quasimc {

// The ranges of options of a run, for its check (check_run) and for the table of options.
inline constexpr std::uint64_t kMaxPaths = std::uint64_t{1} << 30U;
inline constexpr std::uint32_t kMaxReplicates = 10000;
inline constexpr unsigned kMaxThreads = 4096;

}  // namespace quasimc
