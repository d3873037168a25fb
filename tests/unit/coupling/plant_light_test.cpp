#include "coupling/plant_light.h"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "coupling_testing.h"
#include "solvers/catalogue.h"

namespace quasimc::test {
namespace {

/// What the directives below compute is known: black leaves, light from above, no overlap.
const std::string kBlack = "leaf material (top): 0 0 0 0\nnumber of rays: 16384\n";
constexpr double kMargin = 2e-4;  // more than the error of the scan lines

class PlantLightTest : public ::testing::Test {
  protected:
    std::map<std::int64_t, std::vector<double>> answers(
        const std::string& text, const std::string& queries) {
        PlantLight light(
            specification(text, cached_, {{"leaf.s", square_surface()}}), cached_.notices);
        return answers_of(light, queries);
    }
    double first(const std::string& text, const std::string& queries) {
        return answers(text, queries).at(0).at(0);
    }

    RecordedNotices cached_;
};

/// A model subtracts it from 1.
TEST(StepLight, HasSunlitFractionsOfAtMostOne) {
    StepLight light;
    light.results.resize(1);
    light.results[0].sunlit_fraction = {{1.23, .2, .67, 1}};
    const std::optional<Estimate> sunlit = light.sunlit(0);
    ASSERT_TRUE(sunlit);
    EXPECT_EQ(sunlit->mean, 1);
}

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
    EXPECT_TRUE(cached_.has("'X' is unknown"));
}

TEST_F(PlantLightTest, WarnsOnceOfOrgansThatLieOnEachOther) {
    PlantLight light(specification(kBlack, cached_), cached_.notices);
    const std::string apart = flat(0, "P(1,2)", 1) + flat(1, "P(1,2)", 2);
    static_cast<void>(answers_of(light, apart));
    const std::size_t before = cached_.texts.size();
    EXPECT_FALSE(cached_.has("black")) << "as it is stated";
    const std::string onto = apart + flat(2, "P(1,2)", 2);
    static_cast<void>(answers_of(light, onto));
    EXPECT_TRUE(cached_.has("have the same corners as triangles of organ 'P' (id 2)"));
    EXPECT_EQ(cached_.texts.size(), before + 1);
    static_cast<void>(answers_of(light, onto + flat(3, "P(1,2)", 1)));
    EXPECT_EQ(cached_.texts.size(), before + 1);
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
    EXPECT_TRUE(cached_.texts.empty());
    static_cast<void>(answers(bands, flat(0, "P(1,2)", 1, "E(1)")));
    EXPECT_TRUE(cached_.has("3 values"));
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
        specification(kBlack + "location: 45 0\ngrowth period: 12 12\n", cached_), cached_.notices);
    const auto with_settings =
        answers_of(light, flat(0, "Q(64)", 0) + flat(1, "J(100,0,2.45)", 0) + flat(2, "P(1,2)", 1));
    EXPECT_EQ(with_settings.size(), 1U);
    EXPECT_EQ(light.last().results.front().paths, 64U);
    EXPECT_GT(with_settings.at(2).at(0), 0);
    EXPECT_TRUE(cached_.texts.empty());
    static_cast<void>(answers_of(light, flat(0, "J(400)", 0) + flat(1, "Q(0)", 0)));
    EXPECT_TRUE(cached_.has("J(day"));
    EXPECT_TRUE(cached_.has("Q(rays"));
}

TEST_F(PlantLightTest, IsDarkAtNight) {
    EXPECT_EQ(first(kBlack + "location: 45 0\ngrowth period: 0 0.5\n", flat(0, "P(1,2)", 1)), 0);
    EXPECT_TRUE(cached_.has("no light"));
}

TEST_F(PlantLightTest, KeepsTheGeometryOfAStandingPlant) {
    PlantLight light(specification(kBlack, cached_), cached_.notices);
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
            "target error: 0.02 1\nnumber of rays: 256\nsampling method: monte carlo\n"
            "method: light_tracing\n",
            cached_),
        cached_.notices);
    static_cast<void>(answers_of(light, flat(0, "P(1,2)", 1) + flat(1, "P(1,2)", 0.5)));
    EXPECT_EQ(light.last().results.front().stop, StopReason::target_reached);
    EXPECT_GT(light.last().results.front().paths, 256U);
}

TEST_F(PlantLightTest, EndsWhenAskedTo) {
    PlantLight light(
        specification("number of rays: 1073741824\nnumber of runs: 100\n", cached_),
        cached_.notices);
    Answers answers;
    EXPECT_THROW(
        light.answer(
            pass_of(flat(0, "P(1,2)", 1)), [] { throw PeerDisconnected("gone"); }, answers),
        PeerDisconnected);
}

/// Leaves one above the other, which shade each other in part; the lowest lies upside down.
std::string pile(int asking, int shading) {
    std::string queries;
    for (int i = 0; i < asking + shading; ++i) {
        queries += fmt::format(
            "{} E({})P({},1)\n {} {} 0\n 0 0 -1\n -1 0 0\n 0 {} 0\n", i, i < asking ? 1 : -1,
            0.5 + 0.1 * i, 0.2 * i, 0.3 * i, i == 0 ? -1 : 1);
    }
    return queries;
}

TEST_F(PlantLightTest, UsesTheMethodThatAutoFindsBest) {
    const auto method_of = [&](const std::string& text, const std::string& queries) {
        PlantLight light(specification(text, cached_), cached_.notices);
        static_cast<void>(answers_of(light, queries));
        return light.last().results.front().chosen.method;
    };
    EXPECT_EQ(method_of("", pile(3, 0)), Method::first_hits);
    EXPECT_EQ(method_of("sky: uniform\n", pile(3, 0)), Method::from_organs);
    EXPECT_EQ(method_of("method: light_tracing\n", pile(3, 0)), Method::light_tracing);
    EXPECT_EQ(method_of("method: auto\n", pile(3, 0)), Method::first_hits);
    EXPECT_EQ(method_of("rays from objects: yes\n", pile(1, 2)), Method::from_organs);
    // A leaf in twenty asks: the others need no rays of their own, unless all are to be shown.
    EXPECT_EQ(method_of("", pile(1, 19)), Method::from_organs);
    EXPECT_EQ(faults_of("method: guess\n").find("guess") == std::string::npos, false);
}

/// Leaves around a stem; of a plant `spread` times as wide they are a small part.
std::string leaves_around_a_stem(int count, double spread) {
    constexpr double kGoldenAngle = 2.399963229728653;
    std::string queries;
    for (int i = 0; i < count; ++i) {
        const double c = std::cos(kGoldenAngle * i), s = std::sin(kGoldenAngle * i);
        const double radius = spread * std::sqrt(i % 97);
        queries += fmt::format(
            "{} E(1)P(0.2,0.5)\n {} {} {}\n {} 0.5 {}\n {} 0 {}\n {} -0.866025 {}\n", i, radius * c,
            0.02 * spread * i, radius * s, 0.866025 * c, 0.866025 * s, -s, c, 0.5 * c, 0.5 * s);
    }
    return queries;
}

/// Few rays mean speed: no method with more work is chosen for the sake of its errors.
TEST_F(PlantLightTest, IsBoundByTheNumberOfRays) {
    const auto run = [&](const std::string& text, const std::string& queries) {
        PlantLight light(specification(text, cached_), cached_.notices);
        static_cast<void>(answers_of(light, queries));
        return light.last().results.front();
    };
    constexpr double kAtMost = 1.5;
    for (const char* sky : {"", "sky: uniform\n"}) {
        for (const char* rays : {"number of rays: 1024\n", "number of rays: 8192\n"}) {
            for (const double spread : {0.2, 20.0}) {
                const std::string text = std::string(sky) + rays;
                const std::string leaves = leaves_around_a_stem(50, spread);
                const Result bounded = run(text, leaves);
                const Result plain = run(text + "method: light_tracing\n", leaves);
                const auto rays_traced = static_cast<double>(bounded.rays);
                EXPECT_LE(rays_traced, kAtMost * static_cast<double>(plain.rays))
                    << text << find_solver(bounded.chosen.method)->name;
                EXPECT_LE(bounded.paths, plain.paths) << text;
                EXPECT_EQ(
                    bounded.chosen.method, spread > 1 ? Method::from_organs : Method::first_hits)
                    << text;
                EXPECT_NE(bounded.chosen.reason, "requested");
            }
        }
    }
    // A target bounds the work by itself, and a requested method is used.
    const std::string leaves = leaves_around_a_stem(50, 0.2);
    const std::string few = "number of rays: 1024\n";
    EXPECT_EQ(run(few + "target error: 0.1\n", leaves).chosen.method, Method::ray_bundles);
    EXPECT_EQ(run(few + "method: ray_bundles\n", leaves).chosen.method, Method::ray_bundles);
}

/// At sunrise next to nothing of the sun comes through fog. The value was integrated over cells
/// of 1.5 degrees by a program of its own; the original has 0.239, for the squares of radiances
/// without their solid angles.
TEST_F(PlantLightTest, HasLightOnFoggyDays) {
    const std::string day = "location: 51 -114\njulian day: 200\nreturn type: D\n";
    const std::string leaf = flat(0, "P(1,1)", 1);
    const double hazy = first(day + "weather: 1 45\n", leaf);
    for (const char* turbidity : {"46", "50", "60", "64"}) {
        const double foggy = first(day + "weather: 1 " + turbidity + "\n", leaf);
        EXPECT_NEAR(foggy, hazy, 0.01 * hazy) << turbidity;
        EXPECT_NEAR(foggy, 0.2159, 0.002) << turbidity;  // half of what falls on the leaf
    }
    PlantLight light(specification(day, cached_), cached_.notices);
    const std::string setting = "1 E(1)J(200,1,64)\n 0 0 0\n 0 1 0\n -1 0 0\n 0 0 1\n";
    EXPECT_NEAR(answers_of(light, setting + leaf).at(0).at(0), hazy, 0.01 * hazy);
}

TEST_F(PlantLightTest, AnswersAlikeByEveryMethod) {
    const std::string two_bands =
        "spectrum samples: 2\nsource spectrum: 660 1 730 3\nreturn type: U L\n"
        "leaf material (top): 0.1 0 0.1 0\n: 0.4 0 0.4 0\nmaximum depth: -1\n"
        "number of rays: 262144\n";
    const std::string cells = "3 2\n0 0 1 0 0 2 0 0 3 0 0 4 0 0 5 0 0 6\n";
    for (const char* light :
         {"light source: 0.3 -1 0.1 3\nlight source: -1 -1 0 1\n", "sky file: cells\n",
          "sky file: cells\none ray per spectrum: no\n",
          "light source: 0.3 -1 0.1 1\nignore direct light: yes\n"}) {
        const auto answers_by = [&](const std::string& method) {
            PlantLight plant(
                specification(two_bands + light + method, cached_, {{"cells", cells}}),
                cached_.notices);
            std::string queries = pile(4, 1);
            for (std::size_t at = 0; (at = queries.find("E(1)", at)) != std::string::npos; ++at) {
                queries.replace(at, 4, "E(1,0)");
            }
            return answers_of(plant, queries);
        };
        const auto expected = answers_by("method: light_tracing\n");
        for (const char* method : {"", "method: from_organs\n"}) {
            const auto found = answers_by(method);
            ASSERT_EQ(found.size(), 4U);
            for (const auto& [id, values] : expected) {
                for (std::size_t b = 0; b < values.size(); ++b) {
                    constexpr double kNoise = 0.02;
                    EXPECT_NEAR(found.at(id).at(b), values[b], kNoise * (1 + values[b]))
                        << light << method << id << " " << b;
                }
            }
        }
    }
}

TEST_F(PlantLightTest, KnowsDirectLightWellEvenWithFewRays) {
    // 16 scan lines left an error of .002.
    constexpr double kFewPartsInTenThousand = 5e-4;
    const std::string text = "leaf material (top): 0 0 0 0\nnumber of rays: 64\nreturn type: D\n";
    EXPECT_NEAR(first(text, flat(0, "P(1,2)", 1)), 1, kFewPartsInTenThousand);
}

TEST_F(PlantLightTest, GivesTheSameLightAgainAndOtherNoiseAtEachStep) {
    const std::string text = "number of rays: 256\nseed: 5\n";
    PlantLight once(specification(text, cached_), cached_.notices);
    PlantLight again(specification(text, cached_), cached_.notices);
    const auto first = answers_of(once, pile(5, 0));
    once.set_step(1);
    const auto second = answers_of(once, pile(5, 0));
    EXPECT_EQ(answers_of(again, pile(5, 0)), first);
    again.set_step(1);
    EXPECT_EQ(answers_of(again, pile(5, 0)), second);
    EXPECT_NE(first, second);
}

TEST_F(PlantLightTest, TracesNothingWhereNothingAsks) {
    PlantLight light(specification("method: from_organs\n", cached_), cached_.notices);
    EXPECT_TRUE(answers_of(light, pile(0, 3)).empty());
    EXPECT_TRUE(light.last().results.empty());
}

}  // namespace
}  // namespace quasimc::test
