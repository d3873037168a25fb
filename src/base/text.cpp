#include "base/text.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace quasimc {
namespace {

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Optimal string alignment distance, ignoring case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            d[i][j] =
                std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same ? 0 : 1)});
            const bool swapped = i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) &&
                                 lower(a[i - 2]) == lower(b[j - 1]);
            if (swapped) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

/// Number of bytes of the first character of a non-empty text; 0 if it is not UTF-8. Overlong forms
/// and surrogates are invalid (Unicode 15, table 3-7).
std::size_t character_size(std::string_view text) {
    const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned lead = byte(0);
    if (lead < 0x80) {
        return 1;
    }
    const std::size_t size = lead < 0xC2   ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
    if (size == 0 || text.size() < size) {
        return 0;
    }
    for (std::size_t i = 1; i < size; ++i) {
        const unsigned low = i > 1 ? 0x80 : lead == 0xE0 ? 0xA0 : lead == 0xF0 ? 0x90 : 0x80;
        const unsigned high = i > 1 ? 0xBF : lead == 0xED ? 0x9F : lead == 0xF4 ? 0x8F : 0xBF;
        if (byte(i) < low || byte(i) > high) {
            return 0;
        }
    }
    return size;
}

/// Whether a character of UTF-8 is a control character (C0, DEL or C1).
bool is_control(std::string_view character) {
    const auto first = static_cast<unsigned char>(character.front());
    return first < 0x20 || first == 0x7F ||
           (first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
}

/// Replaces each character, and each invalid byte, of a text.
/// @param replace  gives the replacement of a character; its second argument: whether it is UTF-8
template <typename Replace>
std::string replaced(std::string_view text, Replace replace) {
    std::string out;
    out.reserve(text.size());
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        const std::string_view character = text.substr(0, std::max<std::size_t>(size, 1));
        out += replace(character, size > 0);
        text.remove_prefix(character.size());
    }
    return out;
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> candidates) {
    constexpr std::size_t kLongestWord = 64;
    if (word.empty() || word.size() > kLongestWord) {
        return {};
    }
    std::string_view best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string_view candidate : candidates) {
        const std::size_t distance = edit_distance(word, candidate);
        if (distance < best_distance && distance < candidate.size()) {
            best = candidate;
            best_distance = distance;
        }
    }
    return best;
}

std::string near_word_text(std::string_view word, std::span<const std::string_view> candidates) {
    const std::string_view best = nearest_word(word, candidates);
    return best.empty() ? "" : fmt::format("did you mean '{}'?", best);
}

std::string did_you_mean(std::string_view word, std::span<const std::string_view> candidates) {
    std::string near = near_word_text(word, candidates);
    if (!near.empty()) {
        return near;
    }
    return candidates.empty() ? std::string() : "use one of " + joined(candidates, ", ");
}

std::string shortest(double value) {
    return fmt::format("{}", value);
}

std::string lower_case(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(), lower);
    return out;
}

std::string_view trimmed(std::string_view text) {
    const auto is_blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && is_blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

bool is_utf8(std::string_view text) {
    while (!text.empty()) {
        const std::size_t size = character_size(text);
        if (size == 0) {
            return false;
        }
        text.remove_prefix(size);
    }
    return true;
}

std::string printable(std::string_view text) {
    return replaced(text, [](std::string_view character, bool is_good) {
        const std::string_view blank = " ", mark = "?";
        return !is_good ? mark : is_control(character) && character != "\n" ? blank : character;
    });
}

std::string one_line(std::string_view text) {
    return replaced(text, [](std::string_view character, bool is_good) {
        return is_good && is_control(character) ? std::string_view(" ") : character;
    });
}

std::string shown(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    std::string text;
    for (const char c : word.substr(0, kLongest)) {
        const bool is_plain = c >= ' ' && c <= '~';
        text += is_plain ? c : '?';
    }
    return "'" + text + (word.size() > kLongest ? "...'" : "'");
}

std::string joined(std::span<const std::string_view> items, std::string_view separator) {
    return fmt::format("{}", fmt::join(items, separator));
}

}  // namespace quasimc
