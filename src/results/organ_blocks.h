#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/parallel.h"
#include "scene/scene.h"

namespace quasimc {

inline constexpr std::size_t kOrgansPerBlock = 256;

inline std::size_t blocks_of(const Scene& scene) {
    return (scene.organs().size() + kOrgansPerBlock - 1) / kOrgansPerBlock;
}

/// Runs work(first, last) for all organs, some at a time, on all threads.
template <typename Work>
void for_each_block(const Scene& scene, unsigned threads, const Work& work) {
    const std::size_t n = scene.organs().size();
    parallel_blocks(blocks_of(scene), threads, [&](std::uint64_t block, unsigned) {
        const std::size_t first = block * kOrgansPerBlock;
        work(first, std::min(n, first + kOrgansPerBlock));
    });
}

}  // namespace quasimc
