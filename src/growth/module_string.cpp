#include "growth/module_string.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace quasimc {
namespace {

constexpr bool is_bracket(char symbol) {
    return symbol == '[' || symbol == ']';
}

/// Appends a number as by "%g". @returns the number of characters
std::size_t append_number(std::string& text, float value) {
    constexpr int kDigits = 6;
    std::array<char, 32> buffer{};
    const auto written = std::to_chars(
        buffer.data(), buffer.data() + buffer.size(), static_cast<double>(value),
        std::chars_format::general, kDigits);
    const auto size = static_cast<std::size_t>(written.ptr - buffer.data());
    text.append(buffer.data(), size);
    return size;
}

}  // namespace

void ModuleString::enlarge(std::size_t words) {
    constexpr std::size_t kLeast = 64;
    words_.resize(std::max({words, 2 * words_.size(), kLeast}));
}

void ModuleString::append(char symbol, std::span<const double> parameters) {
    const Position p = end_;
    const bool has_link = has_link_word(symbol, parameters.size());
    const auto count = static_cast<std::uint32_t>(parameters.size());
    const std::uint32_t size = 1 + (has_link ? 1 : 0) + count;
    reserve(std::size_t{p} + size);
    std::uint32_t* word = words_.data() + p;
    *word++ = static_cast<unsigned char>(symbol) | count << 8U | size << 16U | last_size_ << 24U;
    if (has_link) {
        *word++ = kNone;
    }
    for (const double value : parameters) {
        *word++ = std::bit_cast<std::uint32_t>(static_cast<float>(value));
    }
    end_ = p + size;
    last_size_ = size;
    ++size_;
    if (has_link) {
        link(p);
    }
}

void ModuleString::append_from(const ModuleString& other, Position p) {
    const Position here = end_;
    const std::uint32_t* module = other.words_.data() + p;
    const std::uint32_t size = size_of(*module);
    reserve(std::size_t{here} + size);
    std::uint32_t* word = words_.data() + here;
    *word = (*module & 0x00FFFFFFU) | last_size_ << 24U;
    for (std::uint32_t i = 1; i < size; ++i) {
        word[i] = module[i];
    }
    end_ = here + size;
    last_size_ = size;
    ++size_;
    if (is_bracket(other.symbol(p))) {
        words_[here + 1] = kNone;
        link(here);
    }
}

void ModuleString::append_all(const ModuleString& other) {
    for (Position p = begin(); p < other.end(); p = other.next(p)) {
        append_from(other, p);
    }
}

void ModuleString::link(Position p) {
    if (symbol(p) == '[') {
        open_.push_back(p);
    } else if (symbol(p) == ']' && !open_.empty()) {
        words_[p + 1] = open_.back();
        words_[open_.back() + 1] = p;
        open_.pop_back();
    }
}

void ModuleString::clear() {
    end_ = 0;
    open_.clear();
    size_ = 0;
    last_size_ = 0;
}

std::string ModuleString::text() const {
    return written(kNoBreaks);
}

std::string ModuleString::lines() const {
    constexpr std::size_t kLineLength = 70;
    return written(kLineLength) + "\n";
}

std::string ModuleString::written(std::size_t length) const {
    std::string text;
    text.reserve(2 * std::size_t{end_});
    std::size_t on_line = 0;  // commas are not counted
    for (Position p = begin(); p < end(); p = next(p)) {
        if (on_line >= length) {
            text += '\n';
            on_line = 0;
        }
        text += symbol(p);
        ++on_line;
        const std::size_t n = count(p);
        for (std::size_t i = 0; i < n; ++i) {
            text += i == 0 ? '(' : ',';
            on_line += append_number(text, parameter(p, i));
        }
        if (n > 0) {
            text += ')';
            on_line += 2;
        }
    }
    return text;
}

}  // namespace quasimc
