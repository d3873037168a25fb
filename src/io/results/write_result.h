#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/results/json_stream.h"
#include "io/results/spool.h"
#include "io/runfile/run_file.h"
#include "io/sha256.h"
#include "io/text_sink.h"
#include "results/result.h"
#include "run/series.h"

// What a run writes, while it goes on: each writer is told of every time that is computed, of every
// day, and of the end. A run without [time] is a series of one time.

namespace quasimc {

/// The table of organs, or of organs and times (docs/formats/csv.md): comment lines that begin with
/// '#', one header line, one row per organ and time. The run must outlive it.
class CsvWriter {
  public:
    CsvWriter(const RunFile& run, TextSink sink);

    /// @param moment  which of moments_of(run) the result is of
    void add_moment(std::size_t time_step, const Result& result);

  private:
    void write_head(const Result& result);

    const RunFile& run_;
    TextSink sink_;
    std::vector<std::string> labels_;
    bool has_head_ = false;
};

/// The table of sums over days, of a run with [time]. The run must outlive it.
class DaysWriter {
  public:
    /// Writes what precedes the rows.
    DaysWriter(const RunFile& run, TextSink sink);

    void add_day(std::size_t day, const SeriesSum& sum);

  private:
    const RunFile& run_;
    TextSink sink_;
    std::vector<std::string> labels_;
};

/// Everything that is known of a run and its results (docs/formats/json.md). Days are kept in a
/// temporary file until all moments are written. The run must outlive it.
class JsonWriter {
  public:
    /// @param sink  without one nothing is written, and finish() gives the digest
    explicit JsonWriter(const RunFile& run, TextSink sink = {});
    ~JsonWriter() = default;
    JsonWriter(const JsonWriter&) = delete;
    JsonWriter& operator=(const JsonWriter&) = delete;

    /// @param traced  the moment whose trace the result was scaled from, or itself
    void add_moment(std::size_t time_step, const Result& result, std::size_t traced);
    void add_day(std::size_t day, const SeriesSum& sum);
    /// Ends the file. @returns the SHA-256 of the organs' parts of all moments, by which two
    /// results are compared
    std::string finish(const SeriesSummary& summary = {});

  private:
    void write_single_head(const Result& result);
    void write_moment_head(std::size_t time_step, const Result& result, std::size_t traced);
    void write_organs(const Result& result);
    void write_series_end(const SeriesSummary& summary);

    const RunFile& run_;
    bool writes_;
    JsonStream json_;
    Spool days_text_;
    JsonStream days_;
    Sha256 digest_;
    std::size_t time_steps_ = 0;
};

/// What a person wants to know at once of a run: ten lines or so. The run must outlive it.
class Summary {
  public:
    explicit Summary(const RunFile& run) : run_(run) {}

    void add_moment(const Result& result);
    /// @param written  the files that were written
    [[nodiscard]] std::string text(
        const SeriesSummary& summary, const std::vector<std::string>& written) const;

  private:
    const RunFile& run_;
    std::string result_lines_;  // of a run without [time]
};

// The same of the result of a run without [time].

void write_csv(const RunFile& run, const Result& result, const TextSink& sink);
/// @returns as JsonWriter::finish
std::string write_json(const RunFile& run, const Result& result, const TextSink& sink);
[[nodiscard]] std::string digest_of_organs(const RunFile& run, const Result& result);
[[nodiscard]] std::string summary(
    const RunFile& run, const Result& result, const std::vector<std::string>& written);

}  // namespace quasimc
