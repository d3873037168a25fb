#include "raster/envelope.h"

#include <algorithm>

#include "base/stop.h"

namespace quasimc {
namespace {

/// The position where `behind` becomes as near as `front`: at `x` it is not nearer, at `end` it is
/// nearer by `lead`.
double crossing_of(
    const VisibleSegment& front, const VisibleSegment& behind, double x, double end, double lead) {
    const double lag = std::max(0.0, behind.depth(x) - front.depth(x));
    return std::min(x + (end - x) * (lag / (lag + lead)), end);
}

}  // namespace

void Envelope::find(
    std::span<const VisibleSegment> segments,
    std::vector<VisibleSegment>& out,
    const std::stop_token* stop) {
    const auto check_stop = [stop] {
        if (stop != nullptr) {
            throw_if_stopped(*stop);
        }
    };
    out.clear();
    out_ = &out;
    front_ = nullptr;
    behind_.clear();
    for (const VisibleSegment& segment : segments) {
        if (!(segment.low < segment.high)) {
            continue;
        }
        check_stop();
        const double x = segment.low;
        while (front_ != nullptr && until_ <= x) {
            advance();
        }
        if (front_ == nullptr) {
            begin(segment);
            continue;
        }
        const double lag = segment.at_low - front_->depth(x);
        if (lag < 0 || (lag == 0 && segment.slope < front_->slope)) {
            take_over(segment, x);
        } else {
            add_behind(segment, x);
        }
    }
    while (front_ != nullptr) {
        check_stop();
        advance();
    }
}

/// Starts with a segment where there is no other.
void Envelope::begin(const VisibleSegment& segment) {
    front_ = &segment;
    crossing_ = nullptr;
    from_ = segment.low;
    until_ = segment.high;
}

/// A segment starts in front of the current one.
void Envelope::take_over(const VisibleSegment& segment, double x) {
    put(x);
    behind_.push_back(front_);
    front_ = &segment;
    update_front(x);
}

/// A segment starts behind the front.
void Envelope::add_behind(const VisibleSegment& segment, double x) {
    if (note_crossing(segment, x)) {
        behind_.push_back(&segment);
    }
}

/// Records a segment behind the front if it is the first to cross it. Returns false if it stays
/// hidden. Slopes decide the order, so that rounding can't cause an infinite loop.
bool Envelope::note_crossing(const VisibleSegment& segment, double x) {
    const double end = std::min(segment.high, front_->high);
    const double lead = front_->depth(end) - segment.depth(end);
    if (lead > 0 && segment.slope < front_->slope) {
        const double crossing = crossing_of(*front_, segment, x, end, lead);
        if (crossing < until_) {
            until_ = crossing;
            crossing_ = &segment;
        }
        return true;
    }
    return segment.high > front_->high;
}

/// Finds the end of the new front, and drops segments that stay hidden.
void Envelope::update_front(double x) {
    until_ = front_->high;
    crossing_ = nullptr;
    std::size_t kept = 0;
    for (const VisibleSegment* other : behind_) {
        if (other != front_ && other->high > x && note_crossing(*other, x)) {
            behind_[kept++] = other;
        }
    }
    behind_.resize(kept);
}

/// The front ends or is crossed.
void Envelope::advance() {
    put(until_);
    const double x = until_;
    if (crossing_ != nullptr) {
        behind_.push_back(front_);
        front_ = crossing_;
    } else {
        front_ = nullptr;
        for (const VisibleSegment* other : behind_) {
            if (other->high > x && (front_ == nullptr || other->depth(x) < front_->depth(x))) {
                front_ = other;
            }
        }
    }
    if (front_ != nullptr) {
        update_front(x);
    }
}

void Envelope::put(double until) {
    if (from_ < until) {
        out_->push_back(front_->part(from_, until));
    }
    from_ = until;
}

void Envelope::seen_before(
    const VisibleSegment& segment,
    std::span<const VisibleSegment> pieces,
    std::vector<VisibleSegment>& out) {
    const auto put = [&](double from, double to) {
        if (from < to) {
            out.push_back(segment.part(from, to));
        }
    };
    if (!(segment.low < segment.high)) {
        return;
    }
    double x = segment.low;
    auto piece = std::partition_point(
        pieces.begin(), pieces.end(), [x](const VisibleSegment& p) { return p.high <= x; });
    for (; piece != pieces.end() && piece->low < segment.high; ++piece) {
        put(x, piece->low);
        const double low = std::max(x, piece->low);
        const double high = std::min(segment.high, piece->high);
        const double lead_low = piece->depth(low) - segment.depth(low);
        const double lead_high = piece->depth(high) - segment.depth(high);
        if (lead_low > 0 && lead_high > 0) {
            put(low, high);
        } else if (lead_low > 0) {
            put(low, crossing_of(segment, *piece, low, high, -lead_high));
        } else if (lead_high > 0) {
            put(crossing_of(*piece, segment, low, high, lead_high), high);
        }
        x = high;
    }
    put(x, segment.high);
}

}  // namespace quasimc
