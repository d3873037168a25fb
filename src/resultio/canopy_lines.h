#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "resultio/height_lines.h"
#include "results/fraction_table.h"
#include "runfile/run_file.h"

namespace quasimc {

/// "0.8192 +- 0.0002": a fraction with its error, if it has one.
[[nodiscard]] std::string with_error(const Estimate& e);

/// The fractions of a canopy, and its transmittance by height, over one or several time steps.
class CanopySum {
  public:
    static constexpr std::size_t kMaxBands = 4;

    /// @param scene  that of the results
    explicit CanopySum(const Scene& scene) : by_height_(scene) {}

    /// Adds a result that holds for `weight`: the fractions of the sum are weighted by the light on
    /// the horizontal. The errors of results are independent.
    void add(const Result& result, double weight);
    /// A line for each of the first bands: "PAR: fIPAR 0.9, fAPAR 0.85 +- 0.0003, ...", and one for
    /// its transmittance by height; none where they are unknown. @param groups  whose shares are
    /// added; or null
    [[nodiscard]] std::vector<std::string> lines(
        const RunFile& run, const GroupResults* groups) const;

  private:
    struct Fraction {
        double amount = 0, variance = 0;
    };
    struct OfBand {
        double incident = 0;
        std::array<Fraction, fraction_table().size()> fractions{};
    };
    std::vector<OfBand> bands_;
    TransmittanceSum by_height_;
};

}  // namespace quasimc
