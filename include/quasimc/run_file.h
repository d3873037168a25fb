#pragma once

// Run files: their contents, and functions that read them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/gap_fraction.h"
#include "quasimc/lamp_control.h"
#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/scene.h"
#include "quasimc/series.h"
#include "quasimc/source.h"

namespace quasimc {

struct Node;  // a value of a run file; private

/// The origin of a time step, for headers.
struct TimeStepNotes {
    std::string time;  ///< its beginning, "2024-06-21T12:00+02:00"
    double seconds = 0;
    SunPosition sun;    ///< at the middle of the time with the sun above the horizon
    Vec3 to_sun;        ///< unit, the file's axes
    Daylight daylight;  ///< mean on the horizontal, full spectrum, W m-2
    std::size_t suns = 0;
    /// For times with one cumulative sky (sun and to_sun are then meaningless):
    struct Cumulated {
        std::string until;           ///< end of the last
        std::size_t times = 0;       ///< number of times
        std::size_t with_light = 0;  ///< number of those with daylight
        std::size_t skies = 0;       ///< number of skies in the cumulative sky
    };
    std::optional<Cumulated> cumulated = {};
};

/// The times that share a cumulative sky: their skies are added to one sky, with all of their suns.
enum class CumulativeSky { none, day, period };

/// The times of a run file, with the sources of each.
struct TimeSeries {
    std::vector<TimeStep> time_steps;
    std::vector<TimeStepNotes> notes;  ///< per time step
    std::vector<std::string> days;   ///< dates, by TimeStep::day; for a cumulative sky of a period
                                     ///< its first and last: "2024-04-01/2024-09-30"
    std::vector<std::string> words;  ///< site, models and units, for headers
    CumulativeSky cumulative_sky = CumulativeSky::none;
    std::vector<LampControl> controls = {};     ///< [[control]]
    std::vector<ControlOutcome> outcomes = {};  ///< per control, from time_steps_of()
};

/// The contents of the rows of a table.
enum class CsvRows { organs, groups, sensors, detectors, control };
/// The times of its rows: each, or sums over each day, over all of them, or over all points of a
/// sweep.
enum class CsvTimes { time_steps, days, period, sweep };
[[nodiscard]] constexpr bool is_summed(CsvTimes times) {
    return times != CsvTimes::time_steps;
}
/// One row for each organ, group or sensor, or for each of its numbers.
enum class CsvForm { wide, narrow };
/// The numbers of an estimate that are written.
enum class CsvStatistic { mean, standard_error, ci95_low, ci95_high };

/// A table: [[table]] of a run file.
struct TableSpec {
    std::string file;  ///< resolved path; "-" is standard output
    CsvRows rows = CsvRows::organs;
    CsvTimes times = CsvTimes::time_steps;
    CsvForm form = CsvForm::wide;
    std::string where = {};                                ///< condition on its rows; "": all
    std::vector<std::string> quantities = {}, bands = {};  ///< names; empty: all
    /// Names of the run's origins whose light is written beside all light; absent: all of them.
    std::optional<std::vector<std::string>> origins = {};
    std::vector<CsvStatistic> statistics = {
        CsvStatistic::mean, CsvStatistic::standard_error, CsvStatistic::ci95_high};
    int digits = 17;            ///< significant; 17: the shortest exact text
    std::string location = {};  ///< in the run file, for messages
};

/// The output files, and their contents.
struct OutputSpec {
    /// The path of each requested output, by its key in [output]: "csv", "json" (`quasimc list
    /// outputs`); "-" is standard output.
    std::map<std::string, std::string, std::less<>> files = {};

    // Selection of the written results; it does not change the computation.
    /// Names of quantity_table(), or "sunlit_fraction"; empty: all.
    std::vector<std::string> quantities = {};
    std::vector<std::string> bands = {};  ///< names; empty: all
    bool include_night = false;           ///< includes times without light
    /// Only times that begin within these clock hours, [first, second).
    std::optional<std::array<double, 2>> time_of_day = {};
    std::vector<TableSpec> tables = {};  ///< [[table]]
};

/// An option given outside the run file.
struct Override {
    std::string key;    ///< key of the option
    std::string text;   ///< its value
    std::string where;  ///< its location, for messages: "--paths"
};

/// A value of the run file that a sweep sets.
struct SweptValue {
    std::string key;                         ///< key in [sweep]: "material.leaf.reflectance"
    std::string text;                        ///< text in tables: 0.1, [0.1, 0.4], sobol
    std::shared_ptr<const Node> value = {};  ///< for the writers
};

/// The values and sources of a point of a sweep.
struct SweepPoint {
    std::vector<SweptValue> values;
    std::vector<std::string> source_notes;  ///< see RunFile
    double weight = 1;                      ///< in sums over the points; 0 or more
};

/// The run of a file, read and checked.
struct RunFile {
    std::string path;  ///< the given path of the file
    std::string title;
    Scene scene;
    Sources sources;  ///< with [time]: the sources of all times
    RunSpec spec;
    std::optional<TimeSeries> series;            ///< for a run with [time]
    std::vector<GapFractionSpec> gap_fractions;  ///< [[gap_fraction]]
    OutputSpec output;                           ///< paths from the folder of the run file resolved
    std::vector<InputFile> inputs;               ///< the run file first
    std::string folder;                          ///< base of the paths in the run file
    std::vector<std::string>
        source_notes;               ///< per source: name, kind, direction, irradiance in words
    std::vector<Warning> warnings;  ///< from the readers and from lint()
    std::shared_ptr<const Node> document;  ///< the run file, its [run] complete; for the writers
    /// Index of the run's point in the sweep, and all points. Empty without [sweep].
    std::size_t point = 0;
    std::shared_ptr<const std::vector<SweepPoint>> sweep = {};
};

/// The runs of a run file: one, or with [sweep] one for each point. A run without [sweep] is a
/// sweep of one point.
///
/// All points are read and checked at once. Points that differ only in lights, materials and
/// settings share the triangles of one scene, so that a Simulator builds one acceleration structure
/// for all of them.
class RunSweep {
  public:
    class State;
    explicit RunSweep(std::unique_ptr<State> state);
    RunSweep(RunSweep&& other) noexcept;
    RunSweep& operator=(RunSweep&& other) noexcept;
    ~RunSweep();

    [[nodiscard]] std::size_t size() const;
    /// The run of a point. Input files are not read again. A run without [sweep] can be taken once.
    [[nodiscard]] RunFile take(std::size_t point);
    /// The only run. @throws InputError  if there is a [sweep]
    [[nodiscard]] RunFile only_run() &&;
    /// The warnings of all points, each once.
    [[nodiscard]] const std::vector<Warning>& warnings() const;

  private:
    std::unique_ptr<State> state_;
};

/// The times to compute: those of [time] or else a single one, an instant, with the sources of the
/// run. The first call switches and dims the lamps of [[control]], by the light at their sensors,
/// which is computed for it, and writes TimeSeries::outcomes.
/// @param simulator  keeps the acceleration structure
/// @throws InputError  as run() does
[[nodiscard]] std::vector<TimeStep> time_steps_of(RunFile& run, Simulator& simulator);

/// Reads a run file ("-": standard input).
/// @throws InputError  with all errors at once, of all points of its sweep
[[nodiscard]] RunSweep read_run_sweep(
    const std::string& path, const std::vector<Override>& overrides = {});
/// Reads a run file without [sweep]; one with it is an error.
[[nodiscard]] RunFile read_run_file(
    const std::string& path, const std::vector<Override>& overrides = {});

/// A commented run file with every option and its default, ready to run.
[[nodiscard]] std::string default_run_file();

}  // namespace quasimc
