// What is special to @words@; models_test.cpp tries it over a grid like every model.

#include <array>
#include <numbers>

#include <gtest/gtest.h>

#include "optics/catalogue.h"

namespace quasimc::test {
namespace {

TEST(@Name@, HasTheDensityOfItsEquation) {
    const BsdfEntry* model = find_bsdf("@name@");
    ASSERT_NE(model, nullptr);
    const auto bsdf = model->make(Hemisphere::reflected, std::array{2.0});
    const double expected = 3 / (2 * std::numbers::pi) * 0.64;
    EXPECT_DOUBLE_EQ(bsdf->pdf({0, 0, 1}, {0, 0, -1}, {0.6, 0, 0.8}), expected);
}

}  // namespace
}  // namespace quasimc::test
