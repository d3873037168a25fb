#pragma once

#include <string>
#include <vector>

#include "quasimc/source.h"

namespace quasimc {

/// Parts of every day, in the local time of the argument.
struct DailyHours {
    /// Hours, 0 to 24; a span that ends before it begins includes midnight.
    struct Span {
        double from = 0, to = 24;
    };
    std::vector<Span> spans;  ///< without overlaps

    /// Whether two spans have a time in common.
    [[nodiscard]] bool overlap() const;

    /// The fraction of an interval within the spans; 0 or 1 for an instant (0 seconds). A span
    /// includes its beginning, not its end.
    [[nodiscard]] double share(const CivilTime& start, double seconds) const;
    /// "from 6 to 10 h, from 16 to 22 h"
    [[nodiscard]] std::string describe() const;
};

}  // namespace quasimc
