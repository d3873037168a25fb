#pragma once

#include <vector>

#include "series/basis/light_sum.h"

namespace quasimc {

/// How wrong light is that is put together from directions, from times for which it was solved as
/// it is. What the noise of replicates makes of the difference is taken off; regions of like
/// brightness share an error, so that a few times are enough to tell it. Bright times and dim ones
/// count alike.
class InterpolationErrors {
  public:
    explicit InterpolationErrors(const BasisLayout& layout)
        : layout_(layout), light_(layout.bins()) {}

    /// Adds a time.
    void add(const LightSum& together, const LightSum& as_it_is);

    /// The relative error by BinIndex, with one standard error of itself on top.
    [[nodiscard]] std::vector<double> relative() const;

  private:
    void add_parts(const std::vector<double>& squares, const std::vector<double>& lights);
    [[nodiscard]] double relative(const std::vector<std::size_t>& bins) const;

    BasisLayout layout_;
    std::vector<double> light_;                // by BinIndex: squares, in parts of those of a time
    std::vector<std::vector<float>> squares_;  // [time][BinIndex]: of differences, less noise
};

}  // namespace quasimc
