#include "raster/envelope.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace quasimc {
namespace {

double uniform(std::mt19937_64& random) {
    return std::uniform_real_distribution<double>()(random);
}

/// From depth to depth.
VisibleSegment segment(
    double low, double high, double at_low, double at_high, std::uint32_t number) {
    return {low, high, at_low, (at_high - at_low) / (high - low), number};
}

/// What is seen of segments in any order.
std::vector<VisibleSegment> envelope_of(std::vector<VisibleSegment> segments) {
    std::sort(
        segments.begin(), segments.end(),
        [](const VisibleSegment& a, const VisibleSegment& b) { return a.low < b.low; });
    Envelope envelope;
    std::vector<VisibleSegment> pieces;
    envelope.find(segments, pieces);
    return pieces;
}

/// Segments of random positions, lengths and slopes, many of which cross.
std::vector<VisibleSegment> random_segments(std::size_t n, std::mt19937_64& random) {
    std::vector<VisibleSegment> segments;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double low = uniform(random);
        const double length = .01 + .5 * std::pow(uniform(random), 3);
        segments.push_back(segment(low, low + length, uniform(random), uniform(random), i));
    }
    return segments;
}

/// The segment that is nearest at `x`, by brute force; nothing if the two nearest are too close.
std::optional<std::uint32_t> nearest(const std::vector<VisibleSegment>& segments, double x) {
    constexpr double kTooClose = 1e-9;
    constexpr std::uint32_t kNone = 0xffffffff;
    double best = 2;
    double second = 2;
    std::uint32_t found = kNone;
    for (const VisibleSegment& s : segments) {
        if (std::abs(x - s.low) < kTooClose || std::abs(x - s.high) < kTooClose) {
            return std::nullopt;
        }
        if (x > s.low && x < s.high) {
            const double depth = s.depth(x);
            second = std::min(second, std::max(depth, best));
            found = depth < best ? s.surface : found;
            best = std::min(best, depth);
        }
    }
    return second - best < kTooClose && found != kNone ? std::nullopt : std::optional(found);
}

std::uint32_t seen_at(const std::vector<VisibleSegment>& pieces, double x) {
    for (const VisibleSegment& piece : pieces) {
        if (x > piece.low && x < piece.high) {
            return piece.surface;
        }
    }
    return 0xffffffff;
}

RC_GTEST_PROP(Envelope, IsWhatLookingAtEverySegmentFinds, ()) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const auto n = *rc::gen::inRange<std::size_t>(0, 80);
    const std::vector<VisibleSegment> segments = random_segments(n, random);
    const std::vector<VisibleSegment> pieces = envelope_of(segments);
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        RC_ASSERT(pieces[i - 1].high <= pieces[i].low);
    }
    constexpr int kSamples = 200;
    for (int sample = 0; sample < kSamples; ++sample) {
        const double x = -.1 + 1.8 * uniform(random);
        if (const auto expected = nearest(segments, x)) {
            RC_ASSERT(seen_at(pieces, x) == *expected);
        }
    }
}

RC_GTEST_PROP(Envelope, ShowsOfASensorWhatIsNearerThanAllElse, ()) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const std::vector<VisibleSegment> segments = random_segments(20, random);
    const std::vector<VisibleSegment> pieces = envelope_of({segments.begin() + 1, segments.end()});
    std::vector<VisibleSegment> seen;
    Envelope::seen_before(segments[0], pieces, seen);
    constexpr int kSamples = 100;
    for (int sample = 0; sample < kSamples; ++sample) {
        const double x = segments[0].low + uniform(random);
        if (const auto expected = nearest(segments, x)) {
            RC_ASSERT((seen_at(seen, x) == 0) == (*expected == 0));
        }
    }
}

TEST(Envelope, OfNothingIsNothing) {
    EXPECT_TRUE(envelope_of({}).empty());
    EXPECT_TRUE(envelope_of({{1, 1, 0, 0, 0}}).empty());
}

TEST(Envelope, CutsTwoSegmentsWhereTheyCross) {
    const auto pieces = envelope_of({segment(0, 4, 0, 4, 0), segment(0, 4, 3, -1, 1)});
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].surface, 0U);
    EXPECT_DOUBLE_EQ(pieces[0].high, 1.5);
    EXPECT_EQ(pieces[1].surface, 1U);
    EXPECT_DOUBLE_EQ(pieces[1].high, 4);
}

/// Many that lie on one another, but for rounding, as planes of the same leaf do.
RC_GTEST_PROP(Envelope, ComesToAnEndWhereSegmentsAreTheSame, ()) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const double slope = 2 * uniform(random) - 1;
    std::vector<VisibleSegment> segments;
    for (std::uint32_t i = 0; i < 30; ++i) {
        const double low = std::round(4 * uniform(random)) / 4;
        const double high = low + .1 + std::round(4 * uniform(random)) / 4;
        const double noise = 1e-16 * (uniform(random) - .5);
        segments.push_back(segment(low, high, low * slope + noise, high * slope, i));
    }
    const std::vector<VisibleSegment> pieces = envelope_of(segments);
    double covered = 0;
    for (const VisibleSegment& piece : pieces) {
        covered += piece.length();
    }
    for (int sample = 0; sample < 100; ++sample) {
        const double x = 2.2 * uniform(random);
        const bool over = std::any_of(
            segments.begin(), segments.end(),
            [x](const VisibleSegment& s) { return x > s.low && x < s.high; });
        RC_ASSERT((seen_at(pieces, x) != 0xffffffff) == over);
    }
    RC_ASSERT(covered <= 2.2);
}

TEST(Envelope, OfTouchingSegmentsHasNoGap) {
    const auto pieces =
        envelope_of({segment(1, 2, 0, 1, 0), segment(0, 1, 0, 0, 1), segment(2, 3, 1, 1, 2)});
    ASSERT_EQ(pieces.size(), 3U);
    EXPECT_EQ(pieces[0].high, pieces[1].low);
    EXPECT_EQ(pieces[1].high, pieces[2].low);
}

}  // namespace
}  // namespace quasimc
