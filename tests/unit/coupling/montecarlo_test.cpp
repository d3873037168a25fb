#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

const std::string kOld =
    "domain size: 14 10 14\nposition: -7 0 -7\ngrid size: 7 5 7\nray density: 100\nseed: 3\n"
    "periodic canopy: yes\nreflectance model: blinn\nlight source: 0 1 0 1\nnumber of runs: 2\n";

TEST(MonteCarlo, IsRecognizedByItsDirectives) {
    RecordedNotices kept;
    const Specification spec = specification(kOld, kept);
    EXPECT_EQ(spec.kind, SpecificationKind::montecarlo);
    EXPECT_EQ(spec.run.max_depth, 3U);
    EXPECT_EQ(spec.run.seed, 3U);
    EXPECT_EQ(spec.run.paths, 100U * 14 * 14);
    ASSERT_TRUE(spec.cell.has_value());
    EXPECT_EQ(spec.cell->size_x, 14);
    EXPECT_EQ(spec.cell->low_z, -7);
    EXPECT_EQ(spec.light_model, "blinn_phong");
    EXPECT_EQ(spec.returns, std::vector<ReturnType>{ReturnType::flux});
}

TEST(MonteCarlo, StatesTheDirectionTowardsTheLight) {
    RecordedNotices kept;
    EXPECT_EQ(specification(kOld, kept).lights.front().travel, (Vec3{0, -1, 0}));
    EXPECT_EQ(
        specification("light source: 0 1 0 1", kept, {}, SpecificationKind::montecarlo)
            .lights.front()
            .travel,
        (Vec3{0, -1, 0}));
    EXPECT_EQ(specification("light source: 0 1 0 1", kept).lights.front().travel, (Vec3{0, 1, 0}));
}

TEST(MonteCarlo, NeedsADomainForAPeriodicCanopy) {
    RecordedNotices kept;
    EXPECT_THROW(
        static_cast<void>(
            specification("periodic canopy: yes", kept, {}, SpecificationKind::montecarlo)),
        InputError);
}

TEST(MonteCarlo, GivesTheFluxOfAPeriodicCanopy) {
    RecordedNotices kept;
    PlantLight light(specification(kOld + "leaf material (top): 0 0 0 0\n", kept), kept.notices);
    // A leaf as large as a tenth of the domain takes a tenth of its light.
    const auto answers = answers_of(light, flat(0, "P(1.96,10)", 1));
    EXPECT_NEAR(answers.at(0).front(), 19.6, 0.4);
}

TEST(MonteCarlo, AnswersOrgansThatOnlyShade) {
    RecordedNotices kept;
    PlantLight light(specification(kOld + "leaf material (top): 0 0 0 0\n", kept), kept.notices);
    const auto answers =
        answers_of(light, flat(0, "P(1.96,10)", 1, "E(-1)") + flat(1, "P(1.96,10)", 0, "E(1)"));
    ASSERT_EQ(answers.size(), 2U);
    EXPECT_NEAR(answers.at(0).front(), 19.6, 0.4);
    EXPECT_NEAR(answers.at(1).front(), 0, 0.4);
}

TEST(MonteCarlo, CountsMaterialsFromOne) {
    RecordedNotices kept;
    const std::string black_above =
        "leaf material (top): 0 0 0 0\nleaf material (bottom): 1 0 0 0\nmaterial: 0.5 0 0 0\n";
    PlantLight light(specification(kOld + black_above, kept), kept.notices);
    const auto light_of = [&](const std::string& module) {
        return answers_of(light, flat(0, module, 1)).at(0).front();
    };
    EXPECT_NEAR(light_of("P(1.96,10,1)"), 19.6, 0.4);
    EXPECT_NEAR(light_of("P(1.96,10,2)"), 0, 1e-9);
    EXPECT_NEAR(light_of("P(1.96,10,3)"), 9.8, 0.2);
    EXPECT_FALSE(kept.has("material"));
    EXPECT_NEAR(light_of("P(1.96,10,0)"), 19.6, 0.4);
    EXPECT_TRUE(kept.has("there are 1 to 3"));
    // The first of QuasiMC has the number 0.
    const Specification quasimc = specification(black_above + "ground: 0 2\n", kept);
    EXPECT_EQ(quasimc.ground->material, 2U);
    const Specification montecarlo = specification(kOld + black_above + "ground: 0 2\n", kept);
    EXPECT_EQ(montecarlo.ground->material, 1U);
}

/// Organs that only shade are answered, but beside sensors nothing is known of their light.
TEST(MonteCarlo, AnswersSensorsAlone) {
    RecordedNotices kept;
    PlantLight light(specification(kOld + "rays from objects: yes 30\n", kept), kept.notices);
    const auto answers = answers_of(light, flat(10, "P(1,1)", 1, "E(-1)") + flat(20, "P(1,1)", 2));
    EXPECT_EQ(answers.count(10), 0U);
    ASSERT_EQ(answers.count(20), 1U);
    EXPECT_GT(answers.at(20).front(), 0);
}

TEST(MonteCarlo, KnowsDirectivesOfItsOwn) {
    RecordedNotices kept;
    const Specification spec = specification(
        "version: 2\nno direct light: yes\nrays from objects: yes 30\n"
        "reflectance model: parcinopy\n",
        kept);
    EXPECT_EQ(spec.kind, SpecificationKind::montecarlo);
    EXPECT_EQ(spec.run.direct_light, DirectLight::excluded);
    EXPECT_EQ(spec.sensor_half_angle_deg, 30);
    EXPECT_EQ(spec.light_model, "phong");
    EXPECT_TRUE(kept.has("PARCINOPY lobe is unknown"));
    EXPECT_EQ(
        specification("ray density: 1\nno direct light: no\n", kept).run.direct_light,
        DirectLight::included);
}

TEST(MonteCarlo, ReadsSkiesWithComments) {
    RecordedNotices kept;
    const Specification spec = specification(
        kOld + "sky file: sky\n", kept,
        {{"sky", "// of a day\n2 1\n# azimuth elevation value\n0 0 1\n0 0 3\n"}});
    ASSERT_TRUE(spec.sky_table.has_value());
    EXPECT_EQ(spec.sky_table->radiance, (std::vector<double>{1, 3}));
}

}  // namespace
}  // namespace quasimc::test
