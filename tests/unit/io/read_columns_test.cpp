#include "io/results/read_columns.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

std::string mean_of(int mean) {
    return R"({"mean":)" + std::to_string(mean) + R"(,"standard_error":0.5,"low":null,"high":9})";
}

/// Two organs of three, the second without NIR.
std::string organ_lines(int first) {
    return R"([{"id":7,"labels":{"flux":"x"},"flux":{"PAR":)" + mean_of(first) + R"(,"NIR":)" +
           mean_of(-first) + R"(},"ratios":{"R/FR":)" + mean_of(10 * first) +
           R"(}},{"id":8,"flux":{"PAR":)" + mean_of(first + 1) + R"(,"NIR":null}}])";
}

const std::vector<std::vector<std::string>> kColumns{
    {"flux", "PAR"}, {"flux", "NIR"}, {"ratios", "R/FR"}, {"sunlit_fraction"}};

ResultColumns columns_of(const std::string& text, std::optional<std::size_t> point = {}) {
    return read_columns(text, "result.json", kColumns, 3, point);
}

TEST(ReadColumns, TakesOrgansAndLeavesTheRest) {
    const ResultColumns result = columns_of(
        R"({"run":{"organs":[1,{"id":2}]},"organs":)" + organ_lines(1) +
        R"(,"groups":[{"by":"all"}],"organs_sha256":"0"})");
    ASSERT_EQ(result.times.size(), 1U);
    const ResultTime& time = result.times[0];
    EXPECT_EQ(time.part, "");
    ASSERT_EQ(time.columns.size(), 4U);
    ASSERT_EQ(time.columns[0].mean.size(), 3U);
    EXPECT_EQ(time.columns[0].mean[0], 1);
    EXPECT_EQ(time.columns[0].mean[1], 2);
    EXPECT_TRUE(std::isnan(time.columns[0].mean[2]));
    EXPECT_EQ(time.columns[0].standard_error[1], 0.5);
    EXPECT_TRUE(std::isnan(time.columns[0].low[0]));
    EXPECT_EQ(time.columns[0].high[0], 9);
    EXPECT_EQ(time.columns[1].mean[0], -1);
    EXPECT_TRUE(std::isnan(time.columns[1].mean[1]));
    EXPECT_EQ(time.columns[2].mean[0], 10);
    EXPECT_TRUE(time.columns[3].mean.empty());
    EXPECT_EQ(result.head.find(R"("id":7)"), std::string::npos) << result.head;
    EXPECT_NE(result.head.find(R"("groups":[{"by":"all"}])"), std::string::npos) << result.head;
}

TEST(ReadColumns, TakesTimesAndTheirNames) {
    const ResultColumns result = columns_of(
        R"({"moments":[{"time":"12:00","energy":1,"organs":)" + organ_lines(1) + R"(},{"organs":)" +
        organ_lines(3) + R"(,"time":"13:00"}],"days":[{"date":"a day","organs":)" + organ_lines(5) +
        R"(}],"total":{"seconds":1,"organs":)" + organ_lines(7) + "}}");
    ASSERT_EQ(result.times.size(), 4U);
    const char* parts[] = {"moments", "moments", "days", "total"};
    const char* labels[] = {"12:00", "13:00", "a day", ""};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(result.times[i].part, parts[i]);
        EXPECT_EQ(result.times[i].label, labels[i]);
        EXPECT_EQ(result.times[i].index, i == 1 ? 1U : 0U);
        EXPECT_EQ(result.times[i].columns[0].mean[0], 2 * static_cast<float>(i) + 1);
    }
    EXPECT_EQ(result.head.find("organs"), std::string::npos) << result.head;
    EXPECT_NE(result.head.find(R"({"time":"12:00","energy":1})"), std::string::npos) << result.head;
}

TEST(ReadColumns, TakesOnePointOfASweep) {
    const std::string text = R"({"title":"t","points":[{"point":1,"organs":)" + organ_lines(1) +
                             R"(},{"point":2,"moments":[{"time":"a","organs":)" + organ_lines(9) +
                             R"(}]}],"done":3})";
    const ResultColumns first = columns_of(text, 0);
    ASSERT_EQ(first.times.size(), 1U);
    EXPECT_EQ(first.times[0].columns[0].mean[0], 1);
    EXPECT_EQ(first.head, R"({"title":"t","done":3,"point":1})");
    const ResultColumns second = columns_of(text, 1);
    ASSERT_EQ(second.times.size(), 1U);
    EXPECT_EQ(second.times[0].label, "a");
    EXPECT_EQ(second.times[0].columns[0].mean[0], 9);
    EXPECT_THROW((void)columns_of(text, 2), InputError);
    EXPECT_THROW((void)columns_of(R"({"points":4})", 0), InputError);
}

TEST(ReadColumns, RefusesWhatIsNoResult) {
    for (const char* text :
         {"", "{", "[1,2", R"({"organs":[{]})", "nul", R"({"organs":[{}],"x":1)"}) {
        EXPECT_THROW((void)columns_of(text), InputError) << text;
    }
    for (const char* text : {"[]", "4", R"([[{"organs":[{"flux":{"PAR":{"mean":1}}}]}]])"}) {
        EXPECT_THROW((void)columns_of(text), InputError) << text;
    }
    // Strange, but nothing is found in them.
    for (const char* text :
         {R"({"organs":[1,[{}],{"flux":3},null]})", R"({"moments":3,"days":[4],"total":[]})",
          R"({"moments":{"a":{"organs":[{"flux":{"PAR":{"mean":1}}}]}}})",
          R"({"points":[[{"organs":[{"flux":{"PAR":{"mean":1}}}]}]]})"}) {
        for (const ResultTime& time : columns_of(text).times) {
            EXPECT_TRUE(time.columns[0].mean.empty()) << text;
        }
    }
}

}  // namespace
}  // namespace quasimc::test
