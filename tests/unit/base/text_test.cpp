#include "base/text.h"

#include <array>
#include <cstdlib>
#include <limits>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/number_text.h"

namespace quasimc {
namespace {

using Texts = std::vector<std::string_view>;

constexpr std::array<std::string_view, 4> kModels{"lambertian", "phong", "blinn_phong", "mirror"};

TEST(NearestWord, FindsAWordWithOneSlip) {
    EXPECT_EQ(nearest_word("lambertan", kModels), "lambertian");    // a letter left out
    EXPECT_EQ(nearest_word("lambertiann", kModels), "lambertian");  // one too many
    EXPECT_EQ(nearest_word("lambartian", kModels), "lambertian");   // a wrong one
    EXPECT_EQ(nearest_word("lamberitan", kModels), "lambertian");   // two exchanged
    EXPECT_EQ(nearest_word("mirorr", kModels), "mirror");
}

TEST(NearestWord, LooksPastCase) {
    EXPECT_EQ(nearest_word("MIRROR", kModels), "mirror");
    EXPECT_EQ(nearest_word("par", Texts{"PAR", "NIR"}), "PAR");
}

TEST(NearestWord, FindsTheNearestOfSeveral) {
    EXPECT_EQ(nearest_word("leaf_c", Texts{"leaf_ab", "leaf_b", "stem"}), "leaf_b");
    EXPECT_EQ(nearest_word("leafs", Texts{"leaves", "leaf"}), "leaf");
}

TEST(NearestWord, IsEmptyWhenNoneIsNear) {
    EXPECT_EQ(nearest_word("chlorophyll", kModels), "");
    EXPECT_EQ(nearest_word("", kModels), "");
    EXPECT_EQ(nearest_word("mirror", Texts{}), "");
}

TEST(NearestWord, DoesNotChangeEveryLetterOfAShortWord) {
    EXPECT_EQ(nearest_word("xy", Texts{"ab"}), "");
    EXPECT_EQ(nearest_word("x", Texts{"b"}), "");
}

TEST(NearestWord, GivesUpOnTextThatIsNoWord) {
    EXPECT_EQ(nearest_word(std::string(100000, 'a'), Texts{"aaa"}), "");
}

TEST(DidYouMean, NamesTheNearestWord) {
    EXPECT_EQ(did_you_mean("miror", kModels), "did you mean 'mirror'?");
}

TEST(DidYouMean, ListsAllWordsWhenNoneIsNear) {
    EXPECT_EQ(did_you_mean("glossy", kModels), "use one of lambertian, phong, blinn_phong, mirror");
}

TEST(DidYouMean, IsSilentWithoutCandidates) {
    EXPECT_EQ(did_you_mean("glossy", Texts{}), "");
}

TEST(Shortest, IsAsPeopleWriteNumbers) {
    EXPECT_EQ(shortest(0.1), "0.1");
    EXPECT_EQ(shortest(1e-5), "1e-05");
    EXPECT_EQ(shortest(-3), "-3");
    EXPECT_EQ(shortest(0.1 + 0.2), "0.30000000000000004");
    EXPECT_EQ(shortest(std::numeric_limits<double>::quiet_NaN()), "nan");
    EXPECT_EQ(shortest(-std::numeric_limits<double>::infinity()), "-inf");
}

RC_GTEST_PROP(Shortest, ReadsBackAsTheSameNumber, (double value)) {
    RC_ASSERT(std::strtod(shortest(value).c_str(), nullptr) == value);
}

TEST(WithDecimals, GivesAZeroNoSign) {
    EXPECT_EQ(with_decimals(-1e-17, 4), "0.0000");
    EXPECT_EQ(with_decimals(-0.0, 0), "0");
    EXPECT_EQ(with_decimals(-0.00006, 4), "-0.0001");
    EXPECT_EQ(with_decimals(-10, 1), "-10.0");
    EXPECT_EQ(with_decimals(0.25, 3), "0.250");
    EXPECT_EQ(with_decimals(-std::numeric_limits<double>::infinity(), 3), "-inf");
}

TEST(Counted, IsSingularOfOneAlone) {
    EXPECT_EQ(counted(1, "organ"), "1 organ");
    EXPECT_EQ(counted(0, "organ"), "0 organs");
    EXPECT_EQ(counted(2, "organ"), "2 organs");
}

TEST(ErrorText, HasTwoDigitsOnlyIfItBeginsWithOneOrTwo) {
    EXPECT_EQ(error_text(0.0224), "0.022");
    EXPECT_EQ(error_text(0.0294), "0.029");
    EXPECT_EQ(error_text(0.0296), "0.03");
    EXPECT_EQ(error_text(8.6), "9");
    EXPECT_EQ(error_text(0), "0");
}

TEST(ErrorText, HasNoExponentWhereTheNumberIsShort) {
    EXPECT_EQ(error_text(12.3), "12");
    EXPECT_EQ(error_text(43.2), "40");
    EXPECT_EQ(error_text(99.9), "100");
    EXPECT_EQ(error_text(432), "400");
    EXPECT_EQ(error_text(23765), "24000");
    EXPECT_EQ(error_text(1.23e7), "1.2e+07");
}

TEST(Trimmed, TakesBlanksFromBothEndsOnly) {
    EXPECT_EQ(trimmed(" \t a b\r\n"), "a b");
    EXPECT_EQ(trimmed("ab"), "ab");
    EXPECT_EQ(trimmed(" \n "), "");
    EXPECT_EQ(trimmed(""), "");
}

TEST(Trimmed, LeavesBytesBeyondAsciiAlone) {
    EXPECT_EQ(trimmed(" \xC3\xA9 "), "\xC3\xA9");
}

TEST(Joined, PutsTheSeparatorBetweenItems) {
    EXPECT_EQ(joined(Texts{"a", "b", "c"}, ", "), "a, b, c");
    EXPECT_EQ(joined(Texts{"a"}, ", "), "a");
    EXPECT_EQ(joined(Texts{}, ", "), "");
}

TEST(IsUtf8, TakesWhatTheTableOfUnicodeHas) {
    for (const char* good : {"", "leaf", "bl\xC3\xA4tt", "\xE8\x91\x89", "\xF0\x9F\x8C\xBF"}) {
        EXPECT_TRUE(is_utf8(good)) << good;
    }
    for (const char* bad :
         {"bl\xE4tt", "\xFF", "\xC3", "\xC0\x80", "\xE0\x80\x80", "\xED\xA0\x80",
          "\xF0\x80\x80\x80", "\xF4\x90\x80\x80", "\x80"}) {
        EXPECT_FALSE(is_utf8(bad)) << ::testing::PrintToString(std::string(bad));
    }
}

TEST(Printable, LeavesNothingThatATerminalRuns) {
    EXPECT_EQ(printable("o\x1B[2J\nbl\xC3\xA4tt"), "o [2J\nbl\xC3\xA4tt");
    EXPECT_EQ(printable(std::string_view("o\0x", 3)), "o x");
    EXPECT_EQ(printable("\x7F|\xC2\x9B|\xE4"), " | |?");
    EXPECT_EQ(one_line("a\nb\x1B\xC2\x9B"), "a b  ");
    EXPECT_EQ(one_line("bl\xE4tt"), "bl\xE4tt") << "a reader must still see what is wrong";
}

}  // namespace
}  // namespace quasimc
