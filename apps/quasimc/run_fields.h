#pragma once

#include <vector>

#include "io/results/field_formats.h"
#include "quasimc/quasimc.h"
#include "show_values.h"

/// The scene with the numbers that `quasimc run` writes for other programs: all that [output]
/// chooses, each with its standard error. Of a run with [time] the sum, of a sweep the last point.
class RunFields {
  public:
    explicit RunFields(const quasimc::RunFile& run) : run_(&run) {}

    void next_run(const quasimc::RunFile& run) { run_ = &run; }
    void add_moment(const quasimc::Result& result);
    /// @param summary  of the run
    [[nodiscard]] quasimc::FieldScene shown(const quasimc::SeriesSummary& summary) const;

  private:
    const quasimc::RunFile* run_;
    std::vector<ShownValues> last_;
};
