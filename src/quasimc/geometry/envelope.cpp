#include "quasimc/geometry/envelope.h"

#include <algorithm>
#include <limits>
#include <span>

namespace quasimc {
namespace {

constexpr double kEnd = std::numeric_limits<double>::infinity();

/// The part of a piece between two places in it.
LinePiece part(const LinePiece& piece, double low, double high) {
    return {low, high, piece.depth(low), piece.depth(high), piece.segment};
}

/// Appends a piece, as one with the last if it goes on with the same segment.
void append(std::vector<LinePiece>& out, std::size_t first, const LinePiece& piece) {
    if (out.size() > first && out.back().segment == piece.segment && out.back().high == piece.low) {
        out.back().high = piece.high;
        out.back().depth_high = piece.depth_high;
    } else {
        out.push_back(piece);
    }
}

/// Appends the nearer of two pieces between two places that both cover.
template <typename Append>
void append_nearer(
    const LinePiece& a, const LinePiece& b, double low, double high, const Append& put) {
    const double at_low = a.depth(low) - b.depth(low);
    const double at_high = a.depth(high) - b.depth(high);
    if (at_low <= 0 && at_high <= 0) {
        put(part(a, low, high));
    } else if (at_low >= 0 && at_high >= 0) {
        put(part(b, low, high));
    } else {
        const double crossing =
            std::clamp(low + (high - low) * (at_low / (at_low - at_high)), low, high);
        const LinePiece& first = at_low < 0 ? a : b;
        const LinePiece& second = at_low < 0 ? b : a;
        if (crossing > low) {
            put(part(first, low, crossing));
        }
        if (crossing < high) {
            put(part(second, crossing, high));
        }
    }
}

/// Walks along two envelopes at once, and puts what is nearer of the two.
template <typename Append>
void merge(std::span<const LinePiece> a, std::span<const LinePiece> b, const Append& put) {
    std::size_t i = 0;
    std::size_t j = 0;
    double x = -kEnd;
    while (i < a.size() && j < b.size()) {
        const double low_a = std::max(a[i].low, x);
        const double low_b = std::max(b[j].low, x);
        x = std::min(low_a, low_b);
        double next = 0;
        if (low_a > x) {
            next = std::min(b[j].high, low_a);
            put(part(b[j], x, next));
        } else if (low_b > x) {
            next = std::min(a[i].high, low_b);
            put(part(a[i], x, next));
        } else {
            next = std::min(a[i].high, b[j].high);
            append_nearer(a[i], b[j], x, next, put);
        }
        i += a[i].high <= next ? 1 : 0;
        j += b[j].high <= next ? 1 : 0;
        x = next;
    }
    for (; i < a.size(); ++i) {
        put(part(a[i], std::max(a[i].low, x), a[i].high));
    }
    for (; j < b.size(); ++j) {
        put(part(b[j], std::max(b[j].low, x), b[j].high));
    }
}

}  // namespace

const std::vector<LinePiece>& Envelope::of(std::vector<LinePiece>& segments) {
    std::sort(segments.begin(), segments.end(), [](const LinePiece& a, const LinePiece& b) {
        return a.low != b.low ? a.low < b.low : a.segment < b.segment;
    });
    from_.swap(segments);
    double length = 0;
    double end = from_.empty() ? 0 : from_.front().high;
    for (const LinePiece& segment : from_) {
        length += segment.high - segment.low;
        end = std::max(end, segment.high);
    }
    constexpr double kFewOverEachOther = 16;
    if (from_.empty() || length < kFewOverEachOther * (end - from_.front().low)) {
        sweep();
    } else {
        merge_by_halves();
    }
    return from_;
}

void Envelope::sweep() {
    to_.clear();
    here_.clear();
    std::size_t next = 0;
    double x = 0;
    while (next < from_.size() || !here_.empty()) {
        x = here_.empty() ? from_[next].low : x;
        for (; next < from_.size() && from_[next].low <= x; ++next) {
            here_.emplace_back(from_[next]);
        }
        double until = next < from_.size() ? from_[next].low : kEnd;
        for (const Here& here : here_) {
            until = std::min(until, here.segment->high);
        }
        if (here_.size() == 1) {
            append(to_, 0, here_.front().part(x, until));
        } else {
            append_nearest(x, until);
        }
        x = until;
        std::erase_if(here_, [x](const Here& here) { return here.segment->high <= x; });
    }
    from_.swap(to_);
}

/// The nearest of the segments that are here, all of which reach from `x` to `until`.
void Envelope::append_nearest(double x, double until) {
    const Here* nearest = &here_.front();
    for (const Here& here : here_) {
        nearest = here.depth(x) < nearest->depth(x) ? &here : nearest;
    }
    // Each that takes over is nearer at the end, so that this ends.
    while (nearest != nullptr) {
        const double ahead = nearest->depth(x);
        const double ahead_at_end = nearest->depth(until);
        const Here* crossed = nullptr;
        double crossing = until;
        for (const Here& here : here_) {
            const double lead = ahead_at_end - here.depth(until);
            if (lead > 0) {
                const double behind = std::max(0.0, here.depth(x) - ahead);
                const double at = std::min(x + (until - x) * (behind / (behind + lead)), until);
                crossed = at < crossing ? &here : crossed;
                crossing = std::min(at, crossing);
            }
        }
        if (crossing > x) {
            append(to_, 0, nearest->part(x, crossing));
        }
        x = crossing;
        nearest = crossed;
    }
}

void Envelope::merge_by_halves() {
    ends_.clear();
    for (std::size_t i = 1; i <= from_.size(); ++i) {
        ends_.push_back(i);
    }
    while (ends_.size() > 1) {
        to_.clear();
        next_ends_.clear();
        std::size_t begin = 0;
        for (std::size_t k = 0; k < ends_.size(); k += 2) {
            const std::size_t middle = ends_[k];
            const std::size_t end = k + 1 < ends_.size() ? ends_[k + 1] : middle;
            const std::size_t first = to_.size();
            const std::span<const LinePiece> all(from_);
            merge(
                all.subspan(begin, middle - begin), all.subspan(middle, end - middle),
                [&](const LinePiece& piece) { append(to_, first, piece); });
            next_ends_.push_back(to_.size());
            begin = end;
        }
        from_.swap(to_);
        ends_.swap(next_ends_);
    }
}

void Envelope::seen_before(
    const LinePiece& segment, const std::vector<LinePiece>& pieces, std::vector<LinePiece>& out) {
    const std::size_t first = out.size();
    merge(std::span(&segment, 1), std::span<const LinePiece>(pieces), [&](const LinePiece& piece) {
        if (piece.segment == segment.segment) {
            append(out, first, piece);
        }
    });
}

}  // namespace quasimc
