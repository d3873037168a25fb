#include "terminal.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include <unistd.h>

#include <fmt/format.h>
#include <sys/ioctl.h>

#include "base/shown_faults.h"
#include "base/text.h"
#include "text/numbers.h"

namespace {

/// A variable of the environment, or null. The program reads them before it starts threads.
const char* variable(const char* name) {
    return std::getenv(name);  // NOLINT(concurrency-mt-unsafe)
}

/// Whether standard error shows colours.
bool has_colors() {
    const char* refused = variable("NO_COLOR");
    const char* terminal = variable("TERM");
    return (refused == nullptr || *refused == '\0') && isatty(STDERR_FILENO) == 1 &&
           (terminal == nullptr || std::string_view(terminal) != "dumb");
}

void print_message(std::string_view word, int color, std::string_view text) {
    const std::string head =
        has_colors() ? fmt::format("\x1b[1;{}m{}:\x1b[0m", color, word) : fmt::format("{}:", word);
    std::fputs(fmt::format("{} {}\n", head, text).c_str(), stderr);
}

}  // namespace

std::size_t terminal_width() {
    constexpr std::int64_t kDefault = 80, kMin = 40, kMax = 1000000;
    const char* columns = variable("COLUMNS");
    if (const auto given = quasimc::parse_integer(columns != nullptr ? columns : "")) {
        return static_cast<std::size_t>(std::clamp(*given, kMin, kMax));
    }
    winsize size{};
    const bool is_known = ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return static_cast<std::size_t>(
        std::max<std::int64_t>(is_known ? size.ws_col : kDefault, kMin));
}

std::string folded(std::string_view text, std::size_t width, std::size_t indent, std::size_t used) {
    std::string lines;
    std::size_t column = used;
    bool is_first = true;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(' '), text.size());
        const std::string_view word = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (!is_first && column + 1 + word.size() > width) {
            lines += '\n' + std::string(indent, ' ');
            column = indent;
        } else if (!is_first) {
            lines += ' ';
            ++column;
        }
        lines += word;
        column += word.size();
        is_first = false;
    }
    return lines;
}

void print_error(std::string_view text) {
    constexpr int kRed = 31;
    print_message("error", kRed, text);
}

void print_errors(const quasimc::InputError& error) {
    for (const std::string& line : quasimc::shown_faults(error.faults())) {
        print_error(line);
    }
}

void print_warning(std::string_view text) {
    constexpr int kYellow = 33;
    print_message("warning", kYellow, quasimc::one_line(quasimc::printable(text)));
}
