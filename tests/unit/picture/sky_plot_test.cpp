#include "picture/sky_plot.h"

#include <gtest/gtest.h>

#include "quasimc/source.h"
#include "support/skies.h"

namespace quasimc::test {
namespace {

const Vec3 kNoSun{0, 0, -1};

/// Red + green + blue of a pixel.
int brightness(const Image& image, std::size_t x, std::size_t y) {
    const Rgb& color = image.at(x, y);
    return color.r + color.g + color.b;
}

class SkyPlot : public ::testing::Test {
  protected:
    void SetUp() override {
        if (!has_png()) {
            GTEST_SKIP() << "built without pictures";
        }
    }
};

/// Seen from below: north above, east at the left.
TEST_F(SkyPlot, HasNorthAboveAndEastAtTheLeft) {
    SkyTable table{4, 1, {1, 0, 0, 0}, 0, 1};  // from the x axis, the east, to the y axis
    const auto sky = make_sky("sky", table_shape(table), {1});
    const Image image = plot_sky(*sky, kNoSun, 256);
    EXPECT_GT(brightness(image, 100, 100), 700) << "north-east";
    EXPECT_LT(brightness(image, 156, 100), 100) << "north-west";
    EXPECT_LT(brightness(image, 100, 156), 100) << "south-east";
}

TEST_F(SkyPlot, MarksTheSunWhereTheSkyIsBrightest) {
    const Vec3 sun = sun_at(45);
    const auto sky = make_sky("sky", cie_clear_shape(sun), {1});
    const Image plain = plot_sky(*sky, kNoSun, 200);
    const Image marked = plot_sky(*sky, sun, 200);
    // Half way between the zenith and the horizon, 37 degrees from north to east (the left).
    const std::size_t x = 73, y = 64;
    EXPECT_GT(brightness(plain, x, y), 740);
    EXPECT_LT(brightness(plain, 200 - x, y), 600);
    EXPECT_LT(marked.at(x, y).g, 60) << "a red dot";
    EXPECT_GT(marked.at(x, y).r, 200);
}

}  // namespace
}  // namespace quasimc::test
