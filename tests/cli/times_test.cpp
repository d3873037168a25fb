#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

/// The good run file at two hours of each of two days.
std::string run_file_of_days() {
    return good_run_file() +
           "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
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
        run({"run", "days.toml", "--csv", "t.csv", "--daily-csv", "d.csv", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("time steps 4 from 2024-06-20T11:00+01:00"), std::string::npos)
        << outcome.out;
    const std::string times = folder_.read("t.csv");
    EXPECT_EQ(rows(times), 4 * 3);
    EXPECT_NE(times.find("\ntime,id,name,"), std::string::npos);
    EXPECT_NE(times.find("\n2024-06-21T12:00+01:00,1,third,"), std::string::npos);
    EXPECT_NE(
        times.find("# time_step: 2024-06-21T12:00+01:00, 3600 s; sun azimuth"), std::string::npos);
    const std::string days = folder_.read("d.csv");
    EXPECT_EQ(rows(days), 2 * 3);
    EXPECT_NE(days.find("\n2024-06-21,7200,1,third,"), std::string::npos);
    EXPECT_NE(days.find("[J m-2 d-1]"), std::string::npos);
    EXPECT_NE(folder_.read("r.json").find("\"time_steps\": ["), std::string::npos);
}

TEST_F(TimesTest, AreCollapsedOnDemand) {
    folder_.write("period.toml", run_file_of_days() + "cumulative_sky = \"period\"\n");
    const Outcome checked = run({"check", "period.toml"});
    EXPECT_NE(
        checked.out.find("4 time steps in 1 cumulative sky with 12 sun positions"),
        std::string::npos)
        << checked.out;
    const Outcome outcome =
        run({"run", "period.toml", "--csv", "t.csv", "--daily-csv", "d.csv", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(
        outcome.out.find("in 1 cumulative sky with 12 sun positions: 1 computed"),
        std::string::npos)
        << outcome.out;
    EXPECT_EQ(rows(folder_.read("t.csv")), 3);
    const std::string sums = folder_.read("d.csv");
    EXPECT_EQ(rows(sums), 3);
    EXPECT_NE(sums.find("\n2024-06-20/2024-06-21,14400,1,third,"), std::string::npos) << sums;
    const Outcome again = run({"run", "--repeat", "r.json", "--threads", "2"});
    EXPECT_NE(again.out.find("the same numbers as in"), std::string::npos) << again.out;
}

/// Hours that are computed together are written as those one by one are.
TEST_F(TimesTest, AreComputedTogetherOnDemand) {
    const std::vector<std::string> together{
        "run", "days.toml", "--time-method", "daylight_coefficients", "--method", "ray_bundles"};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = together;
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    const Outcome outcome = with({"--csv", "t.csv", "--daily-csv", "d.csv", "--json", "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(rows(folder_.read("t.csv")), 4 * 3);
    EXPECT_EQ(rows(folder_.read("d.csv")), 2 * 3);
    EXPECT_NE(
        folder_.read("r.json").find("\"time_method\": \"daylight_coefficients\""),
        std::string::npos);
    const Outcome kept = with({"--checkpoint", "c.checkpoint"});
    EXPECT_EQ(kept.status, 2);
    EXPECT_NE(kept.err.find("\"daylight_coefficients\", with a checkpoint"), std::string::npos)
        << kept.err;
}

/// A day and a night of whole hours, of two plants.
std::string day_of_plants() {
    std::string text = good_run_file();
    const std::string organ = "name = \"third\"\n";
    text.insert(text.find(organ) + organ.size(), "labels = { plant = 3 }\n");
    const std::size_t source = text.find("[[source]]");
    text.erase(source, text.find("[[material]]") - source);
    return text +
           "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
           "[time]\nday = \"2024-06-21\"\nutc_offset_hours = 1\nsky = \"uniform\"\n"
           "sun_step_minutes = 60\nstep_minutes = 120\n";
}

std::ptrdiff_t lines_with(const std::string& text, const std::string& part) {
    std::ptrdiff_t count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++count;
    }
    return count;
}

TEST_F(TimesTest, WithoutLightAreWrittenOnDemand) {
    folder_.write("day.toml", day_of_plants());
    ASSERT_EQ(run({"run", "day.toml", "--csv", "day.csv", "--json", "day.json"}).status, 0);
    ASSERT_EQ(
        run({"run", "day.toml", "--csv", "all.csv", "--json", "all.json", "--include-night"})
            .status,
        0);
    EXPECT_EQ(rows(folder_.read("all.csv")), 12 * 3);
    const std::ptrdiff_t lit = rows(folder_.read("day.csv"));
    EXPECT_LT(lit, 12 * 3);
    EXPECT_GE(lit, 8 * 3);
    EXPECT_EQ(lines_with(folder_.read("day.json"), "\"computed\": \"2024"), lit / 3);
    const Outcome again = run({"run", "--repeat", "day.json", "--threads", "2"});
    EXPECT_NE(again.out.find("the same numbers as in"), std::string::npos) << again.out;
    const Outcome other = run({"run", "--repeat", "all.json", "--quantities", "absorbed_flux"});
    EXPECT_NE(other.out.find("the same numbers as in"), std::string::npos)
        << "whatever is written: " << other.out;
}

TEST_F(TimesTest, OfSomeHoursAreWrittenOnDemand) {
    std::string text = day_of_plants();
    const std::string output = "[output]\n";
    text.insert(text.find(output) + output.size(), "time_of_day = [10, 14]\n");
    folder_.write("noon.toml", text);
    const Outcome outcome = run({"run", "noon.toml", "--csv", "noon.csv", "--daily-csv", "d.csv"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(rows(folder_.read("noon.csv")), 2 * 3);
    EXPECT_NE(folder_.read("d.csv").find("\n2024-06-21,86400,"), std::string::npos)
        << "sums are of all times";
}

TEST_F(TimesTest, HaveSumsOfGroups) {
    folder_.write("day.toml", day_of_plants());
    const Outcome outcome = run(
        {"run", "day.toml", "--groups", "plant", "--groups-csv", "g.csv", "--groups-daily-csv",
         "d.csv", "--json", "r.json", "--layer-heights", "0,2,6"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    const std::string days = folder_.read("d.csv");
    EXPECT_NE(days.find("\ndate,seconds,by,value,organs,area,"), std::string::npos);
    EXPECT_NE(days.find("\n2024-06-21,86400,all,,3,"), std::string::npos) << days;
    EXPECT_NE(days.find("\n2024-06-21,86400,plant,3,1,"), std::string::npos) << days;
    EXPECT_NE(days.find("\n2024-06-21,86400,layer,2,2,"), std::string::npos) << days;
    EXPECT_NE(folder_.read("g.csv").find("\ntime,by,value,"), std::string::npos);
    EXPECT_NE(folder_.read("r.json").find("\"by\":\"plant\",\"value\":\"3\""), std::string::npos);
}

TEST_F(TimesTest, ChoicesThatAreNoneAreRefused) {
    const Outcome outcome = run(
        {"run", "run.toml", "--quantities", "absorbd_flux", "--bands", "NIR", "--include-night"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(
        outcome.err.find(
            "--quantities: 'absorbd_flux' is not a quantity; did you mean 'absorbed_flux'?"),
        std::string::npos)
        << outcome.err;
    EXPECT_NE(outcome.err.find("--bands: 'NIR' is not a band"), std::string::npos);
    EXPECT_NE(outcome.err.find("--include-night: the run has no [time]"), std::string::npos);
    EXPECT_EQ(run({"run", "run.toml", "--groups-csv", "a", "--csv", "a"}).status, 2);
    const Outcome unknown = run({"run", "run.toml", "--groups", "plant"});
    EXPECT_NE(
        unknown.err.find("--groups: groups: no organ has a label 'plant' (no organ has any label)"),
        std::string::npos)
        << unknown.err;
}

TEST_F(TimesTest, NameTheirMethod) {
    const Outcome outcome = run({"run", "days.toml", "--csv", "t.csv", "--method", "first_hits"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("method    first_hits (requested)"), std::string::npos)
        << outcome.out;
}

TEST_F(TimesTest, AreRepeatedFromTheirResult) {
    ASSERT_EQ(run({"run", "days.toml", "--json", "r.json", "--threads", "1"}).status, 0);
    const Outcome outcome = run({"run", "--repeat", "r.json", "--threads", "2"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("the same numbers as in"), std::string::npos) << outcome.out;
    const Outcome other = run({"run", "--repeat", "r.json", "--seed", "5"});
    EXPECT_NE(other.out.find("OTHER numbers than in"), std::string::npos) << other.out;
}

TEST_F(TimesTest, DaysNeedTimes) {
    const Outcome outcome = run({"run", "run.toml", "--daily-csv", "d.csv"});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find("--daily-csv: the run has no [time]"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(run({"run", "days.toml", "--daily-csv", "a.csv", "--csv", "a.csv"}).status, 2);
}

TEST_F(TimesTest, CheckCountsThem) {
    const Outcome outcome = run({"check", "days.toml"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("4 time steps, 2 days, 4 of them with daylight"), std::string::npos)
        << outcome.out;
    EXPECT_NE(
        outcome.out.find("1 band, sun and sky for 4 time steps, 1 source\n"), std::string::npos)
        << outcome.out;
}

/// Nights alone have a result: zeros without an error, and a warning.
TEST_F(TimesTest, OfNightsAloneAreZeros) {
    folder_.write(
        "night.toml", replaced(run_file_of_days(), "hours = [11, 13]", "hours = [1, 3]") +
                          "cumulative_sky = \"none\"\n");
    std::string text = folder_.read("night.toml");
    text = replaced(
        text, "[[source]]\ntype = \"directional\"\ndirection = [0, 0, -1]\nirradiance_facing = 1\n",
        "");
    folder_.write("night.toml", text);
    const Outcome outcome = run(
        {"run", "night.toml", "--include-night", "--csv", "t.csv", "--daily-csv", "d.csv", "--json",
         "r.json"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("it is night at all time steps"), std::string::npos) << outcome.err;
    EXPECT_EQ(rows(folder_.read("t.csv")), 4 * 3);
    EXPECT_EQ(rows(folder_.read("d.csv")), 2 * 3);
    EXPECT_EQ(run({"run", "--repeat", "r.json"}).status, 0);
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
            outcome.out.find("no light reaches the scene; nothing was computed"), std::string::npos)
            << outcome.out;
        EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
        EXPECT_NE(folder_.read("out.json").find("\"no_light\""), std::string::npos);
    }
}

}  // namespace
}  // namespace quasimc::test
