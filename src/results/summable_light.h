#pragma once

// Light that is ready to be summed, with the errors of its sums.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/bounds/organ_contributions.h"
#include "results/combine.h"
#include "scene/scene.h"

namespace quasimc {

/// The light or area that is summed.
enum class Summand : std::uint8_t {
    flux,
    sunlit_area,            ///< contributions are paths or rays
    sunlit_area_by_points,  ///< contributions are points of the organs
};

/// The columns of SummableLight and their meaning.
struct SummableColumns {
    Summand summand = Summand::flux;
    std::uint32_t replicates = 0;
    std::vector<ContributionKind> kinds;

    [[nodiscard]] std::size_t size() const;
    [[nodiscard]] SumRule rule(std::size_t column) const;
    friend bool operator==(const SummableColumns&, const SummableColumns&) = default;
};

/// Light of one quantity in one band (or the sunlit area), of organs or of weighted sums of them:
/// replicate by replicate, with all that the errors and intervals of sums follow from. A weighted
/// sum of entries is an entry again, so that sums of sums have the errors of one sum.
class SummableLight {
  public:
    /// The flux of all organs, also for quantities per area. @param threads  at least 1
    [[nodiscard]] static SummableLight of_flux(
        const Sums& sums,
        const Scene& scene,
        const EvaluationSpec& spec,
        Quantity quantity,
        std::size_t band);
    /// The sunlit area of all organs, of a run with directional sources.
    [[nodiscard]] static SummableLight of_sunlit_area(
        const Sums& sums, const Scene& scene, const EvaluationSpec& spec);
    /// @param numbers  [column * entries + entry]
    SummableLight(SummableColumns columns, std::vector<double> numbers);

    [[nodiscard]] std::size_t size() const { return numbers_.size() / columns_.size(); }
    [[nodiscard]] const SummableColumns& columns() const { return columns_; }
    [[nodiscard]] const std::vector<double>& numbers() const { return numbers_; }

    /// By entry; NaN if an organ is not measured.
    [[nodiscard]] std::span<const double> means() const { return column(0); }
    /// Deviations of the replicates from the mean: [replicate * entries + entry].
    [[nodiscard]] std::span<const double> deviations() const {
        return std::span(numbers_).subspan(size(), columns_.replicates * size());
    }
    /// The change of an entry by one contribution.
    [[nodiscard]] const std::vector<ContributionSize>& sizes() const { return sizes_; }
    /// Estimates of the entries, with intervals within physical bounds. Those of all organs with
    /// weights of 1 are those of a group of them, times its area for quantities per area.
    [[nodiscard]] std::vector<Estimate> estimates() const;

    /// Weighted sums of entries. @param threads  at least 1
    [[nodiscard]] SummableLight combined(
        std::span<const OrganWeights> of, unsigned threads = 1) const;

    /// The entries of all in their order. @param lights  at least one; of equal columns
    [[nodiscard]] static SummableLight joined(std::span<const SummableLight* const> lights);

  private:
    [[nodiscard]] std::span<const double> column(std::size_t index) const {
        return std::span(numbers_).subspan(index * size(), size());
    }
    [[nodiscard]] double at(std::size_t column, std::size_t entry) const {
        return numbers_[column * size() + entry];
    }
    [[nodiscard]] ContributionSize size_of(std::size_t entry) const;
    [[nodiscard]] Estimate estimate(std::size_t entry, std::span<const double> values) const;

    SummableColumns columns_;
    std::vector<double> numbers_;
    std::vector<ContributionSize> sizes_;
};

}  // namespace quasimc
