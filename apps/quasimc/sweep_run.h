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

/// Computes the runs of a sweep, one after the other, until all are done or Ctrl-C or the limit of
/// time stops them.
class SweepRun final : private quasimc::SumsSource {
  public:
    /// @param parts  which the sums of the runs are taken from; null: they are traced
    /// @param team  which they are traced with; null: alone
    /// @param reading  since the files began to be read
    SweepRun(
        const RunArguments& arguments,
        quasimc::RunSweep& sweep,
        quasimc::PartFiles* parts,
        quasimc::RunTeam* team,
        const quasimc::Stopwatch& reading);

    void compute();
    /// The page stays for who wants to see the result. One who has stopped the run wants to leave.
    void stay() const;

    /// Of all points that are done. Its total is that of the last one.
    [[nodiscard]] const quasimc::SeriesSummary& all() const { return all_; }
    [[nodiscard]] const quasimc::SeriesSummary& last() const { return last_; }
    [[nodiscard]] const quasimc::RunFile& file() const { return *run_; }
    [[nodiscard]] RunWriters& writers() { return writers_; }
    [[nodiscard]] const CheckpointRun& checkpoint() const { return checkpoint_; }

  private:
    [[nodiscard]] std::unique_ptr<quasimc::RunFile> next_file(std::size_t point);
    /// Whether there is time for another point.
    [[nodiscard]] bool goes_on();
    /// Traces a point. @returns false  if there is no result of it, and others are there
    [[nodiscard]] bool trace(const std::stop_token& stop);
    [[nodiscard]] std::vector<quasimc::RunListener*> listeners();
    /// How the run of this point is reported and ended: the points that are left share the time.
    [[nodiscard]] quasimc::RunControl control(const std::stop_token& stop);
    /// The sums of the next run, of parts or of runs that are dealt out to the ranks. These begin
    /// with the first that no checkpoint knows: what it knows is traced together.
    [[nodiscard]] std::optional<quasimc::GivenSums> sums_of(
        std::size_t time_step,
        const quasimc::RunSpec& spec,
        const quasimc::RunControl& control) override;

    const RunArguments& arguments_;
    quasimc::RunSweep& sweep_;
    quasimc::PartFiles* parts_;
    quasimc::RunTeam* team_;
    double reading_seconds_ = 0;  // of all points, before and between their runs
    std::size_t point_ = 0;
    std::size_t time_steps_before_ = 0;  // of the points before
    std::unique_ptr<quasimc::RunFile> run_;
    RunWriters writers_;
    std::optional<InterruptWatch> interrupt_;  // before what has threads and what is left behind
    CheckpointRun checkpoint_;
    ProgressLine progress_line_;
    std::optional<RunWindow> window_;
    quasimc::Simulator simulator_;
    quasimc::Deadline deadline_;                 // of all points
    quasimc::Work work_;                         // of all points
    std::vector<quasimc::TimeStep> time_steps_;  // of the point
    bool is_dealt_ = false;                      // enough runs for all ranks
    std::unique_ptr<quasimc::DealtRuns> dealt_;
    quasimc::SeriesSummary last_, all_;
};
