#include <gtest/gtest.h>

#include "coupling_testing.h"

namespace quasimc::test {
namespace {

const std::string kOld =
    "domain size: 14 10 14\nposition: -7 0 -7\ngrid size: 7 5 7\nray density: 100\nseed: 3\n"
    "periodic canopy: yes\nreflectance model: blinn\nlight source: 0 1 0 1\nnumber of runs: 2\n";

TEST(MonteCarlo, IsRecognizedByItsDirectives) {
    KeptNotices kept;
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
    KeptNotices kept;
    EXPECT_EQ(specification(kOld, kept).lights.front().travel, (Vec3{0, -1, 0}));
    EXPECT_EQ(
        specification("light source: 0 1 0 1", kept, {}, SpecificationKind::montecarlo)
            .lights.front()
            .travel,
        (Vec3{0, -1, 0}));
    EXPECT_EQ(specification("light source: 0 1 0 1", kept).lights.front().travel, (Vec3{0, 1, 0}));
}

TEST(MonteCarlo, NeedsADomainForAPeriodicCanopy) {
    KeptNotices kept;
    EXPECT_THROW(
        static_cast<void>(
            specification("periodic canopy: yes", kept, {}, SpecificationKind::montecarlo)),
        InputError);
}

TEST(MonteCarlo, GivesTheFluxOfAPeriodicCanopy) {
    KeptNotices kept;
    PlantLight light(specification(kOld + "leaf material (top): 0 0 0 0\n", kept), kept.notices);
    // A leaf as large as a tenth of the domain takes a tenth of its light.
    const auto answers = answers_of(light, flat(0, "P(1.96,10)", 1));
    EXPECT_NEAR(answers.at(0).front(), 19.6, 0.4);
}

}  // namespace
}  // namespace quasimc::test
