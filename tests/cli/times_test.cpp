#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

/// The good run file at two hours of each of two days.
std::string run_file_of_days() {
    return good_run_file() +
           "[place]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
           "[time]\nfrom = \"2024-06-20\"\nto = \"2024-06-21\"\nutc_offset_hours = 1\n"
           "hours = [11, 13]\nsky = \"uniform\"\nsun_step_minutes = 20\n";
}

class TimesTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        folder_.write("days.toml", run_file_of_days());
    }
};

/// Lines of a table that are neither comments nor the header.
std::ptrdiff_t rows(const std::string& table) {
    const std::size_t header = table.find("id,name");
    const auto begin = table.begin() + static_cast<std::ptrdiff_t>(table.find('\n', header)) + 1;
    return std::count(begin, table.end(), '\n');
}

TEST_F(TimesTest, AreWrittenByTimeAndByDay) {
    const Outcome outcome =
        run({"run", "days.toml", "--csv", "t.csv", "--days", "d.csv", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("4 from 2024-06-20T11:00+01:00"), std::string::npos) << outcome.out;
    const std::string times = folder_.read("t.csv");
    EXPECT_EQ(rows(times), 4 * 3);
    EXPECT_NE(times.find("\ntime,id,name,"), std::string::npos);
    EXPECT_NE(times.find("\n2024-06-21T12:00+01:00,1,third,"), std::string::npos);
    EXPECT_NE(
        times.find("# moment: 2024-06-21T12:00+01:00, 3600 s; sun azimuth"), std::string::npos);
    const std::string days = folder_.read("d.csv");
    EXPECT_EQ(rows(days), 2 * 3);
    EXPECT_NE(days.find("\n2024-06-21,7200,1,third,"), std::string::npos);
    EXPECT_NE(days.find("[J m-2 d-1]"), std::string::npos);
    EXPECT_NE(folder_.read("r.json").find("\"moments\": ["), std::string::npos);
}

TEST_F(TimesTest, AreCollapsedOnDemand) {
    folder_.write("period.toml", run_file_of_days() + "collapse = \"period\"\n");
    const Outcome checked = run({"check", "period.toml"});
    EXPECT_NE(
        checked.out.find("4 times collapsed into 1 traces of 12 suns in all"), std::string::npos)
        << checked.out;
    const Outcome outcome =
        run({"run", "period.toml", "--csv", "t.csv", "--days", "d.csv", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("collapsed into 1 traces of 12 suns"), std::string::npos)
        << outcome.out;
    EXPECT_EQ(rows(folder_.read("t.csv")), 3);
    const std::string sums = folder_.read("d.csv");
    EXPECT_EQ(rows(sums), 3);
    EXPECT_NE(sums.find("\n2024-06-20/2024-06-21,14400,1,third,"), std::string::npos) << sums;
    const Outcome again = run({"run", "--from", "r.json", "--threads", "2"});
    EXPECT_NE(again.out.find("the same numbers as in"), std::string::npos) << again.out;
}

TEST_F(TimesTest, NameTheirMethod) {
    const Outcome outcome = run({"run", "days.toml", "--csv", "t.csv", "--method", "first_hits"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("sobol points, first_hits, "), std::string::npos) << outcome.out;
}

TEST_F(TimesTest, AreRepeatedFromTheirResult) {
    ASSERT_EQ(run({"run", "days.toml", "--json", "r.json", "--threads", "1"}).status, 0);
    const Outcome outcome = run({"run", "--from", "r.json", "--threads", "2"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("the same numbers as in"), std::string::npos) << outcome.out;
    const Outcome other = run({"run", "--from", "r.json", "--seed", "5"});
    EXPECT_NE(other.out.find("OTHER numbers than in"), std::string::npos) << other.out;
}

TEST_F(TimesTest, DaysNeedTimes) {
    const Outcome outcome = run({"run", "run.toml", "--days", "d.csv"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("--days: the run has no [time]"), std::string::npos) << outcome.err;
    EXPECT_EQ(run({"run", "days.toml", "--days", "a.csv", "--csv", "a.csv"}).status, 2);
}

TEST_F(TimesTest, CheckCountsThem) {
    const Outcome outcome = run({"check", "days.toml"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("4 times of 2 days"), std::string::npos) << outcome.out;
}

/// Nights alone have a result: zeros without an error, and a warning.
TEST_F(TimesTest, OfNightsAloneAreZeros) {
    folder_.write(
        "night.toml", replaced(run_file_of_days(), "hours = [11, 13]", "hours = [1, 3]") +
                          "collapse = \"none\"\n");
    std::string text = folder_.read("night.toml");
    text = replaced(
        text, "[[source]]\ntype = \"directional\"\ndirection = [0, 0, -1]\nirradiance_facing = 1\n",
        "");
    folder_.write("night.toml", text);
    const Outcome outcome =
        run({"run", "night.toml", "--csv", "t.csv", "--days", "d.csv", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("dark at all these times"), std::string::npos) << outcome.err;
    EXPECT_EQ(rows(folder_.read("t.csv")), 4 * 3);
    EXPECT_EQ(rows(folder_.read("d.csv")), 2 * 3);
    EXPECT_EQ(run({"run", "--from", "r.json"}).status, 0);
}

/// Neither does a scene that is edge-on to all light have a fault.
TEST_F(TimesTest, AndScenesWithoutLightHaveNoFault) {
    const std::string geometry = "[[geometry]]\nfile = \"leaves.tri\"\nmaterial = \"leaf\"\n";
    const std::string upright = replaced(
        replaced(good_run_file(), geometry, ""), "[[0, 0, 5], [1, 0, 5], [0, 1, 5]]",
        "[[0, 0, 5], [1, 0, 5], [0, 0, 6]]");
    folder_.write("upright.toml", upright);
    for (const char* method : {"light_tracing", "first_hits", "from_organs", "auto"}) {
        const Outcome outcome =
            run({"run", "upright.toml", "--method", method, "--target-error", "0.01"});
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_NE(outcome.err.find("warning: no light reaches the scene"), std::string::npos);
        EXPECT_NE(
            outcome.out.find("no light reaches the scene, nothing was traced"), std::string::npos)
            << outcome.out;
        EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
        EXPECT_NE(folder_.read("out.json").find("\"no_light\""), std::string::npos);
    }
}

}  // namespace
}  // namespace quasimc::test
