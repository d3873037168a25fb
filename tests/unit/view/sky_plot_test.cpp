#include "view/sky_plot.h"

#include <gtest/gtest.h>

#include "quasimc/source.h"
#include "support/skies.h"

namespace quasimc::test {
namespace {

/// Red + green + blue of a pixel.
int brightness(Picture& picture, std::size_t x, std::size_t y) {
    const Color& color = picture.palette[picture.at(x, y)];
    return color[0] + color[1] + color[2];
}

/// Seen from below: north above, east at the left.
TEST(SkyPlot, HasNorthAboveAndEastAtTheLeft) {
    SkyTable table{4, 1, {1, 0, 0, 0}, 0, 1};  // from the x axis, the east, to the y axis
    const auto sky = make_sky("sky", table_shape(table), {1});
    Picture picture = plot_sky(*sky, {0, 1, 0}, std::nullopt, 256);
    EXPECT_GT(brightness(picture, 100, 100), 700) << "north-east";
    EXPECT_LT(brightness(picture, 156, 100), 100) << "north-west";
    EXPECT_LT(brightness(picture, 100, 156), 100) << "south-east";
    Picture turned = plot_sky(*sky, {1, 0, 0}, std::nullopt, 256);
    EXPECT_GT(brightness(turned, 156, 100), 700) << "x is the north, y the west";
}

TEST(SkyPlot, MarksTheSunWhereTheSkyIsBrightest) {
    const Vec3 sun = sun_at(45);
    const auto sky = make_sky("sky", cie_clear_shape(sun), {1});
    Picture plain = plot_sky(*sky, {0, 1, 0}, std::nullopt, 200);
    Picture marked = plot_sky(*sky, {0, 1, 0}, sun, 200);
    std::size_t brightest = 0;
    for (std::size_t i = 0; i < plain.pixels.size(); ++i) {
        if (plain.pixels[i] < 250 && plain.pixels[i] > plain.pixels[brightest] % 250) {
            brightest = i;
        }
    }
    // Half way between the zenith and the horizon, 37 degrees from north to east (the left).
    const double x = static_cast<double>(brightest % 200);
    const double y = static_cast<double>(brightest / 200);
    EXPECT_NEAR(x, 100 - .6 * 42, 4);
    EXPECT_NEAR(y, 100 - .8 * 42, 4);
    EXPECT_NE(plain.pixels, marked.pixels);
}

TEST(Png, HasItsSignatureAndSize) {
    if (!has_png()) {
        GTEST_SKIP() << "built without libpng";
    }
    const auto sky = make_sky("sky", cie_overcast_shape(), {1});
    const std::string png = to_png(plot_sky(*sky, {0, 1, 0}, std::nullopt, 128));
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(static_cast<unsigned char>(png[19]), 128);
    EXPECT_EQ(static_cast<unsigned char>(png[23]), 128);
    EXPECT_LT(png.size(), 40000);
}

}  // namespace
}  // namespace quasimc::test
