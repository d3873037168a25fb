#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace quasimc {

/// The quantity in a column of a block: light of a spectrum or of a band, contributions of a
/// sampling strategy, a sunlit area, or a number.
struct SumColumn {
    enum class Of : std::uint8_t { spectrum, band, strategy, area, number };
    Of of = Of::number;
    std::uint32_t index = 0;  ///< spectrum, band or strategy

    friend bool operator==(const SumColumn&, const SumColumn&) = default;
};
using SumColumns = std::vector<SumColumn>;

/// Makes a column for each of `count` spectra, bands or strategies.
[[nodiscard]] SumColumns columns_of(SumColumn::Of of, std::size_t count);

/// A block is a named table of bins that a solver or a detector declares: with a row for each
/// region (a part of an organ that is of one material), or with a single one for the run.
struct SumBlock {
    enum class Rows : std::uint8_t { regions, run };
    std::string name;
    Rows rows = Rows::regions;
    SumColumns columns;
    std::uint32_t origins =
        1;  ///< number of origins of light, for each of which the columns are repeated

    [[nodiscard]] std::size_t width() const { return columns.size() * origins; }
    friend bool operator==(const SumBlock&, const SumBlock&) = default;
};
using SumBlocks = std::vector<SumBlock>;

/// The location of a block's bins. A block that was not declared has no columns.
struct BlockBins {
    std::size_t first = 0;
    std::size_t stride = 0;   ///< bins from one region to the next; 0 for a block of the run
    std::size_t columns = 0;  ///< for each origin

    [[nodiscard]] bool exists() const { return columns > 0; }
    [[nodiscard]] std::size_t bin(std::size_t region, std::size_t column = 0) const {
        return first + region * stride + column;
    }
    /// The first bin of light from an origin.
    [[nodiscard]] std::size_t of_origin(std::size_t origin, std::size_t region = 0) const {
        return bin(region, origin * columns);
    }
};

/// A layout numbers the bins of all blocks of a run. For each region the bins of all blocks are
/// next to each other, in the order of their declaration, because a hit adds to several; those of
/// the run follow all regions.
class SumLayout {
  public:
    SumLayout() = default;
    /// @param blocks  of different names
    SumLayout(std::size_t regions, SumBlocks blocks);

    [[nodiscard]] const SumBlocks& blocks() const { return blocks_; }
    /// The handle of a block by its name: a slow search, not for each hit.
    [[nodiscard]] BlockBins find(std::string_view name) const;

    [[nodiscard]] std::size_t regions() const { return regions_; }
    /// Bins of a region.
    [[nodiscard]] std::size_t stride() const { return stride_; }
    [[nodiscard]] std::size_t bins() const { return bins_; }

    friend bool operator==(const SumLayout&, const SumLayout&) = default;

  private:
    std::size_t regions_ = 0, stride_ = 0, bins_ = 0;
    SumBlocks blocks_;
};

}  // namespace quasimc
