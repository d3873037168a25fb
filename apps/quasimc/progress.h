#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "quasimc/run.h"

/// Where the progress of a run is told.
enum class ProgressLines {
    none,
    on_terminal,  ///< in one line that is written over, if stderr is a terminal
    always,       ///< there, and else in lines of their own, some seconds apart
};

/// " 37 %, 12 s of about 33 s".
[[nodiscard]] std::string progress_words(const quasimc::Progress& progress);
/// Tells on stderr how far the run is; empty if it is told nowhere.
/// @param what  stands before it, of what is no run: "reading points: "
[[nodiscard]] std::function<void(const quasimc::Progress&)> progress_line(
    ProgressLines lines, const std::string& what = "");
/// Tells on stderr how many points of a sweep are read and checked; empty if it is told nowhere.
[[nodiscard]] std::function<void(std::size_t read, std::size_t points)> points_line(
    ProgressLines lines);
/// Wipes the line on a terminal.
void end_progress_line();
