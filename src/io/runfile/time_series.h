#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/series.h"
#include "sources/daylight.h"
#include "sources/sun_position.h"

namespace quasimc {

/// What a moment of a series was made from, for headers.
struct MomentNotes {
    std::string time;  ///< its beginning, "2024-06-21T12:00+02:00"
    double seconds = 0;
    SunPosition sun;    ///< in the middle of the time that it is up
    Vec3 to_sun;        ///< unit, the file's axes
    Daylight daylight;  ///< on the horizontal, full spectrum, W m-2: the mean
    std::size_t suns = 0;
    /// Of times that were collapsed into one moment (sun and to_sun then say nothing):
    struct Collapsed {
        std::string until;           ///< end of the last
        std::size_t times = 0;       ///< how many
        std::size_t with_light = 0;  ///< of them, those with daylight
        std::size_t skies = 0;       ///< that the moment has
    };
    std::optional<Collapsed> collapsed = {};
};

/// Which times of a series become one moment: their skies one sky, with all of their suns.
enum class Collapse { none, days, period };

/// The times of a run file, with the sources of each.
struct TimeSeries {
    std::vector<TimeStep> time_steps;
    std::vector<MomentNotes> notes;  ///< per moment
    std::vector<std::string> days;   ///< dates, by TimeStep::day; of a collapsed period its first
                                     ///< and last: "2024-04-01/2024-09-30"
    std::vector<std::string> words;  ///< place, models and units, for headers
    Collapse collapse = Collapse::none;
};

}  // namespace quasimc
