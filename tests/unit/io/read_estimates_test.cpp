#include "io/results/read_estimates.h"

#include <cmath>

#include <gtest/gtest.h>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

std::string estimate(double mean) {
    const std::string m = std::to_string(mean);
    return R"({"mean":)" + m + R"(,"standard_error":0.5,"low":)" + m + R"(,"high":9})";
}

/// Two organs, whose light is `first` and one more.
std::string organs(double first) {
    std::string text = "[";
    for (const double mean : {first, first + 1}) {
        text += std::string(text.size() > 1 ? "," : "") +
                R"({"id":7,"name":"mean","labels":{"mean":"x"},"area":3,"flux":{"PAR":)" +
                estimate(mean) + R"(,"NIR":)" + estimate(-mean) + R"(},"sunlit_fraction":)" +
                estimate(100 + mean) + R"(,"ratios":{"R/FR":)" + estimate(200 + mean) + "}}";
    }
    return text + "]";
}

const std::string kOne = R"({"run":{"organs":[1,2],"mean":4},"organs":)" + organs(1) +
                         R"(,"groups":[{"by":"all","flux":{"PAR":)" + estimate(5) +
                         R"(}}],"organs_sha256":"0"})";
const std::string kTimes =
    R"({"run":{"time":"2024-06-21T12:00"},"moments":[{"time":"2024-06-21T12:00","organs":)" +
    organs(1) + R"(},{"time":"2024-06-21T13:00","sun":{"towards":[0,0,1]},"organs":)" + organs(3) +
    R"(}],"days":[{"date":"2024-06-21","groups":[],"organs":)" + organs(5) +
    R"(}],"total":{"organs":)" + organs(7) + "}}";
const std::string kPoints = R"({"points":[{"point":{"seed":1},"organs":)" + organs(1) +
                            R"(},{"point":{"seed":2},"moments":[{"time":"a","organs":)" +
                            organs(9) + "}]}]}";

double first_of(const std::string& text, const EstimateQuery& query) {
    const auto times = read_estimates(text, "result.json", query);
    EXPECT_EQ(times.size(), 1U);
    return times.empty() || times[0].values.empty() ? std::nan("") : times[0].values[0].mean;
}

TEST(ReadEstimates, TakesWhatIsAskedFor) {
    EXPECT_EQ(first_of(kOne, {.names = {"flux", "PAR"}}), 1);
    EXPECT_EQ(first_of(kOne, {.names = {"flux", "NIR"}}), -1);
    EXPECT_EQ(first_of(kOne, {.names = {"sunlit_fraction"}}), 101);
    EXPECT_EQ(first_of(kOne, {.names = {"ratios", "R/FR"}}), 201);
    EXPECT_EQ(first_of(kOne, {.list = "groups", .names = {"flux", "PAR"}}), 5);
    const auto all = read_estimates(kOne, "result.json", {.names = {"flux", "PAR"}});
    ASSERT_EQ(all[0].values.size(), 2U);
    EXPECT_EQ(all[0].values[1].mean, 2);
    EXPECT_EQ(all[0].values[1].standard_error, 0.5);
    EXPECT_EQ(all[0].values[1].low, 2);
    EXPECT_EQ(all[0].values[1].high, 9);
}

TEST(ReadEstimates, FindsTimesDaysAndTheirSum) {
    const std::vector<std::string> names{"flux", "PAR"};
    const auto both = read_estimates(kTimes, "", {.names = names, .part = "moments"});
    ASSERT_EQ(both.size(), 2U);
    EXPECT_EQ(both[1].label, "2024-06-21T13:00");
    EXPECT_EQ(both[1].values[0].mean, 3);
    EXPECT_EQ(first_of(kTimes, {.names = names, .part = "moments", .label = "2024-06-21T13"}), 3);
    EXPECT_EQ(first_of(kTimes, {.names = names, .part = "days"}), 5);
    EXPECT_EQ(first_of(kTimes, {.names = names, .part = "total"}), 7);
}

TEST(ReadEstimates, FindsThePointOfASweep) {
    const std::vector<std::string> names{"flux", "PAR"};
    EXPECT_EQ(first_of(kPoints, {.names = names, .point = 0}), 1);
    EXPECT_EQ(first_of(kPoints, {.names = names, .part = "moments", .point = 1}), 9);
    EXPECT_TRUE(read_estimates(kPoints, "", {.names = names, .point = 2}).empty());
}

/// Several kinds in one pass are what each is by itself.
TEST(ReadEstimates, TakesSeveralKindsAtOnce) {
    const std::vector<EstimateNames> columns{
        {"flux", "PAR"}, {"ratios", "R/FR"}, {"flux", "UV"}, {"sunlit_fraction"}};
    for (const EstimateQuery& query :
         {EstimateQuery{.part = "moments"}, EstimateQuery{.part = "total"}}) {
        const auto together = read_estimate_columns(kTimes, "", query, columns);
        ASSERT_EQ(together.size(), columns.size());
        for (std::size_t i = 0; i < columns.size(); ++i) {
            EstimateQuery one = query;
            one.names = columns[i];
            const auto alone = read_estimates(kTimes, "", one);
            ASSERT_EQ(together[i].size(), alone.size()) << i;
            for (std::size_t time = 0; time < alone.size(); ++time) {
                EXPECT_EQ(together[i][time].label, alone[time].label);
                ASSERT_EQ(together[i][time].values.size(), alone[time].values.size());
                EXPECT_EQ(together[i][time].values[0].mean, alone[time].values[0].mean);
            }
        }
        EXPECT_TRUE(together[2].empty());
        EXPECT_FALSE(together[0].empty());
    }
}

TEST(ReadEstimates, HasNothingForWhatIsNotThere) {
    EXPECT_TRUE(read_estimates(kOne, "", {.names = {"flux", "UV"}}).empty());
    EXPECT_TRUE(read_estimates(kOne, "", {.names = {"flux", "PAR"}, .part = "days"}).empty());
    const auto unknown = read_estimates(
        R"({"organs":[{"flux":{"PAR":{"mean":null,"standard_error":null}}},{"flux":{"PAR":null}}]})",
        "", {.names = {"flux", "PAR"}});
    ASSERT_EQ(unknown.size(), 1U);
    EXPECT_TRUE(std::isnan(unknown[0].values[0].mean));
    EXPECT_THROW(static_cast<void>(read_estimates("{\"organs\": [", "r.json", {})), InputError);
}

}  // namespace
}  // namespace quasimc::test
