#include "picture/array_map.h"

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

ArrayMap two_by_three() {
    ArrayMap map;
    map.title = "floor";
    map.columns = 3;
    map.rows = 2;
    map.values = {0, 1, 2, 3, 4, 5};
    map.legend = {.map = &color_map_table().front(), .low = 0, .high = 5};
    return map;
}

/// The colours of the cells' centres in a map of 640 x 427 pixels below a title.
Rgb color_of_cell(const Image& image, std::size_t column, std::size_t row_from_top) {
    return image.at(20 + 107 + 213 * column, 60 + 107 + 213 * row_from_top);
}

TEST(ArrayMap, HasItsFirstRowBelow) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const ArrayMap map = two_by_three();
    const Image image = draw_array_map(map);
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        EXPECT_EQ(
            color_of_cell(image, i % 3, 1 - i / 3), color_at(*map.legend.map, map.values[i] / 5))
            << i;
    }
}

TEST(ArrayMap, HasCellsOfTheAspectOfTheArray) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    ArrayMap map = two_by_three();
    const std::size_t square = draw_array_map(map).height;
    map.aspect = 2;
    EXPECT_EQ(square, draw_array_map(map).height + 427 - 213);
}

TEST(ArrayMap, AreStacked) {
    const Image a(3, 2, {1, 2, 3}), b(5, 4, {7, 8, 9});
    const Image both = stacked({a, b});
    EXPECT_EQ(both.width, 5U);
    EXPECT_EQ(both.height, 6U);
    EXPECT_EQ(both.at(2, 1), (Rgb{1, 2, 3}));
    EXPECT_EQ(both.at(4, 1), (Rgb{255, 255, 255}));
    EXPECT_EQ(both.at(4, 2), (Rgb{7, 8, 9}));
}

}  // namespace
}  // namespace quasimc::test
