#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// The bins of light that is put together from several runs: a spectrum for each band, so that
/// amounts of all of them can be added, and two levels of patches.
[[nodiscard]] SumLayout common_layout(const Scene& scene);

/// What one light brings, apart from noise linear in its amount.
struct LightResponse {
    /// [replicate][bin of common_layout()]: flux; of what is sunlit, area.
    std::vector<std::vector<float>> bins;
    std::vector<double> emitted;  ///< flux into the scene, per band
};

/// Reads from sums what those lights bring that have the bands from `first_band` on for themselves.
[[nodiscard]] LightResponse read_response(
    const Sums& sums, std::size_t first_band, const SumLayout& layout);

/// Light of several responses, each so many times.
class LightSum {
  public:
    LightSum(const SumLayout& layout, std::size_t replicates);

    /// Adds a response.
    /// @param amounts  by how much each of its parts counts: per band of light straight from it,
    ///        then per band of what was scattered. Of what is sunlit nothing is added.
    void add(const LightResponse& response, std::span<const double> amounts);
    /// Adds the light straight from suns and what of the scene they light, `factor` times. The
    /// response's scattered light is left out.
    void add_suns(const LightResponse& response, double factor);
    LightSum& operator+=(const LightSum& other);
    /// Raises each bin by a part of itself, and makes of that both levels of patches.
    /// @param parts  by bin
    void raise(std::span<const double> parts);

    /// By bin, the mean of the replicates.
    [[nodiscard]] std::vector<double> mean() const;
    [[nodiscard]] bool is_dark() const;

    /// What evaluate() reads.
    struct Reading {
        std::uint64_t paths = 1;  ///< that stand for the light, of each replicate
        double sunlit_area = 0;   ///< of all regions; 0: no sun shines
    };
    [[nodiscard]] Sums sums(const Reading& reading) const;

  private:
    void add_parts(const LightResponse& response, std::span<const double> factors);
    [[nodiscard]] ExactBins exact_bins(std::size_t replicate, std::span<const double> units) const;

    SumLayout layout_;
    std::vector<std::vector<double>> bins_;  // [replicate]
    std::vector<double> emitted_;            // per band
};

}  // namespace quasimc
