#include "sums/light_blocks.h"

namespace quasimc {
namespace {

using Rows = SumBlock::Rows;
using Of = SumColumn::Of;

constexpr std::array kSideNames{"_upper", "_lower"};
/// Names of detectors are chosen by users, and may be those of other blocks.
const std::string kDetector = "detector ";

}  // namespace

SideBlocks::SideBlocks(const SumLayout& layout, std::string_view name) {
    for (std::size_t side = 0; side < first_.size(); ++side) {
        const BlockBins block = layout.find(std::string(name) + kSideNames[side]);
        first_[side] = block.first;
        stride_ = block.stride;
        columns_ = block.columns;
    }
}

void declare_sides(
    const std::string& name, const SumColumns& columns, SumBlocks& blocks, std::uint32_t origins) {
    for (const char* side : kSideNames) {
        blocks.push_back({name + side, Rows::regions, columns, origins});
    }
}

ScatteredBlocks::ScatteredBlocks(const SumLayout& layout)
    : on_surfaces(layout, "scattered"),
      escaped(layout.find("escaped_scattered")),
      scattered_out(layout.find("scattered_out")),
      cut_off(layout.find("cut_off")) {}

SumBlocks light_blocks(
    std::size_t spectra,
    std::size_t bands,
    bool sums_absorbed,
    std::uint32_t origins,
    bool sun_shade) {
    const SumColumns by_spectrum = columns_of(Of::spectrum, spectra);
    const SumColumns by_band = columns_of(Of::band, bands);
    SumBlocks blocks;
    declare_sides("direct", by_spectrum, blocks);
    declare_sides("scattered", by_band, blocks, origins);
    blocks.push_back({"sunlit", Rows::regions, {{Of::area}}});
    if (sun_shade) {
        blocks.push_back({"sunlit_upper", Rows::regions, {{Of::area}}});
    }
    if (sums_absorbed) {
        blocks.push_back({"absorbed_direct", Rows::regions, by_band, origins});
        blocks.push_back({"absorbed_scattered", Rows::regions, by_band, origins});
    }
    if (sums_absorbed && sun_shade) {
        blocks.push_back({"absorbed_beam", Rows::regions, by_band});
    }
    blocks.push_back({"emitted", Rows::run, by_spectrum});
    blocks.push_back({"escaped_direct", Rows::run, by_spectrum});
    for (const char* name : {"escaped_scattered", "scattered_out", "cut_off"}) {
        blocks.push_back({name, Rows::run, by_band, origins});
    }
    blocks.push_back({std::string(kWork), Rows::run, columns_of(Of::number, kWorkUnits)});
    return blocks;
}

SumBlock detector_block(
    const std::string& name, std::size_t axis_bins, std::size_t bands, std::uint32_t origins) {
    SumBlock block{kDetector + name, Rows::run, {}, origins};
    for (std::size_t bin = 0; bin < axis_bins; ++bin) {
        for (std::uint32_t b = 0; b < bands; ++b) {
            block.columns.push_back({Of::band, b});
        }
    }
    return block;
}

LightBlocks::LightBlocks(const SumLayout& layout)
    : stride_(layout.stride()),
      direct_(layout, "direct"),
      scattered_(layout),
      sunlit_(layout.find("sunlit")),
      sunlit_upper_(layout.find("sunlit_upper")),
      absorbed_direct_(layout.find("absorbed_direct")),
      absorbed_scattered_(layout.find("absorbed_scattered")),
      absorbed_beam_(layout.find("absorbed_beam")),
      emitted_(layout.find("emitted")),
      escaped_direct_(layout.find("escaped_direct")),
      work_(layout.find(kWork)),
      scattered_count_(layout.find(kScatteredCount)) {
    for (const SumBlock& block : layout.blocks()) {
        if (block.name.starts_with(kDetector)) {
            detectors_.push_back(layout.find(block.name));
        }
    }
}

}  // namespace quasimc
