#pragma once

// A part of a run, for one machine of many.

#include <cstdint>
#include <utility>

namespace quasimc {

/// The tasks of a run from the fraction first / of to the fraction last / of. The contribution of a
/// task to the sums is exact and depends only on its number. So shares that contain every task once
/// add up to the sums of the whole run, bit for bit (Sums::add_share).
struct Share {
    std::uint64_t first = 0, last = 1, of = 1;  ///< first < last <= of

    [[nodiscard]] bool is_whole() const { return first == 0 && last == of; }
    /// The tasks [begin, end) of `tasks`.
    [[nodiscard]] std::pair<std::uint64_t, std::uint64_t> range(std::uint64_t tasks) const {
        return {until(tasks, first), until(tasks, last)};
    }
    friend bool operator==(const Share&, const Share&) = default;

  private:
    /// tasks * n / of, rounded down, n <= of.
    [[nodiscard]] std::uint64_t until(std::uint64_t tasks, std::uint64_t n) const;
};

/// One of `parts` equal shares. @param part  counted from 1
[[nodiscard]] constexpr Share share_of(std::uint64_t part, std::uint64_t parts) {
    return {part - 1, part, parts};
}

}  // namespace quasimc
