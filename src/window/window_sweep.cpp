#include "window/window_sweep.h"

#include <charconv>
#include <optional>
#include <string_view>
#include <utility>

namespace quasimc {
namespace {

/// Reads "point-K-" at the beginning of a name, and leaves the rest.
std::optional<std::size_t> take_point(std::string_view& name) {
    constexpr std::string_view kWord = "point-";
    if (!name.starts_with(kWord)) {
        return std::nullopt;
    }
    std::size_t number = 0;
    const char* const begin = name.data() + kWord.size();
    const char* const end = name.data() + name.size();
    const auto [after, error] = std::from_chars(begin, end, number);
    if (error != std::errc() || after == end || *after != '-') {
        return std::nullopt;
    }
    name.remove_prefix(static_cast<std::size_t>(after + 1 - name.data()));
    return number;
}

}  // namespace

WindowFiles files_of_sweep(std::vector<WindowData> points) {
    std::vector<WindowFiles> all;
    all.reserve(points.size());
    for (WindowData& point : points) {
        all.push_back(files_of(std::move(point)));
    }
    return [all = std::move(all)](std::string_view name) -> std::optional<WindowFile> {
        const std::size_t point = take_point(name).value_or(0);
        return point < all.size() ? all[point](name) : std::nullopt;
    };
}

}  // namespace quasimc
