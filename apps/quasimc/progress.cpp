#include "progress.h"

#include <cstdio>
#include <string>
#include <utility>

#include <unistd.h>

#include <fmt/format.h>

#include "base/process_time.h"

namespace {

bool is_shown() {
    return ::isatty(STDERR_FILENO) != 0;
}

}  // namespace

std::string describe_progress(const quasimc::Progress& progress) {
    std::string text = fmt::format(
        "{:3.0f} %, {:.0f} s of about {:.0f} s", 100 * progress.fraction, progress.seconds,
        progress.expected_seconds);
    if (progress.fraction_at_target > 0) {
        text += fmt::format(", {:.1f} % at the target", 100 * progress.fraction_at_target);
    }
    return text;
}

ProgressLine::ProgressLine(ProgressLines lines, std::string what)
    : what_(std::move(what)),
      on_terminal_(lines != ProgressLines::none && is_shown()),
      in_lines_(lines == ProgressLines::always && !is_shown()) {}

void ProgressLine::on_progress(const quasimc::Progress& progress) {
    constexpr double kSoon = 1;  // seconds; shorter runs need no line
    if (on_terminal_ && progress.expected_seconds >= kSoon) {
        std::fprintf(stderr, "\r%s%s\x1b[K", what_.c_str(), describe_progress(progress).c_str());
        std::fflush(stderr);
    }
    if (in_lines_) {
        add_line(progress);
    }
}

/// For a log: a line, and the next when much more is done or after a while.
void ProgressLine::add_line(const quasimc::Progress& progress) {
    constexpr double kMuch = 0.05, kWhile = 10;
    constexpr double kMinInterval = 1;  // seconds between lines
    const double since = progress.seconds - seconds_;
    const bool is_due = progress.fraction - fraction_ >= kMuch || since >= kWhile;
    if (is_due && since >= kMinInterval) {
        std::fprintf(stderr, "%s%s\n", what_.c_str(), describe_progress(progress).c_str());
        seconds_ = progress.seconds;
        fraction_ = progress.fraction;
    }
}

std::function<void(std::size_t, std::size_t)> points_line(ProgressLines lines) {
    ProgressLine line(lines, "reading points: ");
    if (!line.is_written()) {
        return {};
    }
    return [line, watch = quasimc::Stopwatch()](std::size_t read, std::size_t points) mutable {
        const double fraction = static_cast<double>(read) / static_cast<double>(points);
        if (read > 0) {
            line.on_progress({fraction, watch.seconds(), watch.seconds() / fraction, 0});
        }
    };
}

void end_progress_line() {
    if (is_shown()) {
        std::fputs("\r\x1b[K", stderr);
    }
}
