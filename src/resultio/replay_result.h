#pragma once

#include <string>
#include <string_view>

#include "quasimc/result_file.h"
#include "quasimc/run_file.h"

namespace quasimc {

/// Reports the light in a JSON result to a writer as the run did that wrote it: time steps and days
/// with on_time_step() and on_day(), points of a sweep with next_run(), and finish(). Sums are in
/// the units of files. Numbers that the file lacks are NaN. Time steps that it lacks are left out,
/// except nights, whose light is 0. With [time], outcomes of [[control]] are set in the
/// run before its first time step.
/// @param path   for messages
/// @param runs   of the result (read_result_text)
/// @param first  its first run, which the writer was made for
/// @throws InputError  if it is not JSON, holds no light of organs or sensors, or has times or
/// points that the runs lack
void replay_result(
    std::string_view text,
    const std::string& path,
    RunSweep& runs,
    RunFile& first,
    OutputWriter& writer);

}  // namespace quasimc
