// What is special to the coated cosine law; models_test.cpp tries it over a grid like every model.

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/catalogue.h"

namespace quasimc::test {
namespace {

TEST(CoatedLambertian, SpreadsLightByTheCosineLaw) {
    const BsdfEntry* model = find_bsdf("coated_lambertian");
    ASSERT_NE(model, nullptr);
    const auto bsdf = model->make(Hemisphere::reflected, std::array{.04});
    EXPECT_DOUBLE_EQ(bsdf->pdf({0, 0, 1}, {0, 0, -1}, {0.6, 0, 0.8}), .8 * std::numbers::inv_pi);
    EXPECT_EQ(bsdf->pdf({0, 0, 1}, {0, 0, -1}, {0.6, 0, -0.8}), 0);
}

TEST(CoatedLambertian, LosesWhatItsCoatReflects) {
    const BsdfEntry* model = find_bsdf("coated_lambertian");
    const auto bsdf = model->make(Hemisphere::reflected, std::array{.04});
    EXPECT_DOUBLE_EQ(bsdf->relative_albedo(1), .96);
    EXPECT_DOUBLE_EQ(bsdf->relative_albedo(.5), 1 - (.04 + .96 * std::pow(.5, 5)));
    EXPECT_EQ(bsdf->relative_albedo(0), 0) << "all light is reflected at grazing incidence";
    EXPECT_FALSE(bsdf->has_constant_albedo());
}

}  // namespace
}  // namespace quasimc::test
