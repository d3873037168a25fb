#include "progress.h"

#include <cstdio>

#include <unistd.h>

namespace {

bool is_shown() {
    return ::isatty(STDERR_FILENO) != 0;
}

void show(const quasimc::Progress& progress) {
    constexpr double kSoon = 1;  // seconds; shorter runs need no line
    if (progress.expected_seconds < kSoon) {
        return;
    }
    std::fprintf(
        stderr, "\r%3.0f %%, %.0f s of about %.0f s", 100 * progress.fraction, progress.seconds,
        progress.expected_seconds);
    if (progress.fraction_at_target > 0) {
        std::fprintf(
            stderr, ", %.1f %% of the organs at the target", 100 * progress.fraction_at_target);
    }
    std::fputs("\x1b[K", stderr);
    std::fflush(stderr);
}

}  // namespace

std::function<void(const quasimc::Progress&)> progress_line() {
    return is_shown() ? show : std::function<void(const quasimc::Progress&)>();
}

void end_progress_line() {
    if (is_shown()) {
        std::fputs("\r\x1b[K", stderr);
    }
}
