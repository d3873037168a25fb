#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "quasimc/result.h"
#include "runfile/run_file.h"

namespace quasimc {

/// The transmittance at sensors that are means at one height: their light from above over that on
/// the horizontal, over one or several time steps.
class TransmittanceSum {
  public:
    /// @param scene  that of the results
    explicit TransmittanceSum(const Scene& scene);

    /// Adds a result that holds for `weight`. The errors of results are independent.
    void add(const Result& result, double weight);
    /// A line for each of the first bands: "PAR: transmittance 0.12 +- 0.001 at 0.4 m, ...", the
    /// lowest height first; none where the light on the horizontal is unknown.
    [[nodiscard]] std::vector<std::string> lines(const RunFile& run) const;

  private:
    /// A level mean of sensors that face up.
    struct Level {
        std::string name;
        std::size_t row = 0;  ///< among the results of sensors
        double height = 0;    ///< z up
    };
    struct OfBand {
        double incident = 0;                     ///< horizontal irradiance
        std::vector<double> amounts, variances;  ///< by level
    };
    [[nodiscard]] std::string text_of(const OfBand& band, const std::string& unit) const;

    std::vector<Level> levels_;  // by height
    double area_ = 0;            // horizontal
    std::vector<OfBand> bands_;
};

}  // namespace quasimc
