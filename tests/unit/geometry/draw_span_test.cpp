#include "raster/draw_span.h"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "support/vector_units.h"

namespace quasimc {
namespace {

struct Row {
    std::vector<float> depths;
    std::vector<std::int32_t> ids;
    bool operator==(const Row&) const = default;
};

struct Span {
    std::int32_t count;
    float z, step;
};

constexpr std::int32_t kPixels = 40;

Row random_row(std::mt19937& random) {
    Row row;
    std::uniform_real_distribution<float> depth(0, 1);
    for (std::int32_t i = 0; i < kPixels + kSpanLanes; ++i) {
        row.depths.push_back(
            random() % 4 == 0 ? std::numeric_limits<float>::infinity() : depth(random));
        row.ids.push_back(i % 5);
    }
    return row;
}

Row drawn_one_by_one(Row row, const Span& span, std::size_t first = 0, std::int32_t id = 7) {
    for (std::int32_t i = 0; i < span.count; ++i) {
        const float depth = span.z + span.step * static_cast<float>(i);
        if (depth < row.depths[first + i]) {
            row.depths[first + i] = depth;
            row.ids[first + i] = id;
        }
    }
    return row;
}

/// Draws a span from the first pixel on, as lane 2 of a block.
void draw(Row& row, const Span& span) {
    constexpr std::size_t kLane = 2;
    BlockSpans block{};
    block.rows = 1;
    block.covered[0] = 1U << kLane;
    block.last[kLane] = span.count;
    block.first_depth[kLane] = span.z;
    block.depth.by_x[kLane] = span.step;
    best_draw_loops().rows({row.depths.data(), row.ids.data()}, block, 5);
}

TEST(DrawSpan, DrawsTheSameBitsOnEveryVectorUnit) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> number(-.1F, 1);
    for (std::int32_t count = 0; count <= kPixels; ++count) {
        const Row row = random_row(random);
        const Span span{count, number(random), .1F * number(random)};
        const Row expected = drawn_one_by_one(row, span);
        for_each_vector_unit([&] {
            Row drawn = row;
            draw(drawn, span);
            EXPECT_EQ(drawn, expected) << count << " pixels";
        });
    }
}

TEST(DrawSpan, LeavesWhatIsAsNear) {
    for_each_vector_unit([] {
        Row row{std::vector<float>(1 + kSpanLanes, .5F), std::vector<std::int32_t>(1 + kSpanLanes)};
        draw(row, {1, .5F, 0});
        EXPECT_EQ(row.ids[0], 0);
        draw(row, {1, .25F, 0});
        EXPECT_EQ(row.ids[0], 7);
    });
}

/// So that it does not matter which of them is drawn first.
TEST(DrawSpan, ShowsTheLeastOfWhatIsEquallyNear) {
    for_each_vector_unit([] {
        Row row{
            std::vector<float>(1 + kSpanLanes, .5F), std::vector<std::int32_t>(1 + kSpanLanes, 8)};
        draw(row, {1, .5F, 0});
        EXPECT_EQ(row.ids[0], 7);
    });
}

/// Rows of a block are those of its triangles, one triangle after the other.
TEST(DrawSpan, DrawsTheRowsOfABlock) {
    constexpr std::uint32_t kColumns = 40, kRows = 30;
    std::mt19937 random(1);
    std::uniform_real_distribution<double> position(-1, 1);
    const RasterGrid grid{
        .x = {{20, 0, 0}, 19.7},
        .y = {{0, 15, 0}, 15.2},
        .z = {{.1, .2, 1}, 0},
        .columns = kColumns,
        .rows = kRows};
    for_each_vector_unit([&] {
        TriangleBlock block;
        for (auto& corner : block.at) {
            for (auto& coordinate : corner) {
                std::generate(
                    std::begin(coordinate), std::end(coordinate), [&] { return position(random); });
            }
        }
        const std::size_t pixels = kColumns * kRows + kSpanLanes;
        Row together{std::vector<float>(pixels, 9), std::vector<std::int32_t>(pixels)};
        Row one_by_one = together;
        BlockSpans spans{};
        ASSERT_TRUE(best_span_loops().set(block, {}, grid, spans));
        while (best_span_loops().next(grid, spans)) {
            best_draw_loops().rows(
                {together.depths.data(), together.ids.data(), kColumns}, spans, 5);
            spans.for_each([&](std::size_t lane, std::size_t i) {
                const double z = spans.first_depth[lane] +
                                 (spans.first[i] - spans.first_x[lane]) * spans.depth.by_x[lane] +
                                 (spans.y[i] - spans.first_y[lane]) * spans.depth.by_y[lane];
                one_by_one = drawn_one_by_one(
                    std::move(one_by_one),
                    {static_cast<std::int32_t>(spans.last[i] - spans.first[i]),
                     static_cast<float>(z), static_cast<float>(spans.depth.by_x[lane])},
                    kColumns * static_cast<std::size_t>(spans.y[i]) +
                        static_cast<std::size_t>(spans.first[i]),
                    5 + static_cast<std::int32_t>(lane));
            });
        }
        EXPECT_GT(std::count(together.ids.begin(), together.ids.end(), 8), 5);
        EXPECT_EQ(together, one_by_one);
    });
}

/// The ends of runs of equal ids.
std::vector<std::uint32_t> run_ends(const std::vector<std::int32_t>& ids, std::uint32_t count) {
    std::vector<std::uint32_t> ends;
    for (std::uint32_t i = 0; i < count; ++i) {
        if (ids[i] != ids[i + 1]) {
            ends.push_back(i + 1);
        }
    }
    return ends;
}

/// In whole blocks of pixels, and in what is left of the last.
TEST(RunEnds, AreWhereTheNextIdIsAnother) {
    std::mt19937 random(2);
    for (const std::uint32_t count : {0U, 1U, 63U, 64U, 65U, 200U, 1000U}) {
        for (const std::uint32_t change : {1U, 3U, 90U}) {  // every so manieth pixel
            std::vector<std::int32_t> ids(count + kSpanLanes, 0);
            for (std::uint32_t i = 1; i < count; ++i) {
                ids[i] = ids[i - 1] + (random() % change == 0 ? 1 : 0);
            }
            ids[count] = -1;
            const std::vector<std::uint32_t> expected = run_ends(ids, count);
            for_each_vector_unit([&] {
                std::vector<std::uint32_t> ends(count + kSpanLanes);
                ends.resize(best_draw_loops().run_ends(ids.data(), count, ends.data()));
                EXPECT_EQ(ends, expected) << count;
            });
        }
    }
}

}  // namespace
}  // namespace quasimc
