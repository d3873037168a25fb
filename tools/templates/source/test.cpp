// What is special to @words@.

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sources/catalogue.h"

namespace quasimc::test {
namespace {

TEST(@Name@, HasTheRadianceOfItsEquation) {
    const SourceEntry* kind = find_source("@name@");
    ASSERT_NE(kind, nullptr);
    const auto source = kind->make({"@name@", {1}, {{"power_of_sine", 3}}});
    // Irradiance 1 on the horizontal: the integral of z^3 z over the hemisphere is 2 pi / 5.
    const double zenith = 5 / (2 * std::numbers::pi);
    EXPECT_NEAR(source->radiance({0, 0, 1}), zenith, 1e-6);
    EXPECT_NEAR(source->radiance({.6, 0, .8}), zenith * std::pow(.8, 3), 1e-6);
    EXPECT_EQ(source->traits(), kSkyTraits);
}

}  // namespace
}  // namespace quasimc::test
