#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "light/daylight/hour_light.h"
#include "light/daylight/period_light.h"
#include "quasimc/run_file.h"

namespace quasimc {

/// Combines times into one time step (cumulative sky): its light is their mean, its length their
/// sum, so that light times length is the sum over the times.
class CumulativeStep {
  public:
    explicit CumulativeStep(std::size_t bands) : bands_(bands), light_(bands) {}

    [[nodiscard]] bool empty() const { return times_ == 0; }
    /// @param seconds  length of the time, positive
    /// @param begin, end  texts of its beginning and end
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
    /// The time step of the added times, at least one. @param lamps  sources that shine all the
    /// time
    [[nodiscard]] Made make(const Sources& lamps, std::size_t day) const;

  private:
    /// A sky and its irradiance, summed over the times with this shape, x s.
    struct SameSky {
        SkyShape shape;
        std::vector<double> horizontal;
    };

    std::size_t bands_;
    std::map<std::string, SameSky> skies_;  // by the text that describes the shape
    PeriodLight light_;                     // the suns
    Daylight daylight_;                     // x s
    double seconds_ = 0;
    std::size_t times_ = 0, with_light_ = 0;
    std::string begin_, end_;
};

}  // namespace quasimc
