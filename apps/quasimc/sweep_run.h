#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "base/process_time.h"
#include "checkpoint_run.h"
#include "interrupt.h"
#include "parallel/dealt_runs.h"
#include "parallel/part_file.h"
#include "progress.h"
#include "quasimc/quasimc.h"
#include "run/run_team.h"
#include "run_window.h"
#include "run_writers.h"

/// Computes the runs of a sweep, one after the other, until all are done, or Ctrl-C or the time
/// limit stops them.
class SweepRun final : private quasimc::SumsSource {
  public:
    /// @param parts  source of the sums of the runs; null: they are traced
    /// @param team  ranks that trace together; null: this one only
    /// @param reading  started when reading the files began
    SweepRun(
        const RunArguments& arguments,
        quasimc::RunSweep& sweep,
        quasimc::PartFiles* parts,
        quasimc::RunTeam* team,
        const quasimc::Stopwatch& reading);

    void compute();
    /// Serves the page of a finished run until Ctrl-C. A stopped run ends at once.
    void stay() const;

    /// The summary of all finished points. Its total is that of the last one.
    [[nodiscard]] const quasimc::SeriesSummary& all() const { return all_; }
    [[nodiscard]] const quasimc::SeriesSummary& last() const { return last_; }
    [[nodiscard]] const quasimc::RunFile& file() const { return *run_; }
    [[nodiscard]] RunWriters& writers() { return writers_; }
    [[nodiscard]] const CheckpointRun& checkpoint() const { return checkpoint_; }

  private:
    /// The run of a point; its time steps become the current ones.
    [[nodiscard]] std::unique_ptr<quasimc::RunFile> next_file(std::size_t point);
    /// Whether another point can begin.
    [[nodiscard]] bool goes_on();
    /// Traces a point. @returns false  if it has no result, but others have one
    [[nodiscard]] bool trace(const std::stop_token& stop);
    [[nodiscard]] std::vector<quasimc::RunListener*> listeners();
    /// The control of the run of this point: the remaining points share the remaining time.
    [[nodiscard]] quasimc::RunControl control(const std::stop_token& stop);
    /// The sums of the next run, from parts or from runs that are dealt out to the ranks. Runs in
    /// the checkpoint are not dealt out: all ranks trace them together.
    [[nodiscard]] std::optional<quasimc::GivenSums> sums_of(
        std::size_t time_step,
        const quasimc::RunSpec& spec,
        const quasimc::RunControl& control) override;

    const RunArguments& arguments_;
    quasimc::RunSweep& sweep_;
    quasimc::PartFiles* parts_;
    quasimc::RunTeam* team_;
    double reading_seconds_ = 0;  // for all points, before and between their runs
    std::size_t point_ = 0;
    std::size_t time_steps_before_ = 0;  // of the points before
    quasimc::Simulator simulator_;
    std::vector<quasimc::TimeStep> time_steps_;  // of the current point, set with run_
    std::unique_ptr<quasimc::RunFile> run_;
    RunWriters writers_;
    std::optional<InterruptWatch> interrupt_;  // before members with threads or files
    CheckpointRun checkpoint_;
    ProgressLine progress_line_;
    std::optional<RunWindow> window_;
    quasimc::Deadline deadline_;  // for all points
    quasimc::Work work_;          // for all points
    bool is_dealt_ = false;       // enough runs for all ranks
    std::unique_ptr<quasimc::DealtRuns> dealt_;
    quasimc::SeriesSummary last_, all_;
};
