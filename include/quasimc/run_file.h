#pragma once

// Run files: what they state, and reading them.

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
#include "quasimc/result.h"
#include "quasimc/run.h"
#include "quasimc/scene.h"
#include "quasimc/series.h"
#include "quasimc/source.h"

namespace quasimc {

struct Node;  // a value of a run file; private

/// What a moment of a series was made from, for headers.
struct TimeStepNotes {
    std::string time;  ///< its beginning, "2024-06-21T12:00+02:00"
    double seconds = 0;
    SunPosition sun;    ///< in the middle of the time that it is up
    Vec3 to_sun;        ///< unit, the file's axes
    Daylight daylight;  ///< on the horizontal, full spectrum, W m-2: the mean
    std::size_t suns = 0;
    /// Of times that share one moment (sun and to_sun then say nothing):
    struct Cumulated {
        std::string until;           ///< end of the last
        std::size_t times = 0;       ///< how many
        std::size_t with_light = 0;  ///< of them, those with daylight
        std::size_t skies = 0;       ///< that the moment has
    };
    std::optional<Cumulated> cumulated = {};
};

/// Which times of a series become one moment: their skies one sky, with all of their suns.
enum class CumulativeSky { none, day, period };

/// The times of a run file, with the sources of each.
struct TimeSeries {
    std::vector<TimeStep> time_steps;
    std::vector<TimeStepNotes> notes;  ///< per moment
    std::vector<std::string> days;     ///< dates, by TimeStep::day; of a period with one cumulative
                                       ///< sky its first and last: "2024-04-01/2024-09-30"
    std::vector<std::string> words;    ///< site, models and units, for headers
    CumulativeSky cumulative_sky = CumulativeSky::none;
};

/// Where results go, and what of them is written.
struct OutputSpec {
    /// The path of each output that is asked for, by its key in [output]: "csv", "json" (`quasimc
    /// list outputs`); "-" is standard output.
    std::map<std::string, std::string, std::less<>> files = {};

    // What of it all is written; what is computed stays the same.
    /// Names of quantity_table(), or "sunlit_fraction"; empty: all.
    std::vector<std::string> quantities = {};
    std::vector<std::string> bands = {};  ///< names; empty: all
    bool include_night = false;           ///< times without light too
    /// Times that begin from the one to before the other, of the clock, in hours.
    std::optional<std::array<double, 2>> time_of_day = {};
};

/// An option stated outside the run file.
struct Override {
    std::string key;    ///< of the table of options
    std::string text;   ///< its value
    std::string where;  ///< where it was stated, for messages: "--paths"
};

/// A value of the run file that a sweep sets.
struct SweptValue {
    std::string key;                         ///< as [sweep] states it: "material.leaf.reflectance"
    std::string text;                        ///< as in tables: 0.1, [0.1, 0.4], sobol
    std::shared_ptr<const Node> value = {};  ///< for the writers
};

/// A point of a sweep: what is its own.
struct SweepPoint {
    std::vector<SweptValue> values;
    std::vector<std::string> source_notes;  ///< as in RunFile
};

/// A run as a file states it, read and checked.
struct RunFile {
    std::string path;  ///< of the file, as given
    std::string title;
    Scene scene;
    Sources sources;  ///< with [time]: those that shine at all times
    RunSpec spec;
    std::optional<TimeSeries> series;  ///< of a run with [time]
    OutputSpec output;                 ///< paths from the folder of the run file resolved
    std::vector<InputFile> inputs;     ///< the run file first
    std::string folder;                ///< that the paths in the run file are relative to
    std::vector<std::string>
        source_notes;               ///< per source: name, kind, direction, irradiance in words
    std::vector<Warning> warnings;  ///< of the readers and of lint()
    std::shared_ptr<const Node> document;  ///< the run file, its [run] complete; for the writers
    /// Of a run of a sweep: which point it is, and all points. Empty without [sweep].
    std::size_t point = 0;
    std::shared_ptr<const std::vector<SweepPoint>> sweep = {};
};

/// The runs that a run file asks for: one, or with [sweep] one for each point. A run without
/// [sweep] is a sweep of one point.
///
/// All points are read and checked at once. Those that differ in lights, materials and settings
/// alone share the triangles of one scene, so that a Simulator builds one
/// acceleration structure for all of them.
class RunSweep {
  public:
    class State;
    explicit RunSweep(std::unique_ptr<State> state);
    RunSweep(RunSweep&& other) noexcept;
    RunSweep& operator=(RunSweep&& other) noexcept;
    ~RunSweep();

    [[nodiscard]] std::size_t size() const;
    /// The run of a point. What the file names is not read from the disk again. A run without
    /// [sweep] can be taken once.
    [[nodiscard]] RunFile take(std::size_t point);
    /// The only run. @throws InputError  if there is a [sweep]
    [[nodiscard]] RunFile only_run() &&;
    /// Of all points, each once.
    [[nodiscard]] const std::vector<Warning>& warnings() const;

  private:
    std::unique_ptr<State> state_;
};

/// The times to compute: those of [time] or else a single one, an instant, with the sources of the
/// run.
[[nodiscard]] std::vector<TimeStep> time_steps_of(const RunFile& run);

/// Reads a run file ("-": standard input).
/// @throws InputError  with all its faults at once, those of all points of its sweep
[[nodiscard]] RunSweep read_run_sweep(
    const std::string& path, const std::vector<Override>& overrides = {});
/// The same of a file without [sweep]; one with it is a fault.
[[nodiscard]] RunFile read_run_file(
    const std::string& path, const std::vector<Override>& overrides = {});

/// A run file with every option and its default, with comments, that can be run as it stands.
[[nodiscard]] std::string default_run_file();

}  // namespace quasimc
