#include "window/window_sweep.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

#include "quasimc/error.h"

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

/// The points that were read last.
class PointCache {
  public:
    explicit PointCache(ReadPoint read) : read_(std::move(read)) {}

    const WindowFiles& files(std::size_t point) {
        const auto found = std::ranges::find(cached_, point, &Entry::first);
        if (found != cached_.end()) {
            return found->second;
        }
        constexpr std::size_t kMaxCached = 8;
        if (cached_.size() == kMaxCached) {
            cached_.pop_front();
        }
        cached_.emplace_back(point, files_of(read_(point)));
        return cached_.back().second;
    }

  private:
    using Entry = std::pair<std::size_t, WindowFiles>;
    ReadPoint read_;
    std::deque<Entry> cached_;
};

}  // namespace

WindowFiles files_of_sweep(std::size_t points, std::size_t shown, ReadPoint read) {
    const auto cache = std::make_shared<PointCache>(std::move(read));
    return [=](std::string_view name) -> std::optional<WindowFile> {
        const std::size_t point = take_point(name).value_or(shown);
        if (point >= points) {
            return std::nullopt;
        }
        try {
            return cache->files(point)(name);
        } catch (const InputError&) {
            return std::nullopt;  // the file was changed
        }
    };
}

}  // namespace quasimc
