#pragma once

#include <cstddef>
#include <string>

#include "io/runfile/run_file.h"
#include "io/sha256.h"
#include "io/text_sink.h"
#include "run/series.h"

// The results of a run with [time], written while it goes on.

namespace quasimc {

/// The table of organs and times (docs/formats/csv.md): what precedes its rows, and those of a
/// moment.
void write_series_csv_head(const RunFile& run, const TextSink& sink);
void write_series_csv_moment(
    const RunFile& run, std::size_t time_step, const Result& result, const TextSink& sink);

/// The table of sums over days: what precedes its rows, and those of a day.
void write_days_head(const RunFile& run, const TextSink& sink);
void write_days_day(
    const RunFile& run, std::size_t day, const SeriesSum& sum, const TextSink& sink);

/// The result in JSON (docs/formats/json.md): every moment, and sums over days and in all.
class SeriesJson {
  public:
    SeriesJson(const RunFile& run, TextSink sink);

    void add_moment(std::size_t time_step, const Result& result, std::size_t traced);
    void add_day(std::size_t day, const SeriesSum& sum);
    /// Ends the file. @returns the SHA-256 of the organs' parts of all moments
    std::string finish(const SeriesSummary& summary);

  private:
    void write_organs(const std::string& text);

    const RunFile& run_;
    TextSink sink_;
    Sha256 digest_;
    std::size_t time_steps_ = 0;
    std::string days_;
};

/// What a person wants to know at once of a series.
[[nodiscard]] std::string series_summary(
    const RunFile& run, const SeriesSummary& summary, const std::vector<std::string>& written);

}  // namespace quasimc
