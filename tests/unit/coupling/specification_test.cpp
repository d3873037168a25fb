#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

TEST(Specification, HasDefaultsForAllThatIsNotStated) {
    RecordedNotices kept;
    const Specification spec = specification("", kept);
    EXPECT_EQ(spec.kind, SpecificationKind::quasimc);
    EXPECT_EQ(spec.irradiance, std::vector<double>{1});
    ASSERT_EQ(spec.lights.size(), 1U);
    EXPECT_EQ(spec.lights[0].travel, (Vec3{0, -1, 0}));
    EXPECT_EQ(spec.materials[0][0].reflectance, 0.25);
    EXPECT_EQ(spec.returns, std::vector<ReturnType>{ReturnType::flux});
    EXPECT_EQ(spec.run.max_depth, 5U);
    EXPECT_TRUE(kept.texts.empty());
}

TEST(Specification, ReadsEveryDirectiveOfTheOriginal) {
    RecordedNotices kept;
    const Specification spec = specification(
        R"(// a model of two bands
Verbose: 1
REMOVE OBJECTS: yes
rays from objects: yes 30
spectrum samples: 2
source spectrum: 660 2.5, 730; 1.5
local light model: Phong
maximum depth: -1
number of runs: 4
one ray per spectrum: no
ignore direct light: yes
return variance: yes out.dat
material parameter: 5
leaf material (top): 0.1 10 0.2 20 1
: 0.3 -1 0.4 100 1
leaf material (bottom): 0.1 10 0.1 10 1
: 0.1 10 0.1 10 1
material: 0 0 0 0 1
: 0 0 0 0 1
light source: 1 -1 0 2
light source file: lights.dat
Russian roulette: 0.1 0.7
grid size: 10x10x10
sampling method: sobol
number of rays: 5000
surface: leaf.s 1
cylinder sides: 8
location: 51 -114
weather: 1 2.45
growth period: 6 18
julian day: 172
sky file: sky.dat
return type: D U
visualization: light box wire 1 0 0
)",
        kept,
        {{"lights.dat", "0.5 0 3 \n0 -1 0 2\n"},
         {"leaf.s", square_surface()},
         {"sky.dat", "2 1\n0 0 1\n0 0 3\n"}});
    EXPECT_EQ(spec.sensor_half_angle_deg, 30);
    EXPECT_EQ(spec.irradiance, (std::vector<double>{2.5, 1.5}));
    EXPECT_EQ(spec.run.max_depth, 0U);
    EXPECT_EQ(spec.run.replicates, 4U);
    EXPECT_EQ(spec.run.paths, 5000U);
    EXPECT_EQ(spec.run.roulette_threshold, 0.1);
    EXPECT_EQ(spec.run.direct_light, DirectLight::excluded);
    EXPECT_FALSE(spec.one_ray_per_spectrum);
    EXPECT_EQ(spec.material_parameter, 5U);
    ASSERT_EQ(spec.materials.size(), 3U);
    EXPECT_EQ(spec.leaf_lower, 1U);
    EXPECT_EQ(spec.materials[0][0].reflection_model, "phong");
    EXPECT_EQ(spec.materials[0][0].transmission_parameters.at("exponent"), 20);
    EXPECT_EQ(spec.materials[0][1].reflection_model, "mirror");
    EXPECT_EQ(spec.materials[0][1].transmission_model, "mirror");
    ASSERT_EQ(spec.lights.size(), 3U);
    EXPECT_EQ(spec.lights[1].weight, 3);  // a blank behind three numbers changes nothing
    EXPECT_EQ(spec.lights[2].travel, (Vec3{0, -1, 0}));
    EXPECT_EQ(spec.surfaces.size(), 1U);
    EXPECT_EQ(spec.cylinder_sides, 8);
    EXPECT_EQ(spec.sky->from_hour, 6);
    EXPECT_EQ(spec.sky_table->radiance, (std::vector<double>{1, 3}));
    EXPECT_EQ(spec.returns, (std::vector<ReturnType>{ReturnType::density, ReturnType::upper}));
    EXPECT_EQ(spec.variance_file->name, "out.dat");
    EXPECT_TRUE(kept.texts.empty()) << kept.texts.front();
}

TEST(Specification, ReadsWhatIsNew) {
    RecordedNotices kept;
    const Specification spec = specification(
        "seed: 7\nnumber of threads: 2\ntarget error: 0.05 0.9\nmaximum seconds: 3\n"
        "canopy period: 2 3 -1 -1.5\nground: 0.5 0\nsky: uniform\ndirect sun: no\n"
        "quantities: incident_upper absorbed_flux_error sunlit_fraction\ncylinder width: diameter\n"
        "picture file: step.ply\n",
        kept);
    EXPECT_EQ(spec.run.seed, 7U);
    EXPECT_EQ(spec.run.threads, 2U);
    EXPECT_EQ(spec.run.target_error, 0.05);
    EXPECT_GT(spec.run.replicates, 1U);  // one run has no error
    EXPECT_EQ(spec.run.max_seconds, 3);
    EXPECT_EQ(spec.cell->size_z, 3);
    EXPECT_EQ(spec.cell->low_x, -1);
    EXPECT_EQ(spec.ground->height, 0.5);
    EXPECT_TRUE(spec.has_uniform_sky);
    ASSERT_EQ(spec.quantities.size(), 3U);
    EXPECT_EQ(spec.quantities[0].quantity, Quantity::incident_upper);
    EXPECT_TRUE(spec.quantities[1].is_error);
    EXPECT_FALSE(spec.quantities[2].quantity.has_value());
    EXPECT_TRUE(spec.cylinder_takes_diameter);
}

TEST(Specification, SaysWhetherStepsAreShown) {
    RecordedNotices kept;
    EXPECT_FALSE(specification("", kept).view_port);
    EXPECT_EQ(specification("view: yes\n", kept).view_port, 0);
    EXPECT_EQ(specification("View: yes 8080\n", kept).view_port, 8080);
    EXPECT_FALSE(specification("view: yes\nview: no\n", kept).view_port);
    for (const char* bad : {"view: maybe\n", "view: yes 65536\n", "view: yes 80.5\n", "view:\n"}) {
        EXPECT_NE(faults_of(bad).find("light.qmc:1"), std::string::npos) << bad;
    }
}

TEST(Specification, MayStateTheBandsAfterWhatNeedsThem) {
    RecordedNotices kept;
    const Specification spec = specification(
        "source spectrum: 1 2 3 4\nleaf material (top): 0 0 0 0\n: 0 0 0 0\nspectrum samples: 2\n",
        kept);
    EXPECT_EQ(spec.irradiance, (std::vector<double>{2, 4}));
}

TEST(Specification, NamesAllFaultsAtOnceWithTheirLines) {
    const std::string faults = faults_of(
        "number of rays: 0\nmaximum depth: 0\nreturn type: X\nleaf material (top): 0.6 10 0.6 10\n"
        "weather: 1 0.5\nlight source: 0 0 0 1\nsky file: none.dat\n");
    for (const char* expected :
         {"light.qmc:1", "light.qmc:2", "light.qmc:3", "light.qmc:4", "their sum exceeds 1",
          "light.qmc:5", "1 to 64", "light.qmc:6", "it has no direction", "light.qmc:7",
          "can't be read"}) {
        EXPECT_NE(faults.find(expected), std::string::npos) << expected << "\n" << faults;
    }
}

TEST(Specification, RefusesBrokenBlocksOfMaterials) {
    EXPECT_NE(
        faults_of("spectrum samples: 3\nmaterial: 0 0 0 0\n: 0 0 0 0\n").find("2 lines"),
        std::string::npos);
    EXPECT_NE(
        faults_of("material: 0 0 0\n").find("exponent of transmission is missing"),
        std::string::npos);
    EXPECT_NE(
        faults_of("spectrum samples: 2\nmaterial: 0 0 0 0\n: 0 x 0 0\n").find("light.qmc:3"),
        std::string::npos);
    EXPECT_NE(faults_of("seed: 3\n: 0 0 0 0\n").find("light.qmc:2"), std::string::npos);
}

/// One row: a bad line.
class BadLines : public ::testing::TestWithParam<const char*> {};

TEST_P(BadLines, AreRefused) {
    EXPECT_NE(faults_of(std::string(GetParam()) + "\n").find("light.qmc:1"), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Specification,
    BadLines,
    ::testing::Values(
        "verbose: 4",
        "rays from objects: yes 91",
        "rays from objects: maybe",
        "spectrum samples: 21",
        "source spectrum: 660",
        "source spectrum: 660 -1",
        "local light model: fong",
        "number of runs: 0",
        "number of rays: 0",
        "number of rays: 1.5",
        "surface: leaf.s 9",
        "surface:",
        "cylinder sides: 2",
        "location: 91 0",
        "growth period: 10 5",
        "julian day: 0",
        "return type:",
        "Russian roulette: -1",
        "target error: 1",
        "ground:",
        "ground: 0 3",
        "canopy period: 0 1",
        "quantities:",
        "quantities: light",
        "material parameter: 0",
        "light source: 1 2",
        "light source: 0 -1 0 -1",
        "weather: 1 65",
        "sky: blue"));

/// One row: a line that says more than is known, and what the notice of it holds.
struct Surplus {
    const char* line;
    const char* reported;
};

class SurplusLines : public ::testing::TestWithParam<Surplus> {};

TEST_P(SurplusLines, AreSkippedWithANotice) {
    RecordedNotices kept;
    const Specification spec =
        specification(std::string(GetParam().line) + "\nmaximum depth: 7\n", kept);
    EXPECT_EQ(spec.run.max_depth, 7U);
    ASSERT_EQ(kept.texts.size(), 1U);
    EXPECT_TRUE(kept.has("light.qmc:1")) << kept.texts.front();
    EXPECT_TRUE(kept.has(GetParam().reported)) << kept.texts.front();
}

INSTANTIATE_TEST_SUITE_P(
    Specification,
    SurplusLines,
    ::testing::Values(
        Surplus{"number of ray: 5", "did you mean 'number of rays'?"},
        Surplus{"something else: 5\n: 6", "docs/reference/specification.md"},
        Surplus{"not a directive", "is not a directive"},
        Surplus{": 1 2", "is not a directive"},
        Surplus{"domain size: 1 1 1\nnumber of rays: 4", "'domain size' is not a directive"},
        Surplus{"source spectrum: 660 1.0 730 0.5", "'730 0.5' is not read"},
        Surplus{"return type: D F", "2 letters for the 1 band"},
        Surplus{"sampling method: latin", "Monte Carlo is used"},
        Surplus{"light source: 0 -1 0", "no weight: 1 is used"},
        Surplus{"weather: 1 1", "the clear sky for 1.4 is used"}));

TEST(Specification, TakesWhatTheOriginalTakesForMonteCarlo) {
    RecordedNotices kept;
    for (const char* said : {"MonteCarlo", "monte carlo", "Monte-Carlo", "monte_carlo", "monte"}) {
        const std::string text = std::string("sampling method: ") + said + "\n";
        EXPECT_EQ(specification(text, kept).run.sampler, "monte_carlo") << said;
    }
    EXPECT_TRUE(kept.texts.empty()) << kept.texts.front();
    EXPECT_EQ(specification("sampling method: korobow\n", kept).run.sampler, "monte_carlo");
    EXPECT_TRUE(kept.has("did you mean 'korobov'?"));
    EXPECT_EQ(specification("sampling method: Sobol\n", kept).run.sampler, "sobol");
    EXPECT_NE(faults_of("sampling method:\n").find("light.qmc:1"), std::string::npos);
}

TEST(Specification, TakesOnAndOffForTheLevelOfMessages) {
    RecordedNotices kept;
    EXPECT_EQ(specification("verbose: on\n", kept).verbose, 1);
    EXPECT_EQ(specification("verbose: off\n", kept).verbose, 0);
    EXPECT_EQ(specification("verbose: 2\n", kept).verbose, 2);
    EXPECT_TRUE(kept.texts.empty());
}

TEST(Specification, TakesALightWithoutAWeight) {
    RecordedNotices kept;
    const auto lights = specification("light source: 1 -1 0\n", kept).lights;
    ASSERT_EQ(lights.size(), 1U);
    EXPECT_EQ(lights.front().travel, (Vec3{1, -1, 0}));
    EXPECT_EQ(lights.front().weight, 1);
}

TEST(Specification, TakesTheFirstBandsWhereThereAreMore) {
    RecordedNotices kept;
    const Specification spec = specification(
        "spectrum samples: 2\nsource spectrum: 660 1 730 2 800 3\nreturn type: D U L\n", kept);
    EXPECT_EQ(spec.irradiance, (std::vector<double>{1, 2}));
    EXPECT_EQ(spec.returns, (std::vector<ReturnType>{ReturnType::density, ReturnType::upper}));
}

TEST(Specification, TakesTheTurbiditiesOfTheManual) {
    RecordedNotices kept;
    EXPECT_EQ(specification("weather: 0 1\n", kept).sky->weather, Weather::overcast);
    EXPECT_EQ(specification("weather: 1 64\n", kept).sky->turbidity, 64);
    EXPECT_TRUE(kept.texts.empty());
    EXPECT_EQ(specification("weather: 1 1\n", kept).sky->turbidity, kClearestSky);
}

TEST(Specification, HasSeveralRunsForATargetWhereverItStands) {
    RecordedNotices kept;
    EXPECT_GT(specification("target error: 0.1\nnumber of runs: 1\n", kept).run.replicates, 1U);
}

TEST(Specification, KeepsTheNameOfTheTableWhicheverDirectiveHasIt) {
    RecordedNotices kept;
    for (const char* text :
         {"return variance: yes\noutput file: yes a.dat\n",
          "output file: yes a.dat\nreturn variance: yes\n"}) {
        EXPECT_EQ(specification(text, kept).variance_file->name, "a.dat") << text;
    }
    EXPECT_FALSE(
        specification("return variance: yes\noutput file: no\n", kept).variance_file.has_value());
}

TEST(Specification, TakesTheNearestPowerOfTwoForLattices) {
    RecordedNotices kept;
    EXPECT_EQ(specification("sampling method: korobov\nnumber of rays: 512", kept).run.paths, 512U);
    EXPECT_TRUE(kept.texts.empty());
    EXPECT_EQ(
        specification("sampling method: korobov\nnumber of rays: 1000", kept).run.paths, 1024U);
    EXPECT_TRUE(kept.has("1024 rays are used instead of 1000"));
}

}  // namespace
}  // namespace quasimc::test
