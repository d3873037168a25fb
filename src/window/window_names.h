#pragma once

#include <array>
#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <system_error>

namespace quasimc {

inline constexpr std::string_view kJsonType = "application/json";
inline constexpr std::string_view kBytesType = "application/octet-stream";

/// The numbers in a name such as "values-3-17"; nothing for other words, or if there are not Count
/// numbers. @param word  "values"
template <std::size_t Count>
[[nodiscard]] std::optional<std::array<std::uint64_t, Count>> numbers_behind(
    std::string_view word, std::string_view name) {
    if (!name.starts_with(word)) {
        return std::nullopt;
    }
    name.remove_prefix(word.size());
    std::array<std::uint64_t, Count> numbers{};
    for (std::uint64_t& number : numbers) {
        if (!name.starts_with('-')) {
            return std::nullopt;
        }
        name.remove_prefix(1);
        const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), number);
        if (error != std::errc()) {
            return std::nullopt;
        }
        name.remove_prefix(static_cast<std::size_t>(end - name.data()));
    }
    return name.empty() ? std::optional(numbers) : std::nullopt;
}

}  // namespace quasimc
