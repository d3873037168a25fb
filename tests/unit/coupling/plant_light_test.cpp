#include "coupling/plant_light.h"

#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

/// What the directives below compute is known: black leaves, light from above, no overlap.
const std::string kBlack = "leaf material (top): 0 0 0 0\nnumber of rays: 1024\n";
constexpr double kMargin = 2e-4;  // by which the window of the light is larger than the leaf

class PlantLightTest : public ::testing::Test {
  protected:
    std::map<std::int64_t, std::vector<double>> answers(
        const std::string& text, const std::string& queries) {
        PlantLight light(specification(text, kept_, {{"leaf.s", square_surface()}}), kept_.notices);
        return answers_of(light, queries);
    }
    double first(const std::string& text, const std::string& queries) {
        return answers(text, queries).at(0).at(0);
    }

    KeptNotices kept_;
};

TEST_F(PlantLightTest, ReturnsWhatTheLettersSay) {
    const std::string leaf = flat(0, "P(1,2)", 1);  // of area 2
    EXPECT_NEAR(first(kBlack + "return type: F\n", leaf), 2, 2 * kMargin);
    EXPECT_NEAR(first(kBlack + "return type: D\n", leaf), 1, kMargin);
    EXPECT_NEAR(first(kBlack + "return type: U\n", leaf), 1, kMargin);
    EXPECT_EQ(first(kBlack + "return type: L\n", leaf), 0);
    EXPECT_NEAR(first(kBlack + "return type: H\nsource spectrum: 660 5\n", leaf), 1, kMargin);
    EXPECT_NEAR(first(kBlack + "return type: U\nsource spectrum: 660 5\n", leaf), 5, 5 * kMargin);
}

TEST_F(PlantLightTest, LetsOrgansWithNegativeQuestionsShadeOnly) {
    const auto all =
        answers(kBlack + "return type: D\n", flat(0, "P(1,2)", 1) + flat(1, "P(1,2)", 2, "E(-1)"));
    EXPECT_EQ(all.size(), 1U);
    EXPECT_NEAR(all.at(0).at(0), 0, 1e-12);
}

TEST_F(PlantLightTest, AnswersWhatItDoesNotUnderstandWithZeroAndANotice) {
    const auto all = answers(kBlack, flat(0, "X(1,2)", 1) + flat(1, "P(1,2)", 2));
    EXPECT_EQ(all.at(0).at(0), 0);
    EXPECT_TRUE(kept_.has("'X' is not understood"));
}

TEST_F(PlantLightTest, AnswersSeveralBandsAndLeavesSlotsEmpty) {
    const std::string bands =
        "spectrum samples: 3\nsource spectrum: 1 1 2 2 3 0\nreturn type: D U D\n"
        "leaf material (top): 0 0 0 0\n: 0.5 0 0 0\n: 0 0 0 0\n";
    for (const char* one_ray : {"yes", "no"}) {
        const auto all = answers(
            bands + "one ray per spectrum: " + one_ray, flat(0, "P(1,2)", 1, "E(1,0,0,0,0)"));
        ASSERT_EQ(all.at(0).size(), 3U);
        EXPECT_NEAR(all.at(0)[0], 1, kMargin);
        EXPECT_NEAR(all.at(0)[1], 2, 2 * kMargin);
        EXPECT_EQ(all.at(0)[2], 0);
    }
    EXPECT_TRUE(kept_.texts.empty());
    static_cast<void>(answers(bands, flat(0, "P(1,2)", 1, "E(1)")));
    EXPECT_TRUE(kept_.has("3 values"));
}

TEST_F(PlantLightTest, ReturnsQuantitiesByName) {
    const auto all = answers(
        kBlack + "number of runs: 2\nquantities: incident_upper sunlit_fraction absorbed_flux\n",
        flat(0, "P(1,2)", 1, "E(1,0,0)"));
    ASSERT_EQ(all.at(0).size(), 3U);
    EXPECT_NEAR(all.at(0)[0], 1, kMargin);
    EXPECT_NEAR(all.at(0)[1], 1, kMargin);
    EXPECT_NEAR(all.at(0)[2], 2, 2 * kMargin);
}

TEST_F(PlantLightTest, IgnoresDirectLightWhenTold) {
    const std::string leaf = flat(0, "P(1,2)", 1);
    EXPECT_EQ(first(kBlack + "ignore direct light: yes\nreturn type: D\n", leaf), 0);
    // A white ground sends the light that misses the leaf back to its lower side.
    const std::string ground =
        "ground: 0 1\nmaterial: 1 0 0 0\nmaximum depth: 3\n"
        "canopy period: 10 10 -5 -5\nreturn type: L\n";
    EXPECT_GT(first(kBlack + ground + "ignore direct light: yes\n", leaf), 0.5);
}

TEST_F(PlantLightTest, TakesSettingsFromModules) {
    PlantLight light(
        specification(kBlack + "location: 45 0\ngrowth period: 12 12\n", kept_), kept_.notices);
    const auto with_settings =
        answers_of(light, flat(0, "Q(64)", 0) + flat(1, "J(100,0,2.45)", 0) + flat(2, "P(1,2)", 1));
    EXPECT_EQ(with_settings.size(), 1U);
    EXPECT_EQ(light.last().results.front().paths, 64U);
    EXPECT_GT(with_settings.at(2).at(0), 0);
    EXPECT_TRUE(kept_.texts.empty());
    static_cast<void>(answers_of(light, flat(0, "J(400)", 0) + flat(1, "Q(0)", 0)));
    EXPECT_TRUE(kept_.has("J(day"));
    EXPECT_TRUE(kept_.has("Q(rays"));
}

TEST_F(PlantLightTest, IsDarkAtNight) {
    EXPECT_EQ(first(kBlack + "location: 45 0\ngrowth period: 0 0.5\n", flat(0, "P(1,2)", 1)), 0);
    EXPECT_TRUE(kept_.has("no light"));
}

TEST_F(PlantLightTest, KeepsTheGeometryOfAStandingPlant) {
    PlantLight light(specification(kBlack, kept_), kept_.notices);
    const std::string leaf = flat(0, "P(1,2)", 1);
    const double before = answers_of(light, leaf).at(0).at(0);
    EXPECT_NEAR(answers_of(light, leaf).at(0).at(0), before, 2 * kMargin);
    EXPECT_EQ(light.builds(), 1U);
    static_cast<void>(answers_of(light, flat(0, "P(1,3)", 1)));
    EXPECT_EQ(light.builds(), 2U);
}

TEST_F(PlantLightTest, LetsSensorsSeeWithoutShading) {
    const std::string sensors =
        "rays from objects: yes\nnumber of rays: 4096\nsky: uniform\nreturn type: H\n"
        "leaf material (top): 0 0 0 0\n";
    const std::string two = flat(0, "P(1,1)", 1) + flat(1, "P(1,1)", 2);
    const auto open = answers(sensors, two);
    EXPECT_NEAR(open.at(0).at(0), 1, 1e-6);  // the sensor above is not there
    EXPECT_NEAR(open.at(1).at(0), 1, 1e-6);
    const auto covered =
        answers(sensors, flat(0, "P(1,1)", 1) + flat(1, "P(100,200)", 1.01, "E(-1)"));
    EXPECT_LT(covered.at(0).at(0), 0.6);
}

TEST_F(PlantLightTest, LetsSensorsSeeInACone) {
    const std::string uniform = "sky: uniform\nreturn type: U\nnumber of rays: 16384\n";
    const std::string sensor = flat(0, "P(1,1)", 1);
    const double whole = first(uniform + "rays from objects: yes\n", sensor);
    const double cone = first(uniform + "rays from objects: yes 30\n", sensor);
    // Irradiance from a cone of half angle a about the normal: sin^2 a of the hemisphere's.
    constexpr double kTolerance = 0.01;
    EXPECT_NEAR(whole, 0.5, kTolerance);
    EXPECT_NEAR(cone / whole, 0.25, kTolerance);
}

/// What a sensor reads under a light is the irradiance on it, however far its view.
TEST_F(PlantLightTest, LetsSensorsReadTheIrradiance) {
    const std::string tilted =
        "0 E(1)P(1,1)\n 0 1 0\n 0 0.8660254 -0.5\n -1 0 0\n 0 0.5 0.8660254\n";
    for (const char* angle : {"", "80"}) {
        const std::string sensors =
            "return type: U\nsource spectrum: 660 3\nrays from objects: yes ";
        EXPECT_NEAR(first(sensors + angle + "\n", flat(0, "P(1,1)", 1)), 3, 1e-6) << angle;
        EXPECT_NEAR(first(sensors + angle + "\n", tilted), 1.5, 1e-6) << angle;
    }
    EXPECT_EQ(first("return type: U\nrays from objects: yes 50\n", tilted), 0);  // beyond its view
}

/// Any number of sensors and rays, whatever numbers of points a method is made for.
TEST_F(PlantLightTest, TakesAnyNumberOfSensors) {
    for (const char* method : {"monte carlo", "korobov", "sobol", "halton", "faure"}) {
        const std::string text =
            "rays from objects: yes\nsky: uniform\nreturn type: U\nnumber of rays: 4000\n"
            "sampling method: " +
            std::string(method) + "\n";
        std::string sensors;
        for (int count = 1; count <= 7; ++count) {
            sensors += flat(count, "P(1,1)", count);
            for (const auto& [id, values] : answers(text, sensors)) {
                EXPECT_NEAR(values.at(0), 0.5, 0.02) << method << ", sensor " << id;
            }
        }
    }
}

TEST_F(PlantLightTest, ReachesATargetError) {
    PlantLight light(
        specification(
            "target error: 0.02 1\nnumber of rays: 256\nsampling method: monte carlo\n", kept_),
        kept_.notices);
    static_cast<void>(answers_of(light, flat(0, "P(1,2)", 1) + flat(1, "P(1,2)", 0.5)));
    EXPECT_EQ(light.last().results.front().stop, StopReason::target_reached);
    EXPECT_GT(light.last().results.front().paths, 256U);
}

TEST_F(PlantLightTest, EndsWhenAskedTo) {
    PlantLight light(
        specification("number of rays: 1073741824\nnumber of runs: 100\n", kept_), kept_.notices);
    Answers answers;
    EXPECT_THROW(
        light.answer(
            pass_of(flat(0, "P(1,2)", 1)), [] { throw PeerDisconnected("gone"); }, answers),
        PeerDisconnected);
}

}  // namespace
}  // namespace quasimc::test
