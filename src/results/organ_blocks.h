#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "scene/scene.h"

namespace quasimc {

inline constexpr std::size_t kOrgansPerBlock = 256;

/// The number of blocks of that many organs.
inline std::size_t blocks_for(std::size_t organs) {
    return (organs + kOrgansPerBlock - 1) / kOrgansPerBlock;
}

/// Runs work(first, last) for the organs from `begin` up to `end`, some at a time, on all threads.
template <typename Work>
void for_each_block(std::size_t begin, std::size_t end, unsigned threads, const Work& work) {
    parallel_blocks(blocks_for(end - begin), threads, [&](std::uint64_t block, unsigned) {
        const std::size_t first = begin + block * kOrgansPerBlock;
        work(first, std::min(end, first + kOrgansPerBlock));
    });
}

/// Runs work(first, last) for all organs.
template <typename Work>
void for_each_block(const Scene& scene, unsigned threads, const Work& work) {
    for_each_block(0, scene.organs().size(), threads, work);
}

}  // namespace quasimc
