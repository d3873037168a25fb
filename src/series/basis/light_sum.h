#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "series/basis/light_response.h"

namespace quasimc {

/// Incident light of all regions, per band: the sum, and the sum of its variances.
struct SumWithVariance {
    std::vector<double> light, variance;
};

/// A linear combination of responses.
class LightSum {
  public:
    LightSum(const BasisLayout& layout, std::size_t replicates);

    /// Computes several sums of the same responses together: responses are read once.
    /// @param amounts  per sum: [response][amounts of add()]
    /// @param responses  those without bins are in no sum
    /// @param sums  of one layout; overwritten
    static void combine(
        std::span<const LightResponse> responses,
        std::span<const std::vector<double>> amounts,
        std::span<LightSum> sums,
        unsigned threads);

    /// Adds a response.
    /// @param amounts  factors: per band for direct light, then per band for scattered light.
    /// Sunlit areas are not added.
    void add(const LightResponse& response, std::span<const double> amounts);
    /// Adds `factor` times the direct light and the sunlit areas of suns, without scattered light.
    void add_suns(const LightResponse& response, double factor);
    /// Adds `factor` times another sum.
    void add(const LightSum& other, double factor);
    /// Errors as deviations of replicates: their mean is 0 in each bin, and their scatter as large
    /// as if the mean had the error. They are independent between regions, and between keys. What
    /// surfaces scatter deviates by as much as arrives, so that each replicate closes its budget.
    /// @param errors  of the mean relative to it, by BinIndex
    /// @param is_opaque  by region
    [[nodiscard]] LightSum deviations(
        std::span<const double> errors,
        const std::vector<bool>& is_opaque,
        std::uint64_t key) const;

    /// [replicate][BinIndex]
    [[nodiscard]] const std::vector<std::vector<double>>& bins() const { return bins_; }
    /// @param errors  relative, by BinIndex, added to the spread of replicates; empty: none
    [[nodiscard]] SumWithVariance spread(std::span<const double> errors) const;
    [[nodiscard]] bool is_dark() const;

    /// Input of evaluate().
    struct Reading {
        std::uint64_t paths = 1;  ///< equivalent paths per replicate
        double sunlit_area = 0;   ///< of all regions; 0: no sun shines
    };
    [[nodiscard]] Sums sums(const Reading& reading) const;

  private:
    void add_parts(const LightResponse& response, std::span<const double> factors);
    [[nodiscard]] double mean_of(std::size_t bin) const;
    void deviate(std::size_t bin, double error, const std::vector<double>& pattern);
    void scatter_too(std::size_t bin, std::size_t band);
    void set_emitted(std::span<const LightResponse> responses, std::span<const double> amounts);
    [[nodiscard]] ExactBins exact_bins(std::size_t replicate, std::span<const double> units) const;

    BasisLayout layout_;
    std::vector<std::vector<double>> bins_;  // [replicate][BinIndex]
    std::vector<double> emitted_;            // per band
};

}  // namespace quasimc
