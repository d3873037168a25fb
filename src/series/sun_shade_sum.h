#pragma once

#include <cstddef>
#include <vector>

#include "quasimc/result.h"
#include "series/time_sums.h"

namespace quasimc {

/// Sums the light of sunlit and shaded parts over time. Fractions become hours; light per sunlit or
/// shaded area becomes its mean over area and time.
class SunShadeAdder {
  public:
    SunShadeAdder() = default;
    /// @param rows  number of organs or groups
    SunShadeAdder(std::size_t rows, std::size_t bands);

    /// Adds a time step.
    /// @param sunlit  sunlit fractions of the rows; empty: 0
    /// @param weight  of light: seconds, times a factor on the light; of time: seconds
    void add(
        const SunShadeLight& light,
        const std::vector<Estimate>& sunlit,
        const TimeWeight& weight,
        double freedom);

    /// @param seconds  the whole time; there was no light while nothing was added
    [[nodiscard]] SunShadeLight sum(double seconds) const;
    /// Sunlit fraction x time, per row: hours.
    [[nodiscard]] std::vector<Estimate> sunlit_hours() const;

  private:
    std::size_t bands_ = 0;
    double seconds_ = 0;  // of all that was added
    std::vector<TimeSum> sums_, hours_;
    std::vector<TimeQuotient> quotients_;  // as sums_, of densities of parts
};

}  // namespace quasimc
