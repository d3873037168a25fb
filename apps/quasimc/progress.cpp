#include "progress.h"

#include <cstdio>
#include <string>

#include <unistd.h>

#include <fmt/format.h>

namespace {

bool is_shown() {
    return ::isatty(STDERR_FILENO) != 0;
}

void show(const quasimc::Progress& progress) {
    constexpr double kSoon = 1;  // seconds; shorter runs need no line
    if (progress.expected_seconds >= kSoon) {
        std::fprintf(stderr, "\r%s\x1b[K", progress_words(progress).c_str());
        std::fflush(stderr);
    }
}

/// For a log: a line, and the next when much more is done or after a while.
class LogLines {
  public:
    void operator()(const quasimc::Progress& progress) {
        constexpr double kMuch = 0.05, kWhile = 10;
        constexpr double kLeast = 1;  // seconds between lines
        const double since = progress.seconds - seconds_;
        const bool is_due = progress.fraction - fraction_ >= kMuch || since >= kWhile;
        if (is_due && since >= kLeast) {
            std::fprintf(stderr, "%s\n", progress_words(progress).c_str());
            seconds_ = progress.seconds;
            fraction_ = progress.fraction;
        }
    }

  private:
    double seconds_ = 0, fraction_ = 0;
};

}  // namespace

std::string progress_words(const quasimc::Progress& progress) {
    std::string text = fmt::format(
        "{:3.0f} %, {:.0f} s of about {:.0f} s", 100 * progress.fraction, progress.seconds,
        progress.expected_seconds);
    if (progress.fraction_at_target > 0) {
        text += fmt::format(
            ", {:.1f} % of the organs at the target", 100 * progress.fraction_at_target);
    }
    return text;
}

std::function<void(const quasimc::Progress&)> progress_line(ProgressLines lines) {
    if (lines != ProgressLines::none && is_shown()) {
        return show;
    }
    return lines == ProgressLines::always ? LogLines()
                                          : std::function<void(const quasimc::Progress&)>();
}

void end_progress_line() {
    if (is_shown()) {
        std::fputs("\r\x1b[K", stderr);
    }
}
