#include "io/line_scanner.h"

#include <algorithm>
#include <string>

namespace quasimc {

std::string shown(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    std::string text;
    for (const char c : word.substr(0, kLongest)) {
        const bool printable = c >= ' ' && c <= '~';
        text += printable ? c : '?';
    }
    return "'" + text + (word.size() > kLongest ? "...'" : "'");
}

std::string rest_of_line(std::string_view line) {
    std::string text;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        text += (text.empty() ? "" : " ") + std::string(word);
    }
    return text;
}

std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
    return text;
}

bool is_utf8(std::string_view text) {
    std::size_t i = 0;
    while (i < text.size()) {
        const auto lead = static_cast<unsigned char>(text[i]);
        const std::size_t extra = lead < 0x80   ? 0
                                  : lead < 0xC2 ? 9
                                  : lead < 0xE0 ? 1
                                  : lead < 0xF0 ? 2
                                  : lead < 0xF5 ? 3
                                                : 9;
        if (extra == 9 || i + extra >= text.size()) {
            return false;
        }
        for (std::size_t k = 1; k <= extra; ++k) {
            if ((static_cast<unsigned char>(text[i + k]) & 0xC0) != 0x80) {
                return false;
            }
        }
        i += extra + 1;
    }
    return true;
}

}  // namespace quasimc
