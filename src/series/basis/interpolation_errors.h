#pragma once

#include <vector>

#include "series/basis/light_sum.h"

namespace quasimc {

/// Interpolation error of light combined from basis functions, estimated from reference time steps
/// that are computed directly. The noise of replicates is subtracted from the differences; regions
/// of similar brightness share an error, so that a few reference steps suffice. Bright and dim
/// times have equal weight.
class InterpolationErrors {
  public:
    explicit InterpolationErrors(const BasisLayout& layout)
        : layout_(layout), light_(layout.bins()) {}

    /// Adds a reference time step.
    void add(const LightSum& together, const LightSum& as_it_is);

    /// The relative error by BinIndex, plus one standard error of itself.
    [[nodiscard]] std::vector<double> relative() const;

  private:
    void add_parts(const std::vector<double>& squares, const std::vector<double>& lights);
    [[nodiscard]] double relative(const std::vector<std::size_t>& bins) const;

    BasisLayout layout_;
    std::vector<double> light_;  // by BinIndex: squares, relative to the light of a time
    std::vector<std::vector<float>> squares_;  // [time][BinIndex]: of differences, without noise
};

}  // namespace quasimc
