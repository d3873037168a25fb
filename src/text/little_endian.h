#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>

namespace quasimc {

/// Appends a number, lowest byte first.
template <typename T>
void append_little_endian(std::string& bytes, T number) {
    auto raw = std::bit_cast<std::array<char, sizeof(T)>>(number);
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(raw.begin(), raw.end());
    }
    bytes.append(raw.begin(), raw.end());
}

/// The number with bytes from `at` on, lowest first; all bytes must be in range.
template <typename T>
[[nodiscard]] T little_endian_at(std::string_view bytes, std::size_t at) {
    std::array<char, sizeof(T)> raw{};
    std::memcpy(raw.data(), bytes.data() + at, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) {
        std::reverse(raw.begin(), raw.end());
    }
    return std::bit_cast<T>(raw);
}

}  // namespace quasimc
