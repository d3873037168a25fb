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

void show(const std::string& what, const quasimc::Progress& progress) {
    constexpr double kSoon = 1;  // seconds; shorter runs need no line
    if (progress.expected_seconds >= kSoon) {
        std::fprintf(stderr, "\r%s%s\x1b[K", what.c_str(), progress_words(progress).c_str());
        std::fflush(stderr);
    }
}

/// For a log: a line, and the next when much more is done or after a while.
class LogLines {
  public:
    explicit LogLines(std::string what) : what_(std::move(what)) {}
    void operator()(const quasimc::Progress& progress) {
        constexpr double kMuch = 0.05, kWhile = 10;
        constexpr double kLeast = 1;  // seconds between lines
        const double since = progress.seconds - seconds_;
        const bool is_due = progress.fraction - fraction_ >= kMuch || since >= kWhile;
        if (is_due && since >= kLeast) {
            std::fprintf(stderr, "%s%s\n", what_.c_str(), progress_words(progress).c_str());
            seconds_ = progress.seconds;
            fraction_ = progress.fraction;
        }
    }

  private:
    std::string what_;
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

std::function<void(const quasimc::Progress&)> progress_line(
    ProgressLines lines, const std::string& what) {
    if (lines != ProgressLines::none && is_shown()) {
        return [what](const quasimc::Progress& progress) { show(what, progress); };
    }
    return lines == ProgressLines::always ? LogLines(what)
                                          : std::function<void(const quasimc::Progress&)>();
}

std::function<void(std::size_t, std::size_t)> points_line(ProgressLines lines) {
    const auto tell = progress_line(lines, "reading points: ");
    if (!tell) {
        return {};
    }
    return [tell, watch = quasimc::Stopwatch()](std::size_t read, std::size_t points) {
        const double fraction = static_cast<double>(read) / static_cast<double>(points);
        if (read > 0) {
            tell({fraction, watch.seconds(), watch.seconds() / fraction, 0});
        }
    };
}

void end_progress_line() {
    if (is_shown()) {
        std::fputs("\r\x1b[K", stderr);
    }
}
