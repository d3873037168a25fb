#include "quasimc/geometry/envelope.h"

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

/// Segments of random places, lengths and slopes, many of which cross.
std::vector<LinePiece> random_segments(std::size_t n, std::mt19937_64& random) {
    std::vector<LinePiece> segments;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double low = uniform(random);
        const double length = .01 + .5 * std::pow(uniform(random), 3);
        segments.push_back({low, low + length, uniform(random), uniform(random), i});
    }
    return segments;
}

/// The segment that is nearest at `x`, looked for among all; nothing where two are too close to
/// tell.
std::optional<std::uint32_t> nearest(const std::vector<LinePiece>& segments, double x) {
    constexpr double kTooClose = 1e-9;
    constexpr std::uint32_t kNone = 0xffffffff;
    double best = 2;
    double second = 2;
    std::uint32_t found = kNone;
    for (const LinePiece& s : segments) {
        if (std::abs(x - s.low) < kTooClose || std::abs(x - s.high) < kTooClose) {
            return std::nullopt;
        }
        if (x > s.low && x < s.high) {
            const double depth = s.depth(x);
            second = std::min(second, std::max(depth, best));
            found = depth < best ? s.segment : found;
            best = std::min(best, depth);
        }
    }
    return second - best < kTooClose && found != kNone ? std::nullopt : std::optional(found);
}

std::uint32_t seen_at(const std::vector<LinePiece>& pieces, double x) {
    for (const LinePiece& piece : pieces) {
        if (x > piece.low && x < piece.high) {
            return piece.segment;
        }
    }
    return 0xffffffff;
}

RC_GTEST_PROP(Envelope, IsWhatLookingAtEverySegmentFinds, ()) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    const auto n = *rc::gen::inRange<std::size_t>(0, 80);
    const std::vector<LinePiece> segments = random_segments(n, random);
    std::vector<LinePiece> scratch = segments;
    Envelope envelope;
    const std::vector<LinePiece>& pieces = envelope.of(scratch);
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        RC_ASSERT(pieces[i - 1].high <= pieces[i].low);
    }
    constexpr int kLooks = 200;
    for (int look = 0; look < kLooks; ++look) {
        const double x = -.1 + 1.8 * uniform(random);
        if (const auto expected = nearest(segments, x)) {
            RC_ASSERT(seen_at(pieces, x) == *expected);
        }
    }
}

RC_GTEST_PROP(Envelope, ShowsOfASensorWhatIsNearerThanAllElse, ()) {
    std::mt19937_64 random(*rc::gen::arbitrary<std::uint64_t>());
    std::vector<LinePiece> segments = random_segments(20, random);
    std::vector<LinePiece> scratch(segments.begin() + 1, segments.end());
    Envelope envelope;
    const std::vector<LinePiece> pieces = envelope.of(scratch);
    std::vector<LinePiece> seen;
    Envelope::seen_before(segments[0], pieces, seen);
    constexpr int kLooks = 100;
    for (int look = 0; look < kLooks; ++look) {
        const double x = segments[0].low + uniform(random);
        if (const auto expected = nearest(segments, x)) {
            RC_ASSERT((seen_at(seen, x) == 0) == (*expected == 0));
        }
    }
}

TEST(Envelope, OfNothingIsNothing) {
    Envelope envelope;
    std::vector<LinePiece> none;
    EXPECT_TRUE(envelope.of(none).empty());
}

TEST(Envelope, CutsTwoSegmentsWhereTheyCross) {
    std::vector<LinePiece> segments{{0, 4, 0, 4, 0}, {0, 4, 3, -1, 1}};
    Envelope envelope;
    const std::vector<LinePiece>& pieces = envelope.of(segments);
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_EQ(pieces[0].segment, 0U);
    EXPECT_DOUBLE_EQ(pieces[0].high, 1.5);
    EXPECT_EQ(pieces[1].segment, 1U);
    EXPECT_DOUBLE_EQ(pieces[1].high, 4);
}

TEST(Envelope, OfTouchingSegmentsHasNoGap) {
    std::vector<LinePiece> segments{{1, 2, 0, 1, 0}, {0, 1, 0, 0, 1}, {2, 3, 1, 1, 2}};
    Envelope envelope;
    const std::vector<LinePiece>& pieces = envelope.of(segments);
    ASSERT_EQ(pieces.size(), 3U);
    EXPECT_EQ(pieces[0].high, pieces[1].low);
    EXPECT_EQ(pieces[1].high, pieces[2].low);
}

}  // namespace
}  // namespace quasimc
