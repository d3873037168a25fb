#pragma once

#include <cstddef>
#include <vector>

#include "sums/light_blocks.h"

namespace quasimc {

/// The bins of light that is combined from several runs: one spectrum for each band, so that
/// amounts of all of them can be added.
struct BasisLayout {
    BasisLayout(std::size_t regions, std::size_t bands);

    SumLayout sums;
    LightBlocks light;
    std::size_t regions, bands;

    [[nodiscard]] std::size_t bins() const { return sums.bins(); }
};

/// The meaning of a bin of a basis.
struct BinPart {
    enum class Kind { direct, scattered, sunlit, none };
    Kind kind = Kind::none;
    std::size_t band = 0;

    [[nodiscard]] bool is_light() const { return kind == Kind::direct || kind == Kind::scattered; }
    /// Index of the amount that a bin of light is multiplied by: direct light by band, then
    /// scattered light by band.
    [[nodiscard]] std::size_t amount(std::size_t bands) const {
        return (kind == Kind::scattered ? bands : 0) + band;
    }
};
/// The bins of a region, then those of the run.
[[nodiscard]] std::vector<BinPart> bin_parts(const BasisLayout& layout);

/// The index of a bin in a response: part by part, the first bin of all regions, the second of all
/// regions, ..., then the bins of the run.
class BinIndex {
  public:
    explicit BinIndex(const BasisLayout& layout)
        : regions_(layout.regions), stride_(layout.sums.stride()), tail_(regions_ * stride_) {}

    [[nodiscard]] std::size_t of(std::size_t bin) const {
        return bin < tail_ ? bin % stride_ * regions_ + bin / stride_ : bin;
    }
    /// The first index of a part of bin_parts(), and its number of bins below.
    [[nodiscard]] std::size_t first(std::size_t part) const {
        return part < stride_ ? part * regions_ : tail_ + part - stride_;
    }
    [[nodiscard]] std::size_t count(std::size_t part) const {
        return part < stride_ ? regions_ : 1;
    }

  private:
    std::size_t regions_, stride_, tail_;
};

}  // namespace quasimc
