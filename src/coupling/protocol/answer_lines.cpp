#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "coupling/protocol/messages.h"

namespace quasimc {

std::size_t MessageEndFinder::find(std::string_view bytes) {
    constexpr std::string_view kStart = "\nControl";
    const std::string_view first = kStart.substr(1);
    if (!in_control_ && offset_ == 0 && bytes.starts_with(first)) {
        in_control_ = true;
    }
    if (!in_control_) {
        const std::size_t begin = bytes.find(kStart, offset_);
        in_control_ = begin != std::string_view::npos;
        // Else the start may be there but for its last character.
        offset_ = in_control_ ? begin + 1 : bytes.size() - std::min(bytes.size(), first.size());
    }
    if (!in_control_) {
        return std::string_view::npos;
    }
    const std::size_t end = bytes.find('\n', offset_);
    offset_ = std::min(end, bytes.size());
    return end == std::string_view::npos ? end : end + 1;
}

std::size_t message_end(std::string_view bytes) {
    return MessageEndFinder().find(bytes);
}

namespace {

/// Appends the values with the given number of digits, in parentheses.
void append_values(
    std::string& text, std::size_t slots, std::span<const double> values, int digits) {
    std::array<char, 32> buffer{};
    for (std::size_t i = 0; i < slots; ++i) {
        text += i == 0 ? "(" : ",";
        if (i < values.size() && !std::isnan(values[i])) {
            const auto [end, error] = std::to_chars(
                buffer.data(), buffer.data() + buffer.size(), values[i], std::chars_format::general,
                digits);
            text.append(buffer.data(), end);
        }
    }
    text += ")\n";
}

}  // namespace

void append_answer(
    std::string& text, std::int64_t id, std::size_t slots, std::span<const double> values) {
    constexpr std::size_t kLongestLine = 255;
    constexpr int kDigits = 6;  // what %g writes
    const std::size_t begin = text.size();
    std::array<char, 24> buffer{};
    text.append(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), id).ptr);
    text += " E";
    const std::size_t before_values = text.size();
    for (int digits = kDigits; digits > 0; --digits) {
        text.resize(before_values);
        append_values(text, slots, values, digits);
        if (text.size() - begin <= kLongestLine) {
            return;
        }
    }
}

void append_control(std::string& text, ChunkPosition position) {
    constexpr std::array<std::string_view, 4> kFlags{"5", "1", "0", "4"};
    text += "Control: ";
    text += kFlags[static_cast<std::size_t>(position)];
    text += '\n';
}

}  // namespace quasimc
