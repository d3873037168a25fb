#pragma once

// The parts of [time], each with its own reader. Included only by the run_file_*.cpp of time.

#include <optional>
#include <string>
#include <vector>

#include "quasimc/run_file.h"
#include "runfile/run_file_sections.h"
#include "weather/weather.h"

namespace quasimc {

/// An interval of time whose light is computed.
struct Interval {
    CivilTime start;
    double seconds = 0;              ///< 0: an instant
    std::optional<Reading> reading;  ///< empty: a clear sky
    std::string where;               ///< its location, for messages
};

/// The requested times, without their light.
struct TimeSpan {
    CivilTime first, last;  ///< midnights: start of the first day, end of the last
    double from_hour = 0, to_hour = 24;

    struct Part {
        CivilTime start;
        double seconds = 0;
    };
    /// The part of an interval within the requested days and hours; 0 seconds if there is none. An
    /// interval that includes midnight belongs to the day of its middle.
    [[nodiscard]] Part part_of(const CivilTime& start, double seconds) const;
};

/// Data shared by the readers of [time].
struct TimeContext {
    TableReader* table;
    const RunFileContext* run;
    std::optional<Site> site;
    std::optional<double> utc_offset_hours;
};

// run_file_intervals.cpp
/// Reads `day`, or `from` and `to`, and `hours`. Empty if neither is given, or after a fault.
[[nodiscard]] std::optional<TimeSpan> read_span(TimeContext& context);
/// The intervals of `times`, `day`, or `from` and `to`, without weather. Empty after a fault.
[[nodiscard]] std::vector<Interval> read_intervals(TimeContext& context);

// run_file_weather.cpp
/// The intervals of a weather file; sets site and time zone if they are not known yet.
[[nodiscard]] std::vector<Interval> read_weather(TimeContext& context);
[[nodiscard]] LightUnit read_light_unit(TableReader& table);

// run_file_daylight.cpp
/// Reads the model of daylight: sky, spectra, bands.
[[nodiscard]] DaylightSources read_daylight(TimeContext& context);
/// Wavelengths and units of the run's bands.
[[nodiscard]] std::vector<SpectralSpan> band_spans(
    TableReader& table, const std::vector<Band>& bands);

}  // namespace quasimc
