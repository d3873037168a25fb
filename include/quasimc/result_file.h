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

/// Previous runs, read back from their JSON result.
struct StoredSweep {
    RunSweep runs;              ///< without [output]: a result is not overwritten by accident
    std::string organs_sha256;  ///< digest returned by write_json
    std::string program_version = {};  ///< version of the program that wrote it
    bool is_cut_short = false;  ///< whether time or Ctrl-C ended the run before its paths did
};
/// Reads a JSON result, and the files that its run was made from: beside the result, or else at
/// their paths at the time of the run.
/// @throws InputError  if it is no result, an input is missing or has changed, or the run has
/// faults
[[nodiscard]] StoredSweep read_result_sweep(
    const std::string& path, const std::vector<Override>& overrides = {});

/// Writes the results of the runs of a file, time by time: a listener of each run (run.h). A run
/// without [time] is a series of one time. The run must outlive its writer, or the call of
/// next_run().
class OutputWriter : public RunListener {
  public:
    /// Begins the next point of a sweep.
    /// @param series_summary  summary of the previous point
    virtual void next_run(const RunFile& run, const SeriesSummary& series_summary) = 0;
    /// Ends the file, once all runs are computed. @param series_summary  summary of the last point
    virtual void finish(const SeriesSummary& /*series_summary*/) {}
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == SeriesPart::time_steps;
    }
};

/// Writes a table of organs or groups, by times or, for runs with [time], by sums over days
/// (docs/reference/csv.md): comment lines that begin with '#', one header line, one row per organ
/// or group and time or day.
class CsvWriter : public OutputWriter {
  public:
    CsvWriter(
        const RunFile& run,
        TextSink sink,
        CsvRows rows = CsvRows::organs,
        CsvTimes times = CsvTimes::time_steps);
    CsvWriter(const RunFile&&, TextSink, CsvRows = {}, CsvTimes = {}) = delete;

    void on_time_step(const TimeStepResult& step) override;
    void on_day(std::size_t day, const SeriesSum& sum) override;
    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == (times_ == CsvTimes::days ? SeriesPart::days : SeriesPart::time_steps);
    }
    void next_run(const RunFile& run, const SeriesSummary& /*series_summary*/) override {
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

/// Writes all data of a run and its results (docs/reference/json.md). Days are stored in a
/// temporary file until all times are written.
class JsonWriter : public OutputWriter {
  public:
    /// @param sink  empty: only the digest is computed
    explicit JsonWriter(const RunFile& run, TextSink sink = {});
    explicit JsonWriter(const RunFile&&, TextSink = {}) = delete;
    ~JsonWriter() override;
    JsonWriter(JsonWriter&&) = delete;

    void on_time_step(const TimeStepResult& step) override;
    void on_day(std::size_t day, const SeriesSum& sum) override;
    void finish(const SeriesSummary& series_summary) override;
    [[nodiscard]] bool wants(SeriesPart part) const override;
    void next_run(const RunFile& run, const SeriesSummary& series_summary) override;

    /// The SHA-256 of the organs of all times so far, by which two results are compared.
    [[nodiscard]] std::string digest() const;

  private:
    class State;
    std::unique_ptr<State> state_;
};

class CanopySum;  // private
class SweepSum;   // private

/// The summary of a run in about ten lines.
class Summary : public OutputWriter {
  public:
    explicit Summary(const RunFile& run);
    explicit Summary(const RunFile&&) = delete;

    void on_time_step(const TimeStepResult& step) override;
    void on_sums(const SeriesSums& sums) override;
    [[nodiscard]] bool wants(SeriesPart part) const override;
    void next_run(const RunFile& run, const SeriesSummary& series_summary) override;
    void finish(const SeriesSummary& series_summary) override;
    /// @param summary  summary of the run, or of all points of a sweep
    /// @param written  the files that were written
    [[nodiscard]] std::string text(
        const SeriesSummary& summary, const std::vector<std::string>& written) const;

  private:
    Summary(const RunFile& run, Summary& before);
    [[nodiscard]] std::string series_quality() const;
    [[nodiscard]] std::string point_line() const;

    const RunFile* run_;
    std::vector<std::string> point_lines_;  // of the points of a sweep that ended
    std::shared_ptr<SweepSum> sum_;         // over a sweep, if a table has it
    std::string result_lines_;              // of a run without [time]
    // For a run with [time]:
    std::size_t time_steps_ = 0;
    double seconds_ = 0;
    std::vector<BandBudget> energy_;     // flux x s
    std::shared_ptr<CanopySum> canopy_;  // of lit time steps
    bool escaped_by_difference_ = false;
    std::vector<std::pair<double, std::size_t>> medians_;  // median errors and their time steps
    std::size_t badly_known_ = 0;  // largest number of organs with large errors at a time
};

// Functions that write the result of a run without [time].

void write_csv(const RunFile& run, const Result& result, const TextSink& sink);
/// @returns as JsonWriter::digest
std::string write_json(const RunFile& run, const Result& result, const TextSink& sink);
[[nodiscard]] std::string digest_of_organs(const RunFile& run, const Result& result);
[[nodiscard]] std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written);

}  // namespace quasimc
