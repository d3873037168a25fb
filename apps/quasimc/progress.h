#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "quasimc/run.h"

/// Where the progress of a run is printed.
enum class ProgressLines {
    none,
    on_terminal,  ///< in one line that is overwritten, if stderr is a terminal
    always,       ///< there, or else in separate lines, some seconds apart
};

/// " 37 %, 12 s of about 33 s".
[[nodiscard]] std::string describe_progress(const quasimc::Progress& progress);
/// Prints the progress of a run on stderr.
class ProgressLine final : public quasimc::RunListener {
  public:
    /// @param what  beginning of the line if it is no run: "reading points: "
    explicit ProgressLine(ProgressLines lines, std::string what = "");

    void on_progress(const quasimc::Progress& progress) override;
    [[nodiscard]] bool wants(quasimc::SeriesPart /*part*/) const override { return false; }
    [[nodiscard]] bool is_written() const { return on_terminal_ || in_lines_; }

  private:
    void add_line(const quasimc::Progress& progress);

    std::string what_;
    bool on_terminal_, in_lines_;
    double seconds_ = 0, fraction_ = 0;  // in the last line
};

/// Prints on stderr how many points of a sweep are read and checked; empty without progress lines.
[[nodiscard]] std::function<void(std::size_t read, std::size_t points)> points_line(
    ProgressLines lines);
/// Wipes the line on a terminal.
void end_progress_line();
