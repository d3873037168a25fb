#include "sums/sum_layout.h"

#include <utility>

namespace quasimc {

SumColumns columns_of(SumColumn::Of of, std::size_t count) {
    SumColumns columns;
    for (std::uint32_t i = 0; i < count; ++i) {
        columns.push_back({of, i});
    }
    return columns;
}

SumLayout::SumLayout(std::size_t regions, SumBlocks blocks)
    : regions_(regions), blocks_(std::move(blocks)) {
    std::size_t of_run = 0;
    for (const SumBlock& block : blocks_) {
        (block.rows == SumBlock::Rows::regions ? stride_ : of_run) += block.width();
    }
    bins_ = regions_ * stride_ + of_run;
}

BlockBins SumLayout::find(std::string_view name) const {
    std::size_t of_region = 0, of_run = regions_ * stride_;
    for (const SumBlock& block : blocks_) {
        const bool has_regions = block.rows == SumBlock::Rows::regions;
        std::size_t& first = has_regions ? of_region : of_run;
        if (block.name == name) {
            return {first, has_regions ? stride_ : 0, block.columns.size()};
        }
        first += block.width();
    }
    return {};
}

}  // namespace quasimc
