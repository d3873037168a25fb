#pragma once

#include <cstddef>
#include <string>

#include "quasimc/quasimc.h"
#include "show_values.h"

/// The picture that `quasimc run` draws: the light that organs absorb, in the first band, by the
/// view that `quasimc show` has if nothing is said. Of a run with [time] the sum, of a sweep the
/// last point.
class RunPicture {
  public:
    /// @throws quasimc::InputError  if the program was built without pictures, or the path names
    ///         another kind of file
    RunPicture(const quasimc::RunFile& run, const std::string& path, const std::string& place);

    void next_run(const quasimc::RunFile& run) { run_ = &run; }
    void add_moment(const quasimc::Result& result);
    /// The bytes of the file. @param summary  of the run
    [[nodiscard]] std::string draw(const quasimc::SeriesSummary& summary) const;

  private:
    const quasimc::RunFile* run_;
    ShownValues last_;
};
