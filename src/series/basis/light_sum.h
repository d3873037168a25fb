#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "series/basis/light_response.h"

namespace quasimc {

/// What falls on all regions, per band: the sum, and the sum of its variances.
struct SumWithVariance {
    std::vector<double> light, variance;
};

/// Light of several responses, each so many times.
class LightSum {
  public:
    LightSum(const BasisLayout& layout, std::size_t replicates);

    /// Makes several sums of the same responses, in one go: they are read once for all.
    /// @param amounts  of each sum: [response][amounts of add()]
    /// @param responses  without bins: no sum has any of it
    /// @param sums  of one layout; what they held is lost
    static void combine(
        std::span<const LightResponse> responses,
        std::span<const std::vector<double>> amounts,
        std::span<LightSum> sums,
        unsigned threads);

    /// Adds a response.
    /// @param amounts  by how much each of its parts counts: per band of light straight from it,
    ///        then per band of what was scattered. Of what is sunlit nothing is added.
    void add(const LightResponse& response, std::span<const double> amounts);
    /// Adds the light straight from suns and what of the scene they light, `factor` times. The
    /// response's scattered light is left out. To a single replicate the mean of all is added.
    void add_suns(const LightResponse& response, double factor);
    LightSum& operator+=(const LightSum& other);
    /// The mean of all replicates, as the only one.
    [[nodiscard]] LightSum averaged() const;
    /// Raises each bin by a part of itself, and makes of that both levels of patches.
    /// @param parts  by BinIndex of a bin
    void raise(std::span<const double> parts);

    /// [replicate][BinIndex]
    [[nodiscard]] const std::vector<std::vector<double>>& bins() const { return bins_; }
    /// @param errors  relative, by BinIndex of a bin, on top of what replicates say; empty: none
    [[nodiscard]] SumWithVariance spread(std::span<const double> errors) const;
    [[nodiscard]] bool is_dark() const;

    /// What evaluate() reads.
    struct Reading {
        std::uint64_t paths = 1;  ///< that stand for the light, of each replicate
        double sunlit_area = 0;   ///< of all regions; 0: no sun shines
    };
    [[nodiscard]] Sums sums(const Reading& reading) const;

  private:
    void add_parts(const LightResponse& response, std::span<const double> factors);
    void set_emitted(std::span<const LightResponse> responses, std::span<const double> amounts);
    [[nodiscard]] ExactBins exact_bins(std::size_t replicate, std::span<const double> units) const;

    BasisLayout layout_;
    std::vector<std::vector<double>> bins_;  // [replicate][BinIndex]
    std::vector<double> emitted_;            // per band
};

}  // namespace quasimc
