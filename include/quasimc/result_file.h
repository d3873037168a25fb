#pragma once

// The files that results are written to and read from.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "quasimc/run.h"
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
/// those at their paths at the time of the run.
/// @throws InputError  if it is no result, an input is gone or has changed, or the run has faults
[[nodiscard]] StoredSweep read_result_sweep(
    const std::string& path, const std::vector<Override>& overrides = {});

/// Writes what the runs of a file compute, time by time: a listener of each run (run.h). A run
/// without [time] is a series of one time. The run must outlive its writer, or the call of
/// next_run().
class OutputWriter : public RunListener {
  public:
    /// What follows is of the next point of a sweep.
    /// @param of_the_last  of the point that ends
    virtual void next_run(const RunFile& run, const SeriesSummary& of_the_last) = 0;
    /// Ends the file, once all runs are computed. @param of_the_last  of the last point
    virtual void finish(const SeriesSummary& /*of_the_last*/) {}
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == SeriesPart::time_steps;
    }
};

/// What the rows of a table are of, and what for.
enum class CsvRows { organs, groups };
enum class CsvTimes { moments, days };

/// Writes a table of organs or groups, and of times or, of a run with [time], of sums over days
/// (docs/reference/csv.md, groups.md): comment lines that begin with '#', one header line, one row
/// per organ or group and time or day.
class CsvWriter : public OutputWriter {
  public:
    CsvWriter(
        const RunFile& run,
        TextSink sink,
        CsvRows rows = CsvRows::organs,
        CsvTimes times = CsvTimes::moments);
    CsvWriter(const RunFile&&, TextSink, CsvRows = {}, CsvTimes = {}) = delete;

    void on_time_step(const TimeStepResult& step) override;
    void on_day(std::size_t day, const SeriesSum& sum) override;
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == (times_ == CsvTimes::days ? SeriesPart::days : SeriesPart::time_steps);
    }
    void next_run(const RunFile& run, const SeriesSummary& /*of_the_last*/) override {
        run_ = &run;
    }

  private:
    void write_head(const Result* result);
    template <typename Append>
    void write_rows(
        const std::string& first, const std::vector<OrganGroup>& groups, Append append) const;

    const RunFile* run_;
    TextSink sink_;
    CsvRows rows_;
    CsvTimes times_;
    std::vector<std::string> labels_;
    bool has_head_ = false;
};

/// Writes everything that is known of a run and its results (docs/reference/json.md). Days are kept
/// in a temporary file until all times are written.
class JsonWriter : public OutputWriter {
  public:
    /// @param sink  empty: nothing is written but for the digest
    explicit JsonWriter(const RunFile& run, TextSink sink = {});
    explicit JsonWriter(const RunFile&&, TextSink = {}) = delete;
    ~JsonWriter() override;
    JsonWriter(JsonWriter&&) = delete;

    void on_time_step(const TimeStepResult& step) override;
    void on_day(std::size_t day, const SeriesSum& sum) override;
    void finish(const SeriesSummary& of_the_last) override;
    [[nodiscard]] bool wants(SeriesPart part) const override;
    void next_run(const RunFile& run, const SeriesSummary& of_the_last) override;

    /// The SHA-256 of the organs of all times so far, by which two results are compared.
    [[nodiscard]] std::string digest() const;

  private:
    class State;
    std::unique_ptr<State> state_;
};

/// Tells in ten lines or so what a person wants to know at once of a run.
class Summary : public OutputWriter {
  public:
    explicit Summary(const RunFile& run) : run_(&run) {}
    explicit Summary(const RunFile&&) = delete;

    void on_time_step(const TimeStepResult& step) override;
    void next_run(const RunFile& run, const SeriesSummary& of_the_last) override;
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
    std::size_t time_steps_ = 0;
    double seconds_ = 0;
    std::vector<BandBudget> energy_;  // flux x s
    bool escaped_by_difference_ = false;
    std::vector<std::pair<double, std::size_t>> medians_;  // errors, and of which moment
    std::size_t badly_known_ = 0;                          // most organs at a time
};

// The result of a run without [time], at once.

void write_csv(const RunFile& run, const Result& result, const TextSink& sink);
/// @returns as JsonWriter::digest
std::string write_json(const RunFile& run, const Result& result, const TextSink& sink);
[[nodiscard]] std::string digest_of_organs(const RunFile& run, const Result& result);
[[nodiscard]] std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written);

}  // namespace quasimc
