#include "series/basis/bin_index.h"

namespace quasimc {
namespace {

SumLayout sum_layout(std::size_t regions, std::size_t bands) {
    return {regions, light_blocks(bands, bands)};
}

BinPart part_of(const SumColumn& column) {
    using Kind = BinPart::Kind;
    switch (column.of) {
        case SumColumn::Of::spectrum:
            return {Kind::direct, column.index};
        case SumColumn::Of::band:
            return {Kind::scattered, column.index};
        case SumColumn::Of::area:
            return {Kind::sunlit, 0};
        default:
            return {};
    }
}

}  // namespace

BasisLayout::BasisLayout(std::size_t region_count, std::size_t band_count)
    : sums(sum_layout(region_count, band_count)),
      light(sums),
      regions(region_count),
      bands(band_count) {}

std::vector<BinPart> bin_parts(const BasisLayout& layout) {
    std::vector<BinPart> parts;
    for (const SumBlock::Rows rows : {SumBlock::Rows::regions, SumBlock::Rows::run}) {
        for (const SumBlock& block : layout.sums.blocks()) {
            for (std::size_t i = 0; block.rows == rows && i < block.columns.size(); ++i) {
                parts.push_back(part_of(block.columns[i]));
            }
        }
    }
    return parts;
}

}  // namespace quasimc
