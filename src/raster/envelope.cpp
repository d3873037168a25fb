#include "raster/envelope.h"

#include <algorithm>

#include "base/stop.h"

namespace quasimc {
namespace {

/// Where `behind`, which is not nearer than `front` at `x`, is as near as it: it is nearer by
/// `lead` at `end`.
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
            go_on();
        }
        if (front_ == nullptr) {
            begin(segment);
            continue;
        }
        const double lag = segment.at_low - front_->depth(x);
        if (lag < 0 || (lag == 0 && segment.slope < front_->slope)) {
            take_over(segment, x);
        } else {
            watch(segment, x);
        }
    }
    while (front_ != nullptr) {
        check_stop();
        go_on();
    }
}

/// A segment where there is no other.
void Envelope::begin(const VisibleSegment& segment) {
    front_ = &segment;
    crossing_ = nullptr;
    from_ = segment.low;
    until_ = segment.high;
}

/// A segment begins in front.
void Envelope::take_over(const VisibleSegment& segment, double x) {
    put(x);
    behind_.push_back(front_);
    front_ = &segment;
    look_behind(x);
}

/// A segment begins behind the one in front.
void Envelope::watch(const VisibleSegment& segment, double x) {
    if (look_at(segment, x)) {
        behind_.push_back(&segment);
    }
}

/// Notes if a segment behind the front passes it before all others. False if it will not be seen.
/// Slopes tell what passes what, so that rounding makes no circles.
bool Envelope::look_at(const VisibleSegment& segment, double x) {
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

/// Finds how far the new front is seen, and forgets what will not be seen again.
void Envelope::look_behind(double x) {
    until_ = front_->high;
    crossing_ = nullptr;
    std::size_t kept = 0;
    for (const VisibleSegment* other : behind_) {
        if (other != front_ && other->high > x && look_at(*other, x)) {
            behind_[kept++] = other;
        }
    }
    behind_.resize(kept);
}

/// The front ends or is passed.
void Envelope::go_on() {
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
        look_behind(x);
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
