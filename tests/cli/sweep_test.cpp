// Sweeps from the command line: one table, one result, whatever happens on the way.

#include <string>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

class SweepCommand : public ProgramTest {
  protected:
    void write_sweep(const std::string& keys) const {
        folder_.write("sweep.toml", good_run_file() + "[sweep]\n" + keys);
    }
    [[nodiscard]] static std::size_t count(const std::string& text, const std::string& part) {
        std::size_t found = 0;
        for (std::size_t at = text.find(part); at != std::string::npos;
             at = text.find(part, at + 1)) {
            ++found;
        }
        return found;
    }
};

TEST_F(SweepCommand, KeepsTheLabelsOfOrgansAtEveryPoint) {
    folder_.write(
        "sweep.toml", replaced(good_run_file(), "[[organ]]", "[[organ]]\nlabels = { plant = 7 }") +
                          "[sweep]\nseed = [1, 2, 3, 4]\npaths = [64, 128]\n");
    ASSERT_EQ(run({"run", "sweep.toml"}).status, 0);
    EXPECT_EQ(count(folder_.read("out.csv"), ",7,"), 8U) << folder_.read("out.csv");
}

TEST_F(SweepCommand, HasPointsThatAreDark) {
    for (const char* days : {R"("2024-12-21", "2024-06-21")", R"("2024-06-21", "2024-12-21")"}) {
        folder_.write(
            "sweep.toml", good_run_file() +
                              "[site]\nlatitude_deg = 80\nlongitude_deg = 8\n"
                              "[time]\nday = \"2024-01-01\"\nstep_minutes = 360\n"
                              "utc_offset_hours = 1\n[sweep]\ntime.day = [" +
                              std::string(days) + "]\n");
        ASSERT_EQ(run({"run", "sweep.toml", "--paths", "64"}).status, 0);
        EXPECT_EQ(count(folder_.read("out.json"), "\n\"point\": {"), 2U);
        const Outcome again = run({"run", "--repeat", "out.json"});
        EXPECT_NE(again.out.find("the same numbers as in out.json"), std::string::npos)
            << again.err;
    }
}

TEST_F(SweepCommand, HasZerosWhereNoSourceShines) {
    write_sweep("source.1.irradiance_facing = [400, 0]\n");
    const Outcome outcome = run({"run", "sweep.toml"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(
        outcome.err.find("[sweep]: no source gives light at 1 of 2 points, and all results are 0; "
                         "the first is point 2 (source.1.irradiance_facing = 0)"),
        std::string::npos)
        << outcome.err;
    EXPECT_EQ(count(folder_.read("out.csv"), "\n0,1,third,"), 1U) << folder_.read("out.csv");
    EXPECT_EQ(run({"run", "--repeat", "out.json"}).status, 0);
}

TEST_F(SweepCommand, HasAColumnForEachKeyAndTheRowsOfAllPoints) {
    write_sweep("paths = [64, 128]\nseed = [1, 2]\n");
    const Outcome outcome = run({"run", "sweep.toml", "--groups-csv", "groups.csv"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const std::string csv = folder_.read("out.csv");
    EXPECT_EQ(count(csv, "\npaths,seed,id,name,"), 1U) << csv;
    for (const char* point :
         {"\n64,1,1,third,", "\n64,2,1,third,", "\n128,1,1,third,", "\n128,2,1,third,"}) {
        EXPECT_EQ(count(csv, point), 1U) << point;
    }
    EXPECT_EQ(count(folder_.read("groups.csv"), ",all,,"), 4U);
    EXPECT_EQ(
        count(folder_.read("out.json"), "\n\"point\": {\n  \"paths\": 128,\n  \"seed\": 2\n},"),
        1U);
    EXPECT_NE(outcome.out.find("4 of 4 points completed"), std::string::npos) << outcome.out;
}

TEST_F(SweepCommand, IsSummedWithItsWeights) {
    write_sweep(
        "source.1.irradiance_facing = [400, 100]\nweights = [1, 3]\n[[table]]\nfile = 'sum.csv'\n"
        "per = 'sweep'\nquantities = ['absorbed_flux']\n");
    const Outcome outcome = run({"run", "sweep.toml"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(
        outcome.out.find("sweep     mean of all points: PAR organs absorb 61.5"), std::string::npos)
        << outcome.out;
    const std::string sum = folder_.read("sum.csv");
    EXPECT_EQ(count(sum, "\nid,name,"), 1U) << sum;
    EXPECT_EQ(count(sum, "\n1,third,"), 1U) << sum;
    const Outcome other = run({"run", "sweep.toml", "--threads", "1"});
    ASSERT_EQ(other.status, 0);
    const std::string once = folder_.read("sum.csv");
    EXPECT_EQ(once.substr(once.find("\nid,")), sum.substr(sum.find("\nid,")));
}

TEST_F(SweepCommand, IsRepeatedFromItsResult) {
    write_sweep("paths = [64, 128]\n");
    ASSERT_EQ(run({"run", "sweep.toml"}).status, 0);
    const Outcome again = run({"run", "--repeat", "out.json"});
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_NE(again.out.find("the same numbers as in out.json"), std::string::npos) << again.out;
}

TEST_F(SweepCommand, OfTimesHasTheTimesOfEachPoint) {
    write_sweep(
        "source.lamp.irradiance_facing = [[1], [2]]\n"
        "[[source]]\nname = \"lamp\"\ntype = \"directional\"\ndirection = [0, 0, -1]\n"
        "irradiance_facing = 1\n"
        "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
        "[time]\nday = \"2024-06-21\"\nutc_offset_hours = 1\nhours = [11, 13]\n");
    std::string file = folder_.read("sweep.toml");
    const Outcome outcome = run({"run", "sweep.toml", "--daily-csv", "days.csv", "--paths", "64"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(count(folder_.read("out.csv"), "source.lamp.irradiance_facing,time,id"), 1U);
    EXPECT_EQ(count(folder_.read("out.csv"), "\n[1],2024-06-21T11:00+01:00,1,"), 1U);
    EXPECT_EQ(count(folder_.read("out.csv"), "\n[2],2024-06-21T12:00+01:00,1,"), 1U);
    EXPECT_EQ(count(folder_.read("days.csv"), "\n[2],2024-06-21,7200,1,"), 1U);
    EXPECT_EQ(count(folder_.read("out.json"), "\"time_steps\": ["), 2U);
    EXPECT_EQ(run({"run", "--repeat", "out.json"}).status, 0);
}

TEST_F(SweepCommand, ThatEndsEarlyHasThePointsThatAreDone) {
    write_sweep("seed = [1, 2, 3]\n");
    const Outcome outcome =
        run_within(1.5, {"run", "sweep.toml", "--paths", "1073741824"}, "3 of 3 points completed");
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    const std::string csv = folder_.read("out.csv");
    EXPECT_EQ(count(csv, "\n1,1,third,"), 1U) << outcome.err;
    EXPECT_EQ(count(csv, "\n3,1,third,"), 1U) << "each point has its share";
    EXPECT_EQ(count(folder_.read("out.json"), "\"points_requested\": 3"), 1U);
}

TEST_F(SweepCommand, IsCheckedWholeAndConvertedPointByPoint) {
    write_sweep("seed = [1, 2]\npaths = [-63, 0]\nsampler = [\"sobol\"]\n");
    const Outcome bad = run({"check", "sweep.toml"});
    EXPECT_EQ(bad.status, 1);
    EXPECT_NE(bad.err.find("paths: -63 is out of range"), std::string::npos) << bad.err;
    EXPECT_NE(bad.err.find("paths: 0 is out of range"), std::string::npos) << bad.err;
    write_sweep("seed = [1, 2]\n");
    EXPECT_NE(run({"check", "sweep.toml"}).out.find("a sweep of 2 points"), std::string::npos);
    EXPECT_EQ(run({"convert", "sweep.toml", "scene.obj", "--sweep-point", "2"}).status, 0);
    EXPECT_EQ(run({"convert", "sweep.toml", "scene.obj", "--sweep-point", "3"}).status, 2);
}

}  // namespace
}  // namespace quasimc::test
