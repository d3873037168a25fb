#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "light/daylight/hour_light.h"
#include "light/daylight/period_light.h"
#include "quasimc/run_file.h"

namespace quasimc {

/// Gathers times into one moment: with the mean of their light, and as long as all of them. Its
/// light times its length is then the sum over the times.
class CumulativeStep {
  public:
    explicit CumulativeStep(std::size_t bands) : bands_(bands), light_(bands) {}

    [[nodiscard]] bool empty() const { return times_ == 0; }
    /// @param seconds  how long the time is, over 0
    /// @param begin, end  texts of its ends
    void add(
        const HourParts& parts,
        const Daylight& daylight,
        double seconds,
        const std::string& begin,
        const std::string& end);

    struct Made {
        TimeStep time_step;
        TimeStepNotes notes;
    };
    /// The moment of what was added, which must not be nothing. @param lamps  shine all the time
    [[nodiscard]] Made make(const Sources& lamps, std::size_t day) const;

  private:
    /// A sky and what it brings, summed over the times that it looks like this, x s.
    struct SameSky {
        SkyShape shape;
        std::vector<double> horizontal;
    };

    std::size_t bands_;
    std::map<std::string, SameSky> skies_;  // by the text that tells the shape
    PeriodLight light_;                     // the suns
    Daylight daylight_;                     // x s
    double seconds_ = 0;
    std::size_t times_ = 0, with_light_ = 0;
    std::string begin_, end_;
};

}  // namespace quasimc
