#pragma once

#include <functional>

#include "quasimc/run.h"

/// A line on stderr that tells how far the run is; nothing when stderr is no terminal.
[[nodiscard]] std::function<void(const quasimc::Progress&)> progress_line();
/// Wipes that line.
void end_progress_line();
