// Lamps under control in sweeps, from checkpoints and in parts.

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "program.h"

namespace quasimc::test {
namespace {

/// Lamps that are dimmed where a winter's morning has too little light, which leaves block in part.
std::string morning() {
    return good_run_file() +
           "[[source]]\ntype = \"point\"\nname = \"hps\"\nposition = [0.5, 0.5, 6]\npower = 4000\n"
           "[[sensors]]\nname = \"bench\"\nat = [[0.2, 0.2, 0], [0.9, 0.9, 0.5]]\n"
           "[[control]]\nsources = \"hps\"\nsensors = \"bench\"\nset_point = 16\ndim_min = 0.01\n"
           "on_below = 150\nelectrical_power_w = 500\n"
           "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
           "[time]\nday = \"2024-12-15\"\nutc_offset_hours = 1\nhours = [7, 12]\n"
           "sky = \"uniform\"\n"
           "[[table]]\nfile = \"control.csv\"\nrows = \"control\"\n";
}

class ControlTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        folder_.write("morning.toml", morning());
    }
    /// A table without the lines on how it was made.
    [[nodiscard]] std::string rows(const std::string& name) const {
        const std::string table = folder_.read(name);
        const std::size_t head = table.find("\ntime,");
        const std::size_t at = head == std::string::npos ? table.find("\nid,name") : head;
        return at == std::string::npos ? "no table" : table.substr(at);
    }
    /// Runs and keeps the tables of controls and of organs under a name.
    void run_as(const std::string& name, std::vector<std::string> words) const {
        words.insert(words.end(), {"--csv", name + ".csv", "-q"});
        const Outcome outcome = run(words);
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        std::filesystem::rename(
            folder_.path() / "control.csv", folder_.path() / (name + "_control.csv"));
    }
    void expect_same(const std::string& a, const std::string& b) const {
        EXPECT_EQ(rows(a + ".csv"), rows(b + ".csv"));
        EXPECT_EQ(rows(a + "_control.csv"), rows(b + "_control.csv"));
    }
    [[nodiscard]] nlohmann::json json_of(const std::string& name) const {
        return nlohmann::json::parse(folder_.read(name));
    }
};

/// The negative control: other random numbers give other factors, of which some are not 0 or 1.
TEST_F(ControlTest, HasFactorsThatDependOnRandomNumbers) {
    run_as("one", {"run", "morning.toml"});
    run_as("other", {"run", "morning.toml", "--seed", "2"});
    EXPECT_NE(rows("one_control.csv"), rows("other_control.csv"));
    EXPECT_NE(rows("one.csv"), rows("other.csv"));
    ASSERT_EQ(run({"run", "morning.toml", "-q", "--json", "one.json"}).status, 0);
    const nlohmann::json steps = json_of("one.json").at("control").at(0).at("time_steps");
    ASSERT_EQ(steps.size(), 5U);
    const auto is_dimmed = [](const nlohmann::json& step) {
        return step.at("factor") > 0 && step.at("factor") < 1;
    };
    EXPECT_TRUE(std::any_of(steps.begin(), steps.end(), is_dimmed)) << steps;
}

TEST_F(ControlTest, InASweepIsThatOfEachPointAlone) {
    folder_.write(
        "sweep.toml", morning() + "[sweep]\n\"control.1.set_point\" = [16, 17]\nseed = [1, 2]\n");
    ASSERT_EQ(run({"run", "sweep.toml", "-q", "--json", "sweep.json"}).status, 0);
    const nlohmann::json points = json_of("sweep.json").at("points");
    ASSERT_EQ(points.size(), 4U);
    for (std::size_t i = 0; i < points.size(); ++i) {
        folder_.write(
            "alone.toml",
            replaced(morning(), "set_point = 16", i < 2 ? "set_point = 16" : "set_point = 17"));
        ASSERT_EQ(
            run({"run", "alone.toml", "-q", "--seed", i % 2 == 0 ? "1" : "2", "--json", "a.json"})
                .status,
            0);
        const nlohmann::json alone = json_of("a.json");
        EXPECT_EQ(points[i].at("control"), alone.at("control")) << i;
        EXPECT_EQ(points[i].at("days").at(0).at("organs"), alone.at("days").at(0).at("organs"));
    }
    EXPECT_NE(points[0].at("control"), points[2].at("control"));
}

TEST_F(ControlTest, FromACheckpointIsThatOfTheWhole) {
    run_as("whole", {"run", "morning.toml"});
    run_as("first", {"run", "morning.toml", "--checkpoint", "c"});
    run_as("again", {"run", "morning.toml", "--checkpoint", "c", "--resume"});
    expect_same("first", "whole");
    expect_same("again", "whole");
}

TEST_F(ControlTest, InPartsIsThatOfTheWhole) {
    run_as("whole", {"run", "morning.toml"});
    for (const std::string part : {"1", "2"}) {
        const Outcome outcome = run(
            {"run", "morning.toml", "--part", part + "/2", "--part-file", "p" + part, "--threads",
             part});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    ASSERT_EQ(
        run({"merge", "p1", "p2", "--csv", "merged.csv", "--json", "m.json", "-q"}).status, 0);
    EXPECT_EQ(rows("merged.csv"), rows("whole.csv"));
    ASSERT_EQ(run({"run", "morning.toml", "-q", "--json", "w.json"}).status, 0);
    EXPECT_EQ(json_of("m.json").at("control"), json_of("w.json").at("control"));
}

}  // namespace
}  // namespace quasimc::test
