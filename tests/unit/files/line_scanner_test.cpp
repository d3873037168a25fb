#include "text/line_scanner.h"

#include <string_view>

#include <gtest/gtest.h>

namespace quasimc {
namespace {

TEST(TakeWord, TakesWordsBetweenBlanks) {
    std::string_view line = "  one\ttwo,three  ";
    EXPECT_EQ(take_word(line), "one");
    EXPECT_EQ(take_word(line), "two,three");
    EXPECT_EQ(take_word(line), "");
    EXPECT_EQ(line, "");
    EXPECT_EQ(take_word(line), "");
}

TEST(TakeWord, TakesWordsBetweenOtherSeparators) {
    std::string_view line = ",; one two:three";
    EXPECT_EQ(take_word(line, ",;: "), "one");
    EXPECT_EQ(take_word(line, ",;:"), " two");
    EXPECT_EQ(take_word(line, ",;:"), "three");
    EXPECT_EQ(take_word(line, ",;:"), "");
}

}  // namespace
}  // namespace quasimc
