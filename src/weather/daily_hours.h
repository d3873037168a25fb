#pragma once

#include <string>
#include <vector>

#include "quasimc/source.h"

namespace quasimc {

/// Parts of every day, on the clock of whoever asks.
struct DailyHours {
    /// 0 to 24; one that ends before it begins goes on over midnight.
    struct Span {
        double from = 0, to = 24;
    };
    std::vector<Span> spans;  ///< that must not overlap

    /// Whether two spans have a time in common.
    [[nodiscard]] bool overlap() const;

    /// The share of a time that lies within; of an instant (0 seconds) 0 or 1. A span holds its
    /// beginning, not its end.
    [[nodiscard]] double share(const CivilTime& start, double seconds) const;
    /// "from 6 to 10 h, from 16 to 22 h"
    [[nodiscard]] std::string words() const;
};

}  // namespace quasimc
