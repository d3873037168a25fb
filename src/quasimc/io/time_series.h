#pragma once

#include <string>
#include <vector>

#include "quasimc/sources/daylight.h"
#include "quasimc/sources/sun_position.h"
#include "quasimc/tracing/series.h"

namespace quasimc {

/// What a moment of a series was made from, for headers.
struct MomentNotes {
    std::string time;  ///< its beginning, "2024-06-21T12:00+02:00"
    double seconds = 0;
    SunPosition sun;    ///< in the middle of the time that it is up
    Vec3 to_sun;        ///< unit, the file's axes
    Daylight daylight;  ///< on the horizontal, full spectrum, W m-2
    std::size_t suns = 0;
};

/// The times of a run file, with the sources of each.
struct TimeSeries {
    std::vector<Moment> moments;
    std::vector<MomentNotes> notes;  ///< per moment
    std::vector<std::string> days;   ///< dates, by Moment::day
    std::vector<std::string> words;  ///< place, models and units, for headers
};

}  // namespace quasimc
