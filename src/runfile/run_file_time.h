#pragma once

// The parts of [time], each read by a function of its own. Included by the
// run_file_*.cpp of time only.

#include <optional>
#include <string>
#include <vector>

#include "quasimc/run_file.h"
#include "runfile/run_file_sections.h"
#include "weather/weather.h"

namespace quasimc {

/// A stretch of time whose light is to be computed.
struct Interval {
    CivilTime start;
    double seconds = 0;              ///< 0: an instant
    std::optional<Reading> reading;  ///< nothing: a clear sky
    std::string where;               ///< where it is stated, for messages
};

/// The times asked for, before weather fills them.
struct TimeSpan {
    CivilTime first, last;  ///< midnights: of the first day, and after the last
    double from_hour = 0, to_hour = 24;

    struct Part {
        CivilTime start;
        double seconds = 0;
    };
    /// The part of a time within the hours of the days asked for; 0 seconds if there is none. A
    /// time over midnight belongs to the day of its middle.
    [[nodiscard]] Part part_of(const CivilTime& start, double seconds) const;
};

/// Shared by the readers of [time].
struct TimeContext {
    TableReader* table;
    const RunFileContext* run;
    std::optional<Site> site;
    std::optional<double> utc_offset_hours;
};

// run_file_intervals.cpp
/// day, or from and to, and hours. Nothing if neither is given or after a fault.
[[nodiscard]] std::optional<TimeSpan> read_span(TimeContext& context);
/// The intervals of times, day or from and to, without weather. Empty after a fault.
[[nodiscard]] std::vector<Interval> read_intervals(TimeContext& context);

// run_file_weather.cpp
/// The intervals of a weather file; sets site and time zone if they are still open.
[[nodiscard]] std::vector<Interval> read_weather(TimeContext& context);
[[nodiscard]] LightUnit read_light_unit(TableReader& table);

// run_file_daylight.cpp
/// How daylight becomes sources: sky, spectra, bands.
[[nodiscard]] DaylightSources read_daylight(TimeContext& context);
/// What the bands of the run count.
[[nodiscard]] std::vector<SpectralSpan> band_spans(
    TableReader& table, const std::vector<Band>& bands);

}  // namespace quasimc
