#include <cmath>

#include <gtest/gtest.h>

#include "light/models/source.h"
#include "scene/scene.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// A file with bands R and FR and the given materials; the first is "leaf".
RunText two_bands(std::string materials) {
    RunText text;
    text.top = "bands = ['R', 'FR']\n";
    text.materials = std::move(materials);
    return text;
}

const Material& leaf_of(const RunFile& run) {
    return data_of(run.scene).materials.front();
}

TEST(MaterialKeys, OneNumberCountsForAllBands) {
    const RunFile run = read_text(
        two_bands("[[material]]\nname = 'leaf'\nreflectance = 0.1\ntransmittance = 0.2\n").text());
    for (const SurfaceSide side : kSurfaceSides) {
        for (const double absorptance : leaf_of(run).side(side).absorptance()) {
            EXPECT_DOUBLE_EQ(absorptance, 0.7);
        }
    }
}

TEST(MaterialKeys, AListOrATableGivesEachBandItsOwn) {
    for (const char* values : {"[0.1, 0.4]", "{ FR = 0.4, R = 0.1 }"}) {
        const RunFile run = read_text(
            two_bands(std::string("[[material]]\nname = 'leaf'\nreflectance = ") + values + "\n")
                .text());
        EXPECT_DOUBLE_EQ(leaf_of(run).side(SurfaceSide::upper).absorptance()[0], 0.9);
        EXPECT_DOUBLE_EQ(leaf_of(run).side(SurfaceSide::upper).absorptance()[1], 0.6);
    }
}

TEST(MaterialKeys, ASideGoesBeforeTheCommonValues) {
    const RunFile run =
        read_text(two_bands("[[material]]\nname = 'leaf'\nreflectance = 0.1\ntransmittance = 0.3\n"
                            "[material.lower]\nreflectance = 0.2\n")
                      .text());
    EXPECT_DOUBLE_EQ(leaf_of(run).side(SurfaceSide::upper).absorptance()[0], 0.6);
    EXPECT_DOUBLE_EQ(leaf_of(run).side(SurfaceSide::lower).absorptance()[0], 0.5);
}

TEST(MaterialKeys, AModelOfASideNeedsAnExponentOfItsOwn) {
    const std::string common = "[[material]]\nname = 'leaf'\nreflectance = 0.1\n";
    const auto faults = [&](const std::string& keys) {
        return faults_of(two_bands(common + keys).text());
    };
    EXPECT_TRUE(faults("reflection_model = 'phong'\nreflection_exponent = 5\n").empty());
    EXPECT_TRUE(mentions(faults("reflection_model = 'phong'\n"), "reflection_exponent is missing"));
    EXPECT_TRUE(mentions(faults("reflection_exponent = 5\n"), "reflection_exponent is given"));
    EXPECT_TRUE(faults("reflection_model = 'phong'\nreflection_exponent = 5\n"
                       "[material.lower]\nreflection_model = 'lambertian'\n")
                    .empty());
    EXPECT_TRUE(mentions(
        faults("[material.upper]\nreflection_model = 'phong'\n"),
        "reflection_exponent is missing"));
}

TEST(MaterialKeys, ModelsMayDifferBetweenBands) {
    EXPECT_TRUE(
        faults_of(
            two_bands("[[material]]\nname = 'leaf'\nreflectance = 0.1\n"
                      "reflection_model = ['phong', 'lambertian']\nreflection_exponent = [5, 50]\n")
                .text())
            .empty());
}

struct BadMaterial {
    std::string keys, problem;
};

TEST(MaterialKeys, RefuseWhatIsWrong) {
    const std::vector<BadMaterial> table{
        {"reflectance = 1.5\n", "reflectance is 1.5 (it must be 0 to 1)"},
        {"reflectance = -0.1\n", "reflectance is -0.1"},
        {"reflectance = nan\n", "reflectance is nan"},
        {"reflectance = 'much'\n", "reflectance is a text (it must be a number)"},
        {"reflectance = [0.1]\n", "reflectance has 1 value (the run has 2 bands)"},
        {"reflectance = [0.1, 0.1, 0.1]\n", "reflectance has 3 values"},
        {"reflectance = { R = 0.1 }\n", "FR is missing"},
        {"reflectance = { R = 0.1, FR = 0.1, B = 0.1 }\n", "unknown key 'B'"},
        {"reflectance = { R = 0.1, FR = true }\n", "reflectance is true or false"},
        {"reflectance = 0.5\ntransmittance = 0.6\n",
         "material 'leaf': band R: reflectance 0.5 + transmittance 0.6 exceeds 1"},
        {"reflectence = 0.5\n", "did you mean 'reflectance'?"},
        {"", "reflectance is missing"},
        {"reflectance = 0.5\nreflection_model = 'pong'\nreflection_exponent = 3\n",
         "did you mean 'phong'?"},
        {"reflectance = 0.5\nreflection_model = 3\n", "reflection_model is an integer"},
        {"reflectance = 0.5\nreflection_model = 'phong'\nreflection_exponent = -1\n",
         "reflection_exponent is -1"},
        {"reflectance = 0.5\nlower = 3\n",
         "lower side: is an integer (it must be a table of keys)"},
        {"reflectance = 0.5\n[material.lower]\nreflectance = 2\n", "lower side: reflectance is 2"},
        {"reflectance = 0.5\n[material.lower]\ntransmittance = [0.5, 0.6]\n",
         "lower side, band FR: reflectance 0.5 + transmittance 0.6"},
    };
    for (const BadMaterial& bad : table) {
        const auto faults = faults_of(two_bands("[[material]]\nname = 'leaf'\n" + bad.keys).text());
        EXPECT_TRUE(mentions(faults, bad.problem)) << bad.problem << "\n"
                                                   << ::testing::PrintToString(faults);
        EXPECT_EQ(faults.size(), 1U) << bad.problem << "\n" << ::testing::PrintToString(faults);
    }
}

TEST(MaterialKeys, AMaterialWithoutANameIsRefused) {
    RunText text;
    text.materials += "[[material]]\nreflectance = 0.1\n";
    EXPECT_TRUE(mentions(faults_of(text.text()), "material: name is missing"));
}

TEST(BandKeys, RefuseWhatIsWrong) {
    const auto faults = [](const std::string& top) {
        RunText text;
        text.top = top;
        return faults_of(text.text());
    };
    EXPECT_TRUE(mentions(faults(""), "no band is given"));
    EXPECT_TRUE(mentions(faults("bands = []\n"), "no band is given"));
    EXPECT_TRUE(mentions(faults("bands = 'PAR'\n"), "bands is a text"));
    EXPECT_TRUE(mentions(faults("bands = ['PAR', 'PAR']\n"), "PAR"));
    EXPECT_TRUE(mentions(faults("bands = ['']\n"), "band"));
    EXPECT_TRUE(mentions(faults("bands = ['a:b']\n"), "a name must not contain ':'"));
    EXPECT_TRUE(
        mentions(faults("bands = ['A']\n[[band]]\nname = 'B'\n"), "both bands and [[band]]"));
    EXPECT_TRUE(mentions(faults("[[band]]\nunit = 'W'\n"), "name is missing"));
}

/// A file whose source has the given keys.
RunText with_source(const std::string& keys) {
    RunText text;
    text.sources = "[[source]]\nname = 'sun'\n" + keys;
    return text;
}

TEST(SourceKeys, IrradianceOnTheHorizontalIsTurnedToTheFacingPlane) {
    const RunFile run =
        read_text(with_source("type = 'directional'\nazimuth_deg = 90\nelevation_deg = 30\n"
                              "irradiance_horizontal = 100\n")
                      .text());
    ASSERT_EQ(run.sources.size(), 1U);
    EXPECT_NEAR(run.sources[0]->spectrum()[0], 200, 1e-9);
    EXPECT_NEAR(run.sources[0]->spectrum()[0] * run.sources[0]->horizontal_irradiance(), 100, 1e-9);
}

TEST(SourceKeys, AzimuthsCountClockwiseFromNorth) {
    const RunFile run =
        read_text(with_source("type = 'directional'\nazimuth_deg = 90\nelevation_deg = 0\n"
                              "irradiance_facing = 1\n")
                      .text());
    const Vec3 to_light = model_of(*run.sources[0]).illuminate({}, .5, .5).to_light;
    EXPECT_LT(length(to_light - Vec3{1, 0, 0}), 1e-9);
    EXPECT_NE(run.source_notes[0].find("azimuth 90 deg, elevation 0 deg"), std::string::npos)
        << run.source_notes[0];
}

TEST(SourceKeys, DirectionsMayHaveAnyLength) {
    for (const char* direction : {"[0, 0, -1e300]", "[0, 0, -1e-300]", "[0, 0, -3]"}) {
        const RunFile run =
            read_text(with_source(
                          std::string("type = 'directional'\nirradiance_facing = 1\ndirection = ") +
                          direction + "\n")
                          .text());
        EXPECT_DOUBLE_EQ(run.sources[0]->horizontal_irradiance(), 1) << direction;
    }
}

TEST(SourceKeys, ASkyLightsTheHorizontal) {
    const RunFile run =
        read_text(with_source("type = 'uniform_sky'\nirradiance_horizontal = 5\n").text());
    EXPECT_DOUBLE_EQ(run.sources[0]->spectrum()[0], 5);
    EXPECT_FALSE(run.sources[0]->is_directional());
}

TEST(SourceKeys, WarnOfASunBelowTheHorizon) {
    const RunFile run = read_text(
        with_source("type = 'directional'\ndirection = [0, 0, 1]\nirradiance_facing = 1\n").text());
    ASSERT_FALSE(run.warnings.empty());
    EXPECT_NE(run.warnings[0].text.find("below the horizon"), std::string::npos);
}

TEST(SourceKeys, RefuseWhatIsWrong) {
    const std::vector<BadMaterial> table{
        {"", "type is missing"},
        {"type = 'lamp'\n", "type: 'lamp' is not one of"},
        {"type = 'directional'\nirradiance_facing = 1\n", "its direction is missing"},
        {"type = 'directional'\nirradiance_facing = 1\ndirection = [0, 0, -1]\nazimuth_deg = 3\n",
         "direction and angles"},
        {"type = 'directional'\nirradiance_facing = 1\nazimuth_deg = 3\n",
         "elevation_deg is missing"},
        {"type = 'directional'\nirradiance_facing = 1\nazimuth_deg = 3\nelevation_deg = 91\n",
         "elevation_deg is 91"},
        {"type = 'directional'\nirradiance_facing = 1\ndirection = [0, 0]\n",
         "direction is a list of 2"},
        {"type = 'directional'\nirradiance_facing = 1\ndirection = [0, 0, inf]\n",
         "direction is inf"},
        {"type = 'directional'\ndirection = [0, 0, -1]\n", "its irradiance is missing"},
        {"type = 'directional'\ndirection = [0, 0, -1]\nirradiance_facing = "
         "1\nirradiance_horizontal = 1\n",
         "two irradiances"},
        {"type = 'directional'\ndirection = [1, 0, 0]\nirradiance_horizontal = 1\n",
         "of a source below the horizon"},
        {"type = 'directional'\ndirection = [0, 0, -1]\nirradiance_facing = -1\n",
         "irradiance_facing is -1"},
        {"type = 'directional'\ndirection = [0, 0, -1]\nirradiance_facing = 1\nsize = 3\n",
         "unknown key 'size'"},
        {"type = 'uniform_sky'\n", "irradiance_horizontal is missing"},
        {"type = 'uniform_sky'\nirradiance_horizontal = 1\ndirection = [0, 0, -1]\n",
         "unknown key 'direction'"},
        {"type = 'uniform_sky'\nirradiance_horizontal = 0\n", "no source gives light"},
    };
    for (const BadMaterial& bad : table) {
        const auto faults = faults_of(with_source(bad.keys).text());
        EXPECT_TRUE(mentions(faults, bad.problem)) << bad.problem << "\n"
                                                   << ::testing::PrintToString(faults);
        EXPECT_EQ(faults.size(), 1U) << bad.problem << "\n" << ::testing::PrintToString(faults);
    }
}

TEST(SourceKeys, AtLeastOneSourceIsNeeded) {
    RunText text;
    text.sources.clear();
    EXPECT_TRUE(mentions(faults_of(text.text()), "no source of light is given"));
}

}  // namespace
}  // namespace quasimc::test
