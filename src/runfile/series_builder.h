#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "runfile/cumulative_step.h"
#include "runfile/run_file_time.h"

namespace quasimc {

/// Rules to convert intervals to time steps.
struct SeriesRules {
    Site site;
    DaylightSources how;
    LightUnit unit = LightUnit::full_spectrum;
    DiffuseModel model = DiffuseModel::erbs;
    ClearAir air;
    double sun_step = 300;  ///< seconds; 0: one sun position in the middle
    CumulativeSky cumulative_sky = CumulativeSky::none;
};

/// Builds the time steps of a series, and collects warnings about them.
class SeriesBuilder {
  public:
    /// All arguments must outlive the builder. @param lamps  the sources of the file
    SeriesBuilder(const SeriesRules& rules, const SourceList& lamps, Reporter& reporter);

    /// Adds an interval, or reports a fault of its light.
    void add(const Interval& interval);
    /// The series, after the last time.
    [[nodiscard]] TimeSeries finish();

  private:
    /// Number of times with one note, and the first one.
    struct Noted {
        std::size_t count = 0;
        std::string first;

        void add(const Interval& interval) { first = count++ == 0 ? interval.where : first; }
    };

    template <typename Share>
    [[nodiscard]] Sources dimmed_lamps(const Share& share) const;
    void add_time_step(
        const Interval& interval, const SunPath& path, const Daylight& daylight, HourParts parts);
    void gather(const Interval& interval, const Daylight& daylight, const HourParts& parts);
    void close_gathered();
    void note_brightness(const Daylight& daylight, const SunPath& path, const Interval& interval);
    void warn(const Noted& noted, std::string_view text);
    void note_darkness(const HourLight& light, const SunPath& path, const Interval& interval);
    void warn_of_brightness();
    void warn_of_dim_light();
    void report(ReadingFault fault, const SunPath& path, const Interval& interval);
    void add_faults();
    [[nodiscard]] std::size_t day_of(const CivilTime& time);

    const SeriesRules& rules_;
    const SourceList& lamps_;
    Reporter& reporter_;
    TimeSeries series_;
    CumulativeStep gathered_;
    std::vector<std::pair<CivilTime, double>> gathered_times_;  // with their lengths in seconds
    std::string first_date_, last_date_;                        // of the cumulative sky
    std::map<ReadingNote, Noted> noted_;
    std::map<ReadingFault, std::pair<Fault, std::size_t>> faults_;  // the first, and their number
    Noted too_bright_;
    double brightest_ = 0;        // W m-2, of the times that are too bright
    double brightest_ratio_ = 0;  // ratio to the light outside the atmosphere
    Noted dark_by_day_;           // times without light, with the sun high
    Noted by_day_;                // times with the sun well up
    double clearest_ = 0;         // largest ratio of by_day_ to the light outside the atmosphere
    double longest_ = 0;          // longest time of by_day_, seconds
};

}  // namespace quasimc
