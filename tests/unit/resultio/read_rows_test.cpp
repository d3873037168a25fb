#include "resultio/read_rows.h"

#include <cmath>

#include <gtest/gtest.h>

#include "quasimc/error.h"

namespace quasimc::test {
namespace {

using Rest = RowsQuery::Rest;
using Columns = std::vector<std::vector<std::string>>;

std::string estimate(double mean) {
    const std::string m = std::to_string(mean);
    return R"({"mean":)" + m + R"(,"standard_error":0.5,"ci95_low":)" + m + R"(,"ci95_high":9})";
}

/// Two organs, whose light is `first` and one more.
std::string organs(double first) {
    std::string text = "[";
    for (const double mean : {first, first + 1}) {
        text += std::string(text.size() > 1 ? "," : "") +
                R"({"id":7,"name":"mean","labels":{"flux":"x"},"area":3,"flux":{"PAR":)" +
                estimate(mean) + R"(,"NIR":)" + estimate(-mean) + R"(},"sunlit_fraction":)" +
                estimate(100 + mean) + R"(,"ratios":{"R/FR":)" + estimate(200 + mean) + "}}";
    }
    return text + "]";
}

const std::string kOne = R"({"run_file":{"organs":[1,2],"mean":4},"organs":)" + organs(1) +
                         R"(,"groups":[{"by":"all","flux":{"PAR":)" + estimate(5) +
                         R"(}}],"organs_sha256":"0"})";
const std::string kTimes =
    R"({"run_file":{"time":"2024-06-21T12:00"},"time_steps":[{"time":"2024-06-21T12:00","organs":)" +
    organs(1) + R"(},{"time":"2024-06-21T13:00","sun":{"towards":[0,0,1]},"organs":)" + organs(3) +
    R"(}],"days":[{"date":"2024-06-21","groups":[],"organs":)" + organs(5) +
    R"(}],"total":{"organs":)" + organs(7) + "}}";
const std::string kPoints = R"({"title":"t","points":[{"point":{"seed":1},"organs":)" + organs(1) +
                            R"(},{"point":{"seed":2},"time_steps":[{"time":"a","organs":)" +
                            organs(9) + R"(}]}],"completed":3})";

/// The means of the first column of every list, one after the other.
std::vector<double> means_of(const std::string& text, RowsQuery query) {
    std::vector<double> means;
    for (const PlacedRows& rows : read_rows(text, "result.json", query)) {
        for (const Estimate& each : rows.columns.front()) {
            means.push_back(each.mean);
        }
    }
    return means;
}

using Means = std::vector<double>;
const Columns kPar{{"flux", "PAR"}};

TEST(ReadRows, TakesWhatIsAskedFor) {
    EXPECT_EQ(means_of(kOne, {.columns = kPar}), (Means{1, 2}));
    EXPECT_EQ(means_of(kOne, {.columns = {{"flux", "NIR"}}}), (Means{-1, -2}));
    EXPECT_EQ(means_of(kOne, {.columns = {{"sunlit_fraction"}}}), (Means{101, 102}));
    EXPECT_EQ(means_of(kOne, {.columns = {{"ratios", "R/FR"}}}), (Means{201, 202}));
    EXPECT_EQ(means_of(kOne, {.lists = {"groups"}, .columns = kPar}), Means{5});
    EXPECT_EQ(means_of(kOne, {.columns = {{"flux", "UV"}}}), Means{});
    EXPECT_EQ(means_of(kOne, {.columns = kPar, .part = "days"}), Means{});
    const auto rows = read_rows(
        kOne, "", {.columns = {{"flux", "NIR"}, {"flux", "UV"}, {"flux", "PAR"}, {"flux", "PAR"}}});
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_TRUE(rows[0].columns[1].empty());
    for (const std::size_t same : {2U, 3U}) {
        const Estimate& second = rows[0].columns[same].at(1);
        EXPECT_EQ(second.mean, 2);
        EXPECT_EQ(second.standard_error, 0.5);
        EXPECT_EQ(second.ci95_low, 2);
        EXPECT_EQ(second.ci95_high, 9);
    }
}

TEST(ReadRows, FindsTimesDaysAndTheirSum) {
    EXPECT_EQ(means_of(kTimes, {.columns = kPar, .part = "time_steps"}), (Means{1, 2, 3, 4}));
    EXPECT_EQ(
        means_of(kTimes, {.columns = kPar, .part = "time_steps", .label = "2024-06-21T13"}),
        (Means{3, 4}));
    EXPECT_EQ(means_of(kTimes, {.columns = kPar, .part = "days"}), (Means{5, 6}));
    EXPECT_EQ(means_of(kTimes, {.columns = kPar, .part = "total"}), (Means{7, 8}));
    const auto all = read_rows(kTimes, "", {.columns = kPar});
    ASSERT_EQ(all.size(), 4U);
    EXPECT_EQ(all[1].position.index, 1U);
    EXPECT_EQ(all[1].position.label, "2024-06-21T13:00");
    EXPECT_EQ(all[2].position.part, "days");
    EXPECT_EQ(all[2].position.label, "2024-06-21");
}

TEST(ReadRows, FindsThePointOfASweep) {
    EXPECT_EQ(means_of(kPoints, {.columns = kPar, .point = 0}), (Means{1, 2}));
    EXPECT_EQ(
        means_of(kPoints, {.columns = kPar, .part = "time_steps", .point = 1}), (Means{9, 10}));
    EXPECT_EQ(means_of(kPoints, {.columns = kPar, .point = 2}), Means{});
    EXPECT_EQ(read_rows(kPoints, "", {.columns = kPar}).back().position.point, 1U);
}

TEST(ReadRows, LeavesWhatIsNotKnown) {
    const auto rows = read_rows(
        R"({"organs":[{"flux":{"PAR":{"mean":null,"ci95_high":4}}},{"flux":{"PAR":null}},)"
        R"({"flux":{"PAR":{"mean":3}}}]})",
        "", {.columns = kPar});
    ASSERT_EQ(rows.size(), 1U);
    const std::vector<Estimate>& par = rows[0].columns[0];
    ASSERT_EQ(par.size(), 3U);
    EXPECT_TRUE(std::isnan(par[0].mean));
    EXPECT_EQ(par[0].ci95_high, 4);
    EXPECT_TRUE(std::isnan(par[1].ci95_high));
    EXPECT_EQ(par[2].mean, 3);
}

TEST(ReadRows, KeepsTheRest) {
    const auto rest = [](const std::string& text, Rest kept) {
        return read_rows(text, "", {.rest = kept}, {});
    };
    const Node all = rest(kOne, Rest::all);
    EXPECT_EQ(all.find("organs"), nullptr);
    EXPECT_NE(all.find("groups"), nullptr);
    EXPECT_EQ(text_in(all, "organs_sha256"), "0");
    EXPECT_NE(rest(kOne, Rest::head).find("run_file"), nullptr);
    EXPECT_EQ(rest(kOne, Rest::head).find("groups"), nullptr);
    EXPECT_EQ(rest(kTimes, Rest::head).find("time_steps"), nullptr);
    EXPECT_EQ(rest(kTimes, Rest::labels).find("run_file"), nullptr);
    const Node second = only_point(rest(kPoints, Rest::all), 1, "");
    EXPECT_EQ(text_in(second, "title"), "t");
    EXPECT_EQ(second.find("points"), nullptr);
    EXPECT_NE(second.find("time_steps"), nullptr);
    EXPECT_NE(second.find("completed"), nullptr);
    EXPECT_THROW((void)only_point(rest(kPoints, Rest::all), 2, ""), InputError);
    EXPECT_THROW((void)only_point(rest(R"({"points":4})", Rest::all), 0, ""), InputError);
    EXPECT_THROW((void)only_point(rest("[]", Rest::all), {}, ""), InputError);
}

TEST(ReadRows, TellsWhereATextIsNoJson) {
    const auto fault_of = [](const std::string& text) -> std::string {
        try {
            (void)read_rows(text, "r.json", {.columns = kPar});
        } catch (const InputError& error) {
            return error.faults().front().text();
        }
        return "";
    };
    EXPECT_EQ(fault_of(R"({"organs": [1 2]})"), "r.json: byte 15 is not JSON");
    for (const char* text :
         {"", "{", "[1,2", R"({"organs":[{]})", "nul", R"({"organs":[{}],"x":1)"}) {
        EXPECT_NE(fault_of(text).find("not JSON"), std::string::npos) << text;
    }
    EXPECT_NE(fault_of(R"({"organs":[{"a":1e999}]})").find("too large"), std::string::npos);
    const std::string deep = std::string(1000, '[') + std::string(1000, ']');
    EXPECT_NE(fault_of(deep).find("is nested too deeply"), std::string::npos);
    EXPECT_NE(
        fault_of("{\"organs\":" + deep + "}").find("is nested too deeply"), std::string::npos);
    // Strange, but nothing is found in them.
    for (const char* text :
         {R"([{"organs":[{"flux":{"PAR":{"mean":1}}}]}])",
          R"({"organs":[1,[{}],{"flux":3},null,[[{"flux":[{"PAR":{"mean":1}}]}]]]})",
          R"({"time_steps":3,"days":[4],"total":[{"organs":[{}]}]})",
          R"({"time_steps":{"a":{"organs":[{"flux":{"PAR":{"mean":1}}}]}}})",
          R"({"time_steps":{"":{"organs":[{"flux":{"PAR":{"mean":1}}}]}}})",
          R"({"points":{"":{"time_steps":[{"organs":[{"flux":{"PAR":{"mean":1}}}]}]}}})",
          R"({"points":[[{"organs":[{"flux":{"PAR":{"mean":1}}}]}]]})"}) {
        EXPECT_EQ(means_of(text, {.columns = kPar}), Means{}) << text;
    }
}

}  // namespace
}  // namespace quasimc::test
