#include "numbered_path.h"

#include <fmt/format.h>

std::optional<std::string> numbered_path(const std::string& path, std::int64_t step) {
    const std::size_t name = path.rfind('/') + 1;  // 0 without a folder
    const std::size_t percent = path.find('%', name);
    const std::size_t end = path.find_first_not_of("0123456789", percent + 1);
    constexpr std::size_t kMaxDigits = 2;
    if (percent == std::string::npos || end == std::string::npos || path[end] != 'd' ||
        end - percent - 1 > kMaxDigits) {
        return std::nullopt;
    }
    const std::string width = path.substr(percent + 1, end - percent - 1);
    const bool has_zeros = width.starts_with('0');
    const std::size_t length = width.empty() ? 0 : std::stoul(width);
    const std::string number =
        has_zeros ? fmt::format("{:0{}}", step, length) : fmt::format("{:{}}", step, length);
    return path.substr(0, percent) + number + path.substr(end + 1);
}
