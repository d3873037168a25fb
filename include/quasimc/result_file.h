#pragma once

// The files that results are written to and read from.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quasimc/file.h"
#include "quasimc/result.h"
#include "quasimc/run_file.h"

namespace quasimc {

/// Runs that were done before, read back from their JSON result.
struct StoredSweep {
    RunSweep runs;  ///< their [output] is left out: a result is not overwritten by accident
    std::string organs_sha256;         ///< as write_json returned it
    std::string program_version = {};  ///< that wrote it
    bool is_cut_short = false;  ///< whether time or Ctrl-C ended the run before its paths did
};
/// Reads a JSON result, and the files that its run was made from: those beside the result, or else
/// those at the places where they were.
/// @throws InputError  if it is no result, an input is gone or has changed, or the run has faults
[[nodiscard]] StoredSweep read_result_sweep(
    const std::string& path, const std::vector<Override>& overrides = {});

// What a run writes, while it goes on: each writer is told of every time that is computed, of every
// day, of the next point of a sweep, and of the end. A run without [time] is a series of one time.

/// What the rows of a table are of, and what each of them is told for.
enum class CsvRows { organs, groups };
enum class CsvTimes { moments, days };

/// A table of organs or groups, and of times or, of a run with [time], of sums over days
/// (docs/formats/csv.md, groups.md): comment lines that begin with '#', one header line, one row
/// per organ or group and time or day. The run must outlive it.
class CsvWriter {
  public:
    CsvWriter(
        const RunFile& run,
        TextSink sink,
        CsvRows rows = CsvRows::organs,
        CsvTimes times = CsvTimes::moments);

    // A table takes from these what it is of.
    /// @param moment  which of moments_of(run) the result is of
    void add_moment(std::size_t time_step, const Result& result);
    void add_day(std::size_t day, const SeriesSum& sum);
    /// What follows is of this run, of the same sweep. It must outlive the writer.
    void next_run(const RunFile& run) { run_ = &run; }

  private:
    void write_head(const Result* result);
    void write_rows(
        const std::string& first,
        const std::vector<OrganGroup>& groups,
        const std::function<void(std::string&, std::size_t)>& append) const;

    const RunFile* run_;
    TextSink sink_;
    CsvRows rows_;
    CsvTimes times_;
    std::vector<std::string> labels_;
    bool has_head_ = false;
};

/// Everything that is known of a run and its results (docs/formats/json.md). Days are kept in a
/// temporary file until all moments are written. The run must outlive it.
class JsonWriter {
  public:
    /// @param sink  without one nothing is written, and finish() gives the digest
    explicit JsonWriter(const RunFile& run, TextSink sink = {});
    ~JsonWriter();
    JsonWriter(JsonWriter&&) = delete;

    /// @param traced  the moment whose trace the result was scaled from, or itself
    void add_moment(std::size_t time_step, const Result& result, std::size_t traced);
    void add_day(std::size_t day, const SeriesSum& sum);
    /// Ends a point of a sweep; what follows is of the next one.
    /// @param summary  of the point that ends
    void next_run(const RunFile& run, const SeriesSummary& summary);
    /// Ends the file. @param summary  of the last point @returns the SHA-256 of the organs' parts
    /// of all moments, by which two results are compared
    std::string finish(const SeriesSummary& summary = {});

  private:
    class State;
    std::unique_ptr<State> state_;
};

/// What a person wants to know at once of a run: ten lines or so. The run must outlive it.
class Summary {
  public:
    explicit Summary(const RunFile& run) : run_(&run) {}

    void add_moment(const Result& result);
    /// Ends a point of a sweep; what follows is of the next one.
    void next_run(const RunFile& run, const SeriesSummary& summary);
    /// @param summary  of the run, or of all points of a sweep
    /// @param written  the files that were written
    [[nodiscard]] std::string text(
        const SeriesSummary& summary, const std::vector<std::string>& written) const;

  private:
    Summary(const RunFile& run, std::vector<std::string> points)
        : run_(&run), point_lines_(std::move(points)) {}
    [[nodiscard]] std::string series_quality() const;
    [[nodiscard]] std::string point_line() const;

    const RunFile* run_;
    std::vector<std::string> point_lines_;  // of the points of a sweep that ended
    std::string result_lines_;              // of a run without [time]
    // Of one with [time]:
    std::size_t moments_ = 0;
    double seconds_ = 0;
    std::vector<BandBudget> energy_;  // flux x s
    bool escaped_is_remainder_ = false;
    std::vector<std::pair<double, std::size_t>> medians_;  // errors, and of which moment
    std::size_t badly_known_ = 0;                          // most organs at a time
};

// The same of the result of a run without [time].

void write_csv(const RunFile& run, const Result& result, const TextSink& sink);
/// @returns as JsonWriter::finish
std::string write_json(const RunFile& run, const Result& result, const TextSink& sink);
[[nodiscard]] std::string digest_of_organs(const RunFile& run, const Result& result);
[[nodiscard]] std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written);

}  // namespace quasimc
