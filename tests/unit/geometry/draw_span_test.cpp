#include "geometry/raster/draw_span.h"

#include <cstdint>
#include <limits>
#include <random>
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

Row drawn_one_by_one(Row row, const Span& span) {
    for (std::int32_t i = 0; i < span.count; ++i) {
        const float depth = span.z + span.step * static_cast<float>(i);
        if (depth < row.depths[i]) {
            row.depths[i] = depth;
            row.ids[i] = 7;
        }
    }
    return row;
}

void draw(Row& row, const Span& span) {
    const PixelSpan pixels{0, span.count, span.z};
    best_draw_spans()(row.depths.data(), row.ids.data(), {&pixels, 1}, span.step, 7);
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

TEST(DrawSpan, DrawsOneSpanAfterTheOther) {
    for_each_vector_unit([] {
        Row row{std::vector<float>(12 + kSpanLanes, 1), std::vector<std::int32_t>(12 + kSpanLanes)};
        const std::vector<PixelSpan> spans{{1, 2, .5F}, {10, 1, .25F}};
        best_draw_spans()(row.depths.data(), row.ids.data(), spans, .125F, 7);
        row.depths.resize(12);
        row.ids.resize(12);
        EXPECT_EQ(row.depths, (std::vector<float>{1, .5F, .625F, 1, 1, 1, 1, 1, 1, 1, .25F, 1}));
        EXPECT_EQ(row.ids, (std::vector<std::int32_t>{0, 7, 7, 0, 0, 0, 0, 0, 0, 0, 7, 0}));
    });
}

}  // namespace
}  // namespace quasimc
