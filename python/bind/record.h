#pragma once

// The results of runs in memory.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bind.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "replicates.h"

namespace quasimc::python {

/// The results of one run: an instant, or a series. Estimates are those that are reported, and sums
/// are in the units of files.
struct RunRecord {
    std::shared_ptr<const Scene> scene;
    RunSpec spec;
    std::optional<TimeSeries> series;
    std::vector<std::size_t> time_steps;                     ///< indices of those in `results`
    std::vector<std::size_t> computed;                       ///< as TimeStepResult::computed
    std::vector<std::shared_ptr<Result>> results;            ///< empty if they are not kept
    std::vector<std::shared_ptr<ReplicateSums>> replicates;  ///< per result; null: not kept
    std::vector<std::size_t> days;                           ///< indices of the days in `sums`
    std::vector<SeriesSum> sums;
    SeriesSummary summary;

    void add(const TimeStepResult& step);
    void add(std::size_t day, const SeriesSum& sum);
    void end(const SeriesSummary& of_run);
};

/// Reports a record to a writer, as its run did, without next_run() and finish().
/// @param scene  that of the writer: the same organs, perhaps in another order
/// @returns the summary of the run
/// @throws InputError  if the scene has other organs
SeriesSummary replay(const RunRecord& record, const Scene& scene, OutputWriter& writer);

/// Records the runs of a file.
class Recorder final : public OutputWriter {
  public:
    explicit Recorder(const RunFile& run) { begin(run); }

    void on_time_step(const TimeStepResult& step) override { runs_.back()->add(step); }
    void on_day(std::size_t day, const SeriesSum& sum) override { runs_.back()->add(day, sum); }
    void next_run(const RunFile& run, const SeriesSummary& summary) override {
        finish(summary);
        begin(run);
    }
    void finish(const SeriesSummary& summary) override;
    [[nodiscard]] bool wants(SeriesPart part) const override { return part != SeriesPart::sums; }

    /// By point.
    [[nodiscard]] const std::vector<std::shared_ptr<RunRecord>>& runs() const { return runs_; }

  private:
    void begin(const RunFile& run);

    const RunFile* run_ = nullptr;  // of the last record
    std::vector<std::shared_ptr<RunRecord>> runs_;
};

}  // namespace quasimc::python
