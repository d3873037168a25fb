#pragma once

#include <cstdint>

#include "samplers/hash.h"

namespace quasimc {

/// A seed for each trace of a series (SplitMix64: Steele, Lea and Flood 2014); the first has the
/// series' own.
inline std::uint64_t trace_seed(std::uint64_t seed, std::uint64_t trace) {
    return trace == 0 ? seed : mix64(seed + trace * 0x9E3779B97F4A7C15U);
}

}  // namespace quasimc
