#include "base/length_units.h"

#include <gtest/gtest.h>

namespace quasimc {
namespace {

TEST(LengthUnits, KnowTheirMetres) {
    EXPECT_EQ(metres_per("m"), 1);
    EXPECT_EQ(metres_per("metre"), 1);
    EXPECT_EQ(metres_per("cm"), 0.01);
    EXPECT_EQ(metres_per("µm"), metres_per("um"));
    EXPECT_DOUBLE_EQ(*metres_per("yd"), 3 * *metres_per("ft"));
    EXPECT_EQ(metres_per("in"), metres_per("inch"));
}

TEST(LengthUnits, AreUnknownByOtherNames) {
    EXPECT_FALSE(metres_per("parsec"));
    EXPECT_FALSE(metres_per("M"));
    EXPECT_FALSE(metres_per(""));
}

}  // namespace
}  // namespace quasimc
