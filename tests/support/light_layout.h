#pragma once

#include <cstddef>
#include <utility>

#include "sums/light_blocks.h"

namespace quasimc {

/// A layout of light_blocks() and others, with the handles of the former.
struct LightLayout : SumLayout, LightBlocks {
    LightLayout(
        std::size_t region_count,
        std::size_t spectra,
        std::size_t bands,
        const SumBlocks& more = {})
        : SumLayout(region_count, with(light_blocks(spectra, bands), more)),
          LightBlocks(static_cast<const SumLayout&>(*this)) {}
    using SumLayout::stride;

  private:
    static SumBlocks with(SumBlocks blocks, const SumBlocks& more) {
        blocks.insert(blocks.end(), more.begin(), more.end());
        return blocks;
    }
};

}  // namespace quasimc
