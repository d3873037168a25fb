#include "coupling/lighting.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling_testing.h"
#include "light/models/source.h"

namespace quasimc::test {
namespace {

Lighting lighting(const std::string& text, const std::map<std::string, std::string>& files = {}) {
    RecordedNotices kept;
    const Specification spec = specification(text, kept, files);
    return make_lighting(spec, spec.sky);
}

double horizontal(const Lighting& light) {
    double sum = 0;
    for (const auto& source : light.sources.front()) {
        sum += source->horizontal_irradiance() * source->spectrum()[0];
    }
    return sum;
}

double total_share(const Lighting& light) {
    double sum = 0;
    for (const LightShare& part : light.shares) {
        sum += part.share;
    }
    return sum;
}

TEST(Lighting, SharesTheIrradianceOutByWeights) {
    const Lighting light = lighting("light source: 0 -1 0 3\nlight source: 1 -1 0 1\n");
    ASSERT_EQ(light.sources.front().size(), 2U);
    EXPECT_DOUBLE_EQ(light.sources.front()[0]->spectrum()[0], 0.75);
    EXPECT_DOUBLE_EQ(light.sources.front()[1]->spectrum()[0], 0.25);
    // Twice all weights change nothing.
    EXPECT_DOUBLE_EQ(
        lighting("light source: 0 -1 0 6\nlight source: 1 -1 0 2\n")
            .sources.front()[0]
            ->spectrum()[0],
        0.75);
}

TEST(Lighting, OfAUniformSkyBringsHalfOfItselfToTheHorizontal) {
    // One direction in two of a hemisphere's light, weighted by the sine of its elevation.
    for (const char* text : {"sky: uniform\n", "sky file: s\n"}) {
        const Lighting light = lighting(text, {{"s", "2 2\n0 0 1 0 0 1 0 0 1 0 0 1"}});
        EXPECT_NEAR(horizontal(light), 0.5, 1e-6) << text;
        EXPECT_NEAR(light.on_horizontal(), 0.5, 1e-6) << text;
        EXPECT_NEAR(total_share(light), 1, 1e-12);
    }
}

TEST(Lighting, OfASkyFileWeighsCellsByRadianceAndSolidAngle) {
    // Two rings, 0 to 45 and 45 to 90 degrees, radiances 3 and 1.
    const Lighting light = lighting("sky file: s\n", {{"s", "1 2\n0 0 3\n0 0 1"}});
    const double low = 3 * std::sin(std::numbers::pi / 4);
    const double high = 1 - std::sin(std::numbers::pi / 4);
    const double on_horizontal =
        (low * 0.5 * std::sqrt(0.5) + high * 0.5 * (1 + std::sqrt(0.5))) / (low + high);
    EXPECT_NEAR(light.on_horizontal(), on_horizontal, 1e-12);
    EXPECT_NEAR(horizontal(light), on_horizontal, 1e-6);
}

TEST(Lighting, OfASkyFileStandsWhereTheFileSays) {
    // Only the azimuths from south to west have light: south is +x, west +z, up y.
    const Lighting light = lighting("sky file: s\n", {{"s", "4 1\n0 0 0\n0 0 0\n0 0 1\n0 0 0"}});
    ASSERT_EQ(light.shares.size(), 1U);
    const Vec3 from = -plant_orientation().outward(light.shares.front().travel);
    EXPECT_GT(from.x, 0);
    EXPECT_GT(from.z, 0);
    EXPECT_GT(from.y, 0);
    const auto& sky = *light.sources.front().front();
    const auto radiance = [&](const Vec3& to) {
        return model_of(sky).radiance(normalized(plant_orientation().inward(to)));
    };
    EXPECT_GT(radiance({1, 1, 1}), 0);
    EXPECT_EQ(radiance({1, 1, -1}), 0);
    EXPECT_EQ(radiance({-1, 1, 1}), 0);
}

/// Samples of a distribution function of zenith angle (which varies fastest) and azimuth, of a sky
/// whose radiance is a function of their cells, 3 x 4 of them.
std::string distribution(const std::function<double(int zenith, int azimuth)>& radiance) {
    std::string text = "# Distribution function F of a sky\n4 5\n";
    for (int a = 0; a <= 4; ++a) {
        for (int z = 0; z <= 3; ++z) {
            double sum = 0;
            for (int i = 0; i < z; ++i) {
                for (int j = 0; j < a; ++j) {
                    sum += radiance(i, j);
                }
            }
            text += fmt::format("{:g}\n", sum);
        }
        text += "# End of a row\n";
    }
    return text;
}

TEST(Lighting, OfADistributionFunctionIsWhatItGrowsBy) {
    const Lighting uniform =
        lighting("sky file: s\n", {{"s", distribution([](int, int) { return 1; })}});
    EXPECT_NEAR(uniform.on_horizontal(), 0.5, 1e-6);
    // As the page of the format shows it.
    const Lighting shown = lighting("sky file: s\n", {{"s", "# a sky\n2 3\n0\n0\n0\n0.5\n0\n1\n"}});
    EXPECT_NEAR(shown.on_horizontal(), 0.5, 1e-6);
    // Only the zenith, from north (z) to east (x).
    const Lighting light = lighting(
        "sky file: s\n",
        {{"s", distribution([](int z, int a) { return z == 0 && a == 0 ? 2 : 0; })}});
    ASSERT_EQ(light.shares.size(), 1U);
    const Vec3 from = -plant_orientation().outward(light.shares.front().travel);
    EXPECT_NEAR(from.y, 0.5 * (1 + std::cos(std::numbers::pi / 6)), 1e-12);
    EXPECT_NEAR(from.x, from.z, 1e-12);
    EXPECT_GT(from.x, 0);
}

TEST(Lighting, OfADistributionFunctionMayHaveIntensitiesBeside) {
    RecordedNotices kept;
    const auto sky = specification("sky file: s\n", kept, {{"s", "2 2\n0 1\n0 1\n0 1\n1 1\n"}});
    EXPECT_EQ(sky.sky_table->radiance, (std::vector<double>{1}));
    EXPECT_TRUE(kept.has("distribution function as in MonteCarlo"));
}

TEST(Lighting, OfAFileThatIsNoSkyIsRefusedWithTheNumbersItHas) {
    EXPECT_NE(
        faults_of("sky file: s\n", {{"s", "2 2\n0 1 0.5 0.2"}}).find("falls by 1.3"),
        std::string::npos);
    const std::string faults = faults_of("sky file: s\n", {{"s", "2 2\n1 1 1 1 1"}});
    EXPECT_NE(faults.find("2 x 2 cells, but 5 numbers"), std::string::npos) << faults;
    EXPECT_NE(faults.find("has 12"), std::string::npos) << faults;
    EXPECT_NE(
        faults_of("sky file: s\n", {{"s", "1 2\n0 0 1 0 0 x"}}).find("radiance of cell 2 of 2"),
        std::string::npos);
}

TEST(Lighting, OfAClearDayHasItsSun) {
    const std::string noon = "location: 45 0\ngrowth period: 12 12\njulian day: 172\n";
    const Lighting with = lighting(noon), without = lighting(noon + "direct sun: no\n");
    EXPECT_EQ(with.sources.front().size(), 2U);
    EXPECT_EQ(without.sources.front().size(), 1U);
    EXPECT_EQ(lighting(noon + "weather: 0 2.45\n").sources.front().size(), 1U);
    // High in the south in June.
    const Vec3 from = -plant_orientation().outward(with.shares.front().travel);
    EXPECT_GT(from.x, 0.2);
    EXPECT_NEAR(from.z, 0, 0.05);
    EXPECT_NEAR(from.y, std::sin((90 - 45 + 23.44) * std::numbers::pi / 180), 0.01);
    EXPECT_GT(with.shares.front().share, 0.5);
}

TEST(Lighting, OfTheNightIsNone) {
    EXPECT_TRUE(lighting("location: 45 0\ngrowth period: 0 1\n").shares.empty());
}

TEST(Lighting, FollowsTheMeridiansOfTimeZones) {
    // Seven degrees east of the zone's meridian the sun is 28 minutes ahead.
    const auto afternoon = [](const char* longitude) {
        const Lighting light =
            lighting(std::string("location: 45 ") + longitude + "\ngrowth period: 15 15\n");
        return -plant_orientation().outward(light.shares.front().travel).y;
    };
    EXPECT_NEAR(afternoon("15"), afternoon("0"), 1e-12);
    EXPECT_LT(afternoon("7"), afternoon("0"));
    EXPECT_GT(afternoon("-7"), afternoon("0"));
}

}  // namespace
}  // namespace quasimc::test
