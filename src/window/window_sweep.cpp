#include "window/window_sweep.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <memory>
#include <string_view>
#include <utility>

#include "quasimc/error.h"

namespace quasimc {
namespace {

/// A point, and the one that is subtracted.
struct PointKey {
    std::size_t point = 0;
    std::optional<std::size_t> minus = {};
    friend bool operator==(const PointKey&, const PointKey&) = default;
};

/// Reads "WORD-K-" at the beginning of a name, and leaves the rest.
std::optional<std::size_t> take_number(std::string_view& name, std::string_view word) {
    if (!name.starts_with(word)) {
        return std::nullopt;
    }
    std::size_t number = 0;
    const char* const begin = name.data() + word.size();
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

    const WindowFiles& files(const PointKey& key) {
        const auto found = std::ranges::find(cached_, key, &Entry::first);
        if (found != cached_.end()) {
            return found->second;
        }
        constexpr std::size_t kMaxCached = 8;
        if (cached_.size() == kMaxCached) {
            cached_.pop_front();
        }
        cached_.emplace_back(key, files_of(read_(key.point, key.minus)));
        return cached_.back().second;
    }

  private:
    using Entry = std::pair<PointKey, WindowFiles>;
    ReadPoint read_;
    std::deque<Entry> cached_;
};

}  // namespace

WindowFiles files_of_sweep(std::size_t points, std::size_t shown, ReadPoint read) {
    const auto cache = std::make_shared<PointCache>(std::move(read));
    return [=](std::string_view name) -> std::optional<WindowFile> {
        PointKey key{take_number(name, "point-").value_or(shown)};
        key.minus = take_number(name, "minus-");
        if (key.point >= points || key.minus.value_or(0) >= points) {
            return std::nullopt;
        }
        try {
            return cache->files(key)(name);
        } catch (const InputError&) {
            return std::nullopt;  // two points without a common organ, or a changed file
        }
    };
}

}  // namespace quasimc
