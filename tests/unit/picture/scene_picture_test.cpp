#include "picture/scene_picture.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "quasimc/error.h"
#include "quasimc/scene.h"

namespace quasimc::test {
namespace {

constexpr Rgb kRed{255, 0, 0}, kBlue{0, 0, 255}, kWhite{255, 255, 255};

/// Horizontal squares of side 1: the first at the origin, the second above its eastern half and
/// beyond it.
Scene two_squares(UpAxis up = UpAxis::z) {
    const Orientation axes(up, up == UpAxis::z ? Vec3{0, 1, 0} : Vec3{1, 0, 0});
    SceneBuilder builder({{"PAR"}}, axes);
    builder.add_material({"black", {SideOptics{}}, {SideOptics{}}});
    for (const double step : {0.0, 1.0}) {
        OrganSpec organ;
        std::vector<Triangle> square =
            make_parallelogram({0.5 * step, 0, 2 * step}, {1, 0, 0}, {0, 1, 0});
        for (Triangle& triangle : square) {
            for (Vec3& corner : triangle) {
                corner = axes.outward(corner);
            }
        }
        organ.parts.push_back({.material = "black", .triangles = square});
        builder.add_organ(std::move(organ));
    }
    return std::move(builder).build();
}

Image picture_of(const Scene& scene, const ViewSpec& view, std::vector<CutPlane> cuts = {}) {
    RenderSpec spec;
    spec.width = 120;
    spec.height = 90;
    spec.colors = {kRed, kBlue};
    spec.shading = 0;
    spec.cuts = std::move(cuts);
    const Camera camera(view, scene.orientation(), shown_bounds(scene, spec.cuts), 120, 90);
    return render(scene, camera, spec);
}

/// How many pixels have a color.
double count(const Image& image, const Rgb& color) {
    return static_cast<double>(std::count(image.pixels.begin(), image.pixels.end(), color));
}

const ViewSpec kTop{180, 90, 0};

TEST(Render, ShowsTheUpperSurfaceInFrontFromAbove) {
    const Image image = picture_of(two_squares(), kTop);
    // The bounds are 1.5 wide and 1 high: they fill the width but for the margin.
    const double scale = 120 / (1.5 * 1.06);
    EXPECT_NEAR(count(image, kBlue), scale * scale, 0.05 * scale * scale);
    EXPECT_NEAR(count(image, kRed), 0.5 * scale * scale, 0.05 * scale * scale);
    EXPECT_EQ(image.at(20, 45), kRed) << "the west is at the left";
    EXPECT_EQ(image.at(90, 45), kBlue);
    EXPECT_EQ(image.at(60, 2), kWhite);
}

TEST(Render, ShowsTheLowerSurfaceInFrontFromBelow) {
    const Image image = picture_of(two_squares(), {180, -90, 0});
    EXPECT_GT(count(image, kRed), 1.9 * count(image, kBlue));
}

TEST(Render, IsTheSameInAFileWithYUp) {
    const ViewSpec view{200, 30, 0};
    EXPECT_EQ(
        picture_of(two_squares(UpAxis::z), view).pixels.size(),
        picture_of(two_squares(UpAxis::y), view).pixels.size());
    EXPECT_NEAR(
        count(picture_of(two_squares(UpAxis::z), view), kBlue),
        count(picture_of(two_squares(UpAxis::y), view), kBlue), 40);
}

TEST(Render, DoesNotDependOnThreads) {
    const Scene scene = two_squares();
    RenderSpec spec{.width = 64, .height = 48, .colors = {kRed, kBlue}};
    const Camera camera({200, 30, 40}, scene.orientation(), scene.bounds(), 64, 48);
    spec.threads = 1;
    const Image one = render(scene, camera, spec);
    spec.threads = 3;
    EXPECT_EQ(one.pixels, render(scene, camera, spec).pixels);
}

TEST(Render, LeavesOutWhatIsCutAway) {
    const Image image = picture_of(two_squares(), kTop, {{{0, 0, 1}, 1}});
    EXPECT_EQ(count(image, kBlue), 0);
    EXPECT_GT(count(image, kRed), 1000);
    EXPECT_TRUE(shown_bounds(two_squares(), {{{0, 0, -1}, -5}}).empty());
}

TEST(Camera, ShowsABoxWholeFromEverywhere) {
    const Bounds box = [] {
        Bounds bounds;
        bounds.add({100, -3, 0.5});
        bounds.add({101, 4, 0.75});
        return bounds;
    }();
    for (const double opening : {0.0, 30.0, 100.0}) {
        for (int azimuth = 0; azimuth < 360; azimuth += 40) {
            for (int elevation = -90; elevation <= 90; elevation += 30) {
                const ViewSpec view{double(azimuth), double(elevation), opening};
                const Camera camera(view, {}, box, 300, 200);
                double least = 1e9;
                for (int i = 0; i < 8; ++i) {
                    const Vec3 corner{
                        (i & 1) != 0 ? box.high.x : box.low.x,
                        (i & 2) != 0 ? box.high.y : box.low.y,
                        (i & 4) != 0 ? box.high.z : box.low.z};
                    const PixelPoint at = camera.pixel_of(corner);
                    EXPECT_TRUE(at.x >= 0 && at.x <= 300 && at.y >= 0 && at.y <= 200)
                        << azimuth << ' ' << elevation << ' ' << opening;
                    least = std::min({least, at.x, at.y, 300 - at.x, 200 - at.y});
                    const Camera::CameraRay line = camera.through(at).value();
                    const Vec3 to = corner - line.origin;
                    EXPECT_NEAR(dot(normalized(to), line.direction), 1, 1e-6);
                }
                EXPECT_LT(least, 12) << "it fills the picture";
            }
        }
    }
}

TEST(Camera, OfAFisheyeSeesTheSkyInACircle) {
    ViewSpec view;
    view.fisheye = Vec3{1, 2, 3};
    const Camera camera(view, {}, {}, 300, 200);
    const auto direction_at = [&](double x, double y) {
        const Camera::CameraRay line = camera.through({x, y}).value();
        EXPECT_EQ(line.origin, (Vec3{1, 2, 3}));
        return line.direction;
    };
    const auto expect_near = [](const Vec3& a, const Vec3& b) { EXPECT_LT(length(a - b), 1e-12); };
    const double half = std::sqrt(.5);
    expect_near(direction_at(150, 100), {0, 0, 1});
    expect_near(direction_at(150, 50), {0, half, half});   // north, half way to the horizon
    expect_near(direction_at(100, 100), {half, 0, half});  // east is on the left
    expect_near(direction_at(250, 100), {-1, 0, 0});
    EXPECT_FALSE(camera.through({251, 100}));
}

TEST(Render, SeesAnInfiniteStandThroughAFisheye) {
    SceneBuilder builder({{"PAR"}});
    builder.add_material({"leaf", {{.reflectance = .1}}, {{.reflectance = .1}}});
    const std::vector<Triangle> leaf{
        {Vec3{.2, .2, 1}, Vec3{.8, .2, 1}, Vec3{.8, .8, 1}},
        {Vec3{.2, .2, 1}, Vec3{.8, .8, 1}, Vec3{.2, .8, 1}}};
    OrganSpec organ;
    organ.parts.push_back({"leaf", leaf});
    builder.add_organ(organ);
    builder.set_cell({.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
    const Scene scene = std::move(builder).build();
    ViewSpec view;
    view.fisheye = Vec3{.5, .5, 0};
    RenderSpec spec{.width = 200, .height = 200, .colors = {kRed}, .shading = 0};
    const Camera camera(view, {}, scene.bounds(), 200, 200);
    const Image image = render(scene, camera, spec);
    EXPECT_EQ(image.at(100, 100), kRed);            // its own leaf
    EXPECT_EQ(image.at(100, 70), spec.background);  // y = 1, between two leaves
    EXPECT_EQ(image.at(100, 42), kRed);             // y = 1.78, on the leaf of the next cell
    EXPECT_EQ(image.at(2, 2), spec.background);     // outside of the circle
}

TEST(Legend, LeavesFewBrightOrgansOutOfTheScale) {
    const std::vector<double> values{1, 2, 3, 100};
    const std::vector<double> areas{1, 1, 1, 1e-3};
    const ColorMap& map = *find_color_map("viridis");
    const Legend legend = scale_of(values, areas, map);
    EXPECT_EQ(legend.low, 0);
    EXPECT_EQ(legend.high, 3);
    EXPECT_TRUE(legend.is_exceeded);
    EXPECT_EQ(colors_of(values, legend)[3], color_at(map, 1));
    EXPECT_FALSE(scale_of(values, {1, 1, 1, 1}, map).is_exceeded);
    EXPECT_EQ(colors_of({std::nan("")}, legend)[0], kNoValue);
    const Legend dark = scale_of({0, 0}, {1, 1}, map);
    EXPECT_LT(dark.low, dark.high);
}

TEST(ColorMap, GetsLighterAllTheWay) {
    for (const ColorMap& map : color_map_table()) {
        double before = -1;
        for (int i = 0; i <= 100; ++i) {
            const Rgb c = color_at(map, i / 100.0);
            const double light = 0.2126 * std::pow(c.r, 2.2) + 0.7152 * std::pow(c.g, 2.2) +
                                 0.0722 * std::pow(c.b, 2.2);
            EXPECT_GT(light, before - 1e-9) << map.name << ' ' << i;
            before = light;
        }
    }
}

TEST(Legend, HasRoundTicks) {
    const std::vector<double> ticks = ticks_between(0, 0.74, 6);
    ASSERT_EQ(ticks.size(), 8U);
    EXPECT_EQ(tick_text(ticks[7], 0.1), "0.7");
    EXPECT_EQ(tick_text(0, 1e-7), "0");
    EXPECT_EQ(tick_text(2e6, 5e5), "2.0e+06");
    EXPECT_EQ(round_number_below(0.3), 0.2);
}

TEST(Legend, HasAPowerOfTenForVerySmallAndLargeTicks) {
    EXPECT_EQ(tick_exponent(0, 5, 1), 0);
    EXPECT_EQ(tick_exponent(0, 5e-6, 1e-6), -6);
    EXPECT_EQ(tick_exponent(-3e7, 2e7, 1e7), 7);
}

TEST(Legend, HasClassesOfErrorsInOrder) {
    double before = 0;
    for (const ErrorClass& one : error_class_table()) {
        EXPECT_GT(one.below, before);
        before = one.below;
    }
    EXPECT_TRUE(std::isinf(before));
}

TEST(ColorMap, HasDifferentColoursForManyCategories) {
    for (const std::size_t count : {3U, 12U, 20U, 60U}) {
        const std::vector<Rgb> colors = category_colors(count);
        ASSERT_EQ(colors.size(), count);
        for (std::size_t i = 0; i < count; ++i) {
            EXPECT_FALSE(colors[i] == kNoValue);
            for (std::size_t j = 0; j < i; ++j) {
                const int distance = std::abs(colors[i].r - colors[j].r) +
                                     std::abs(colors[i].g - colors[j].g) +
                                     std::abs(colors[i].b - colors[j].b);
                EXPECT_GT(distance, count <= 20 ? 30 : 4) << count << ": " << i << ' ' << j;
            }
        }
    }
}

TEST(Canvas, FoldsTextsThatAreTooWide) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    EXPECT_EQ(folded("", 13, 100, 2), std::vector<std::string>{""});
    EXPECT_EQ(folded("a leaf", 13, 100, 2), std::vector<std::string>{"a leaf"});
    const std::vector<std::string> lines = folded("one two three four five six seven", 13, 90, 2);
    ASSERT_EQ(lines.size(), 2U);
    EXPECT_TRUE(lines[1].ends_with("\u2026")) << lines[1];
    for (const std::string& line : lines) {
        EXPECT_LE(draw_text(line, 13).width, 90U) << line;
    }
    const std::string wide =
        folded("\u00fc\u00fc\u00fc\u00fc\u00fc\u00fc\u00fc\u00fc\u00fc\u00fc", 13, 40, 1)[0];
    EXPECT_TRUE(wide.starts_with("\u00fc\u00fc") && wide.ends_with("\u2026")) << wide;
    EXPECT_EQ((wide.size() - 3) % 2, 0U) << "letters are whole";
}

TEST(Canvas, LosesItsBackgroundAlone) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const auto drawn_on = [](const Rgb& background) {
        Canvas canvas(8, 8, background);
        canvas.rectangle({0, 0}, 4, 8, kRed);
        return canvas.image();
    };
    const std::string png = to_transparent_png(drawn_on(kWhite), drawn_on({0, 0, 0}));
    EXPECT_EQ(png[25], 6) << "red, green, blue and alpha";
    EXPECT_EQ(to_png(drawn_on(kWhite))[25], 2);
}

TEST(Canvas, DrawsLettersWhereTheyBelong) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const auto dark_at_the_left = [](TextAnchor anchor) {
        Canvas canvas(100, 100);
        canvas.text({50, 50}, "QuasiMC", {.size = 14, .anchor = anchor});
        double dark = 0;
        for (std::size_t i = 0; i < canvas.image().pixels.size(); ++i) {
            dark += i % 100 < 50 ? 255.0 - canvas.image().pixels[i].g : 0;
        }
        return dark;
    };
    EXPECT_EQ(dark_at_the_left(TextAnchor::start), 0);
    EXPECT_GT(dark_at_the_left(TextAnchor::middle), 1000);
}

TEST(Canvas, DrawsPngWithItsSignatureAndSize) {
    if (!has_png()) {
        GTEST_SKIP() << "built without pictures";
    }
    const std::string png = to_png(Canvas(128, 64).image());
    EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(static_cast<unsigned char>(png[19]), 128);
    EXPECT_EQ(static_cast<unsigned char>(png[23]), 64);
}

}  // namespace
}  // namespace quasimc::test
