#include "text/numbers.h"

#include <cmath>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/text.h"

namespace quasimc::test {
namespace {

TEST(ParseReal, TakesTheUsualForms) {
    EXPECT_EQ(parse_real("1"), 1.0);
    EXPECT_EQ(parse_real("+2.5"), 2.5);
    EXPECT_EQ(parse_real("-1e-3"), -0.001);
    EXPECT_EQ(parse_real(".5"), 0.5);
}

TEST(ParseReal, TakesTheWholeTextOrNothing) {
    for (const char* text : {"", " 1", "1 ", "1,5", "1.5x", "--1", "+-1", "e5", "0x10", "1e999"}) {
        EXPECT_FALSE(parse_real(text)) << text;
    }
}

TEST(ParseReal, LeavesItToOthersToRefuseWhatIsNotFinite) {
    EXPECT_TRUE(std::isnan(*parse_real("nan")));
    EXPECT_TRUE(std::isinf(*parse_real("-inf")));
}

TEST(ParseInteger, TakesTheWholeTextOrNothing) {
    EXPECT_EQ(parse_integer("-9223372036854775808"), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(parse_integer("+7"), 7);
    for (const char* text : {"", "9223372036854775808", "1.0", "1e3", "seven", "7 "}) {
        EXPECT_FALSE(parse_integer(text)) << text;
    }
}

RC_GTEST_PROP(ParseReal, ReadsBackWhatShortestWrites, (double value)) {
    RC_ASSERT(parse_real(shortest(value)) == value);
}

}  // namespace
}  // namespace quasimc::test
