#include "text/line_scanner.h"

namespace quasimc {

std::string rest_of_line(std::string_view line) {
    std::string text;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line)) {
        text += (text.empty() ? "" : " ") + std::string(word);
    }
    return text;
}

}  // namespace quasimc
