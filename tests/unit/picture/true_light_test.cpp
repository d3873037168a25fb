// Scenes as an eye sees them.

#include "picture/true_light.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "scene/scene.h"

namespace quasimc::test {
namespace {

Band band_of(std::string name, double from_nm = 0, double to_nm = 0) {
    Band band;
    band.name = std::move(name);
    band.from_nm = from_nm;
    band.to_nm = to_nm;
    return band;
}

const std::vector<Band> kColors{
    band_of("b", 400, 500), band_of("g", 500, 600), band_of("r", 600, 700)};

MaterialSpec diffuse(const std::string& name, const std::vector<double>& rho, double tau = 0) {
    MaterialSpec material{name, {}, {}};
    for (const double each : rho) {
        SideOptics side;
        side.reflectance = each;
        side.transmittance = tau;
        material.upper.push_back(side);
    }
    material.lower = material.upper;
    return material;
}

OrganSpec square(const std::string& material, double half, double height) {
    OrganSpec organ;
    const Vec3 a{-half, -half, height}, b{half, -half, height}, c{half, half, height},
        d{-half, half, height};
    organ.parts.push_back({material, std::vector<Triangle>{{a, b, c}, {a, c, d}}});
    return organ;
}

/// A plane of 2 x 2 seen from above, 64 x 64 pixels.
class TrueLight : public ::testing::Test {
  protected:
    void add(const MaterialSpec& material) { builder_.add_material(material); }
    void add(OrganSpec organ) { builder_.add_organ(std::move(organ)); }
    Image look_down(unsigned threads = 1) {
        if (!scene_) {
            scene_ = std::move(builder_).build();
        }
        const Scene& scene = *scene_;
        ViewSpec view;
        view.azimuth_deg = 180;
        view.elevation_deg = 90;
        const Camera camera(view, scene.orientation(), scene.bounds(), 64, 64);
        TrueLightSpec spec;
        spec.width = spec.height = 64;
        spec.sources = &sources_;
        spec.bands = colors_of_bands(kColors);
        spec.scattered.assign(scene.organs().size() * kColors.size(), scattered_);
        spec.threads = threads;
        return render_true_light(scene, camera, spec);
    }

    SceneBuilder builder_{kColors};
    std::optional<Scene> scene_;
    Sources sources_{make_directional_source("sun", {0, 0, -1}, {100, 100, 100})};
    double scattered_ = 0;
};

/// The pixel value of light that is `part` times that of the brightest surface.
int written(double part) {
    const double toned = 1 - std::exp(-1.2 * part);
    return static_cast<int>(std::lround(255 * (1.055 * std::pow(toned, 1 / 2.4) - 0.055)));
}

TEST_F(TrueLight, HasTheColoursOfTheSurface) {
    add(diffuse("leaf", {.1, .4, .2}));
    add(square("leaf", 1, 0));
    const Rgb middle = look_down().at(32, 32);
    // Luminance of what is sent back is that of the brightest hundredth.
    const double luminance = 0.2126 * .2 + 0.7152 * .4 + 0.0722 * .1;
    EXPECT_NEAR(middle.r, written(.2 / luminance), 1);
    EXPECT_NEAR(middle.g, written(.4 / luminance), 1);
    EXPECT_NEAR(middle.b, written(.1 / luminance), 1);
}

TEST_F(TrueLight, LeavesShadowsToWhatIsScattered) {
    add(diffuse("soil", {.2, .2, .2}));
    add(diffuse("shade", {0, 0, 0}));
    add(square("soil", 1, 0));
    // Nearer to the sun, beside the line of sight: its shadow falls on the right half.
    OrganSpec shade = square("shade", .25, 0);
    sources_ = {
        make_directional_source("sun", {std::sqrt(.5), 0, -std::sqrt(.5)}, {100, 100, 100})};
    const Vec3 a{-1, -1, .9}, b{-.4, -1, .9}, c{-.4, 1, .9}, d{-1, 1, .9};
    shade.parts.front().triangles = std::vector<Triangle>{{a, b, c}, {a, c, d}};
    add(std::move(shade));
    const Image dark = look_down();
    const int lit = dark.at(60, 32).g, shadowed = dark.at(38, 32).g;
    EXPECT_NEAR(lit, written(1), 1);
    EXPECT_EQ(shadowed, 0);
    // Of 100 on a plane that faces the sun, 70.7 fall on the soil; 10 that were scattered, half of
    // them on either side, add as much again as 5.
    scattered_ = 10;
    const Image pale = look_down();
    const double sun = 100 * std::sqrt(.5) * .2, rest = 10 * .2 / 2;
    EXPECT_NEAR(pale.at(38, 32).g, written(rest / (sun + rest)), 2);
}

TEST_F(TrueLight, ShinesThroughLeaves) {
    add(diffuse("leaf", {0, 0, 0}, .5));
    add(square("leaf", 1, 0));
    sources_ = {make_directional_source("lamp", {0, 0, 1}, {100, 100, 100})};
    EXPECT_NEAR(look_down().at(32, 32).g, written(1), 1) << "lit from below, seen from above";
}

TEST_F(TrueLight, IsTheSameOnAnyNumberOfThreads) {
    add(diffuse("leaf", {.1, .4, .2}, .1));
    add(square("leaf", 1, 0));
    add(square("leaf", .3, .5));
    sources_.push_back(make_uniform_sky("sky", {50, 40, 30}));
    const Image one = look_down(1), four = look_down(4);
    for (std::size_t i = 0; i < one.pixels.size(); ++i) {
        ASSERT_EQ(one.pixels[i].r, four.pixels[i].r) << i;
        ASSERT_EQ(one.pixels[i].g, four.pixels[i].g) << i;
        ASSERT_EQ(one.pixels[i].b, four.pixels[i].b) << i;
    }
}

TEST(ColorsOfBands, AreTheirPartsOfTheSpectrum) {
    const auto colors = colors_of_bands({band_of("x", 550, 650), band_of("y", 400, 450)});
    ASSERT_EQ(colors.size(), 2U);
    EXPECT_EQ(colors[0], (LinearRgb{.5, .5, 0}));
    EXPECT_EQ(colors[1], (LinearRgb{0, 0, 1}));
    const auto grey = colors_of_bands({band_of("PAR"), band_of("NIR")});
    ASSERT_EQ(grey.size(), 2U);
    EXPECT_EQ(grey[0][0], grey[0][1]);
    EXPECT_EQ(grey[0][1], grey[0][2]);
    EXPECT_EQ(grey[1], LinearRgb{});
    // A colour that no band reaches is the mean of the others.
    const auto two = colors_of_bands({band_of("blue", 400, 500), band_of("red", 600, 700)});
    EXPECT_EQ(two[0], (LinearRgb{0, .5, 1}));
    EXPECT_EQ(two[1], (LinearRgb{1, .5, 0}));
    EXPECT_TRUE(colors_of_bands({band_of("NIR"), band_of("unheard of")}).empty());
}

}  // namespace
}  // namespace quasimc::test
