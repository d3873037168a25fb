#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <string>

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

}  // namespace quasimc
