// Runs that end before all is done: by a limit of time, or by Ctrl-C.

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/wait.h>

#include "program.h"
#include "support/sanitized.h"

namespace quasimc::test {
namespace {

constexpr const char* kHuge = "1073741824";
constexpr const char* kStopped = "\nstopped   interrupted: ";

bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// A closed box that absorbs nothing, with a lamp in it: no path ever ends.
std::string white_box() {
    std::string file =
        "format = 1\nbands = [\"PAR\"]\n[output]\ncsv = \"box.csv\"\n[[source]]\ntype = \"point\"\n"
        "position = [0.5, 0.5, 0.5]\npower = [1]\n"
        "[[material]]\nname = \"white\"\nreflectance = 1\ntransmittance = 0\n";
    for (const char* corners :
         {"[0,0,0],[1,0,0],[1,1,0],[0,1,0]", "[0,0,1],[1,0,1],[1,1,1],[0,1,1]",
          "[0,0,0],[1,0,0],[1,0,1],[0,0,1]", "[0,1,0],[1,1,0],[1,1,1],[0,1,1]",
          "[0,0,0],[0,1,0],[0,1,1],[0,0,1]", "[1,0,0],[1,1,0],[1,1,1],[1,0,1]"}) {
        file +=
            "[[organ]]\nname = \"wall\"\nmaterial = \"white\"\nshape = \"polygon\"\ncorners = [" +
            std::string(corners) + "]\n";
    }
    return file;
}

class LimitsTest : public ProgramTest {
  protected:
    /// Runs the program and sends it a SIGINT after two seconds, or twice as long until it prints
    /// or reports some words: a busy machine may need long for little. @returns its exit status
    [[nodiscard]] int interrupted(const std::string& arguments, const std::string& words) const {
        for (int seconds = 2;; seconds *= 2) {
            const std::string command = "cd '" + folder_.path().string() +
                                        "' && timeout --foreground --preserve-status -s INT " +
                                        std::to_string(seconds) + " '" + QUASIMC_PROGRAM + "' " +
                                        arguments + " >out 2>err";
            const int status = std::system(command.c_str());  // NOLINT(concurrency-mt-unsafe)
            if (contains(folder_.read("out") + folder_.read("err"), words) ||
                seconds > kLongestLimit) {
                return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
            }
        }
    }
};

TEST_F(LimitsTest, AHugeRunEndsInTimeWithItsFiles) {
    const Outcome outcome =
        run_within(0.5, {"run", "run.toml", "--paths", kHuge}, "\nstopped   max_seconds = ");
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, " of 1073741824 paths completed")) << outcome.out;
    EXPECT_TRUE(contains(folder_.read("out.csv"), "\n# stopped: max_seconds = "));
    EXPECT_TRUE(contains(folder_.read("out.json"), "\"stop\": \"time_limit\""));
}

TEST_F(LimitsTest, ALongLimitIsNotFelt) {
    const Outcome outcome = run({"run", "run.toml", "--max-seconds", "1000", "--csv", "a.csv"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_FALSE(contains(outcome.out, "stopped"));
    ASSERT_EQ(run({"run", "run.toml", "--csv", "b.csv"}).status, 0);
    const std::string limited = folder_.read("a.csv");
    const std::string free = folder_.read("b.csv");
    EXPECT_EQ(limited.substr(limited.find("\nid,")), free.substr(free.find("\nid,")));
}

TEST_F(LimitsTest, AClosedWhiteBoxIsLeftWithoutAFile) {
    folder_.write("box.toml", white_box());
    const Outcome outcome = run({"run", "box.toml", "--max-seconds", "0.1"});
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "set max_depth")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "Nothing was written")) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "box.csv"));
}

/// Paths end outside of the box, but never within, where the sensors are.
TEST_F(LimitsTest, SensorsThatTheTimeDidNotReachAreAbsent) {
    std::string file = white_box();
    file.replace(file.find("position = [0.5, 0.5, 0.5]"), 26, "position = [0.5, 0.5, 2.5]");
    folder_.write(
        "box.toml",
        file +
            "[[sensors]]\nname = \"bench\"\nat = { start = [0.2, 0.2, 0.5], along = [0.5, 0, 0], "
            "across = [0, 0.5, 0], counts = [2, 2] }\n");
    const Outcome outcome = run_within(
        0.5,
        {"run", "box.toml", "--paths", "256", "--replicates", "2", "--sensors-csv", "sensors.csv",
         "--sensors-picture", "sensors.png", "--json", "box.json"},
        "stopped");
    EXPECT_EQ(outcome.status, 2) << outcome.err;
    const std::string reason = "not computed, as the run was stopped before them (max_seconds = ";
    EXPECT_TRUE(contains(outcome.err, "warning: sensors: " + reason)) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "\nsensors   " + reason)) << outcome.out;
    EXPECT_TRUE(contains(outcome.err, "there is no light on sensors to draw")) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "sensors.png"));
    const std::string table = folder_.read("sensors.csv");
    EXPECT_TRUE(contains(table, "\n# sensors: " + reason)) << table;
    EXPECT_FALSE(contains(table, "\n1,bench")) << table;
    EXPECT_TRUE(contains(folder_.read("box.csv"), "\n6,wall"));
    EXPECT_EQ(run({"convert", "box.json", "again.vtp"}).status, 0);
}

TEST_F(LimitsTest, ASeriesSharesItsTime) {
    folder_.write(
        "days.toml",
        good_run_file() +
            "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
            "[time]\nfrom = \"2024-06-20\"\nto = \"2024-06-21\"\nutc_offset_hours = 1\n"
            "hours = [11, 13]\nsky = \"uniform\"\nsun_step_minutes = 20\n");
    const Outcome outcome = run_within(
        3, {"run", "days.toml", "--paths", kHuge, "--daily-csv", "d.csv", "--progress"},
        ": 4 of 4 time steps completed; 4 of 4 computed with fewer paths");
    EXPECT_EQ(outcome.status, 4) << outcome.err;
    EXPECT_TRUE(contains(outcome.out, "\nstopped   max_seconds = ")) << outcome.out;
    EXPECT_TRUE(contains(outcome.err, " s of about ")) << "progress in a log: " << outcome.err;
    const std::string json = folder_.read("out.json");
    EXPECT_TRUE(contains(json, "\"time_steps_requested\": 4")) << json.substr(json.size() - 400);
    EXPECT_TRUE(contains(json, "\"with_fewer_paths\": 4"));
    EXPECT_TRUE(contains(folder_.read("d.csv"), "\n2024-06-21,7200,"));
}

TEST_F(LimitsTest, CtrlCWritesTheRoundsThatAreComplete) {
    EXPECT_EQ(interrupted("run run.toml --target-error 1e-9", kStopped), 130)
        << folder_.read("err");
    EXPECT_TRUE(contains(folder_.read("err"), "stopping")) << folder_.read("err");
    EXPECT_TRUE(contains(folder_.read("out"), kStopped)) << folder_.read("out");
    EXPECT_TRUE(contains(folder_.read("out.json"), "\"stop\": \"interrupted\""));
    EXPECT_TRUE(contains(folder_.read("out.csv"), "\n1,third,")) << folder_.read("out.csv");
}

TEST_F(LimitsTest, CtrlCInAHugeFirstRoundWritesWhatWasTracedBefore) {
    EXPECT_EQ(interrupted("run run.toml --paths 1073741824", kStopped), 130) << folder_.read("err");
    EXPECT_TRUE(contains(folder_.read("out"), " of 1073741824 paths completed"))
        << folder_.read("out");
    EXPECT_TRUE(contains(folder_.read("out.json"), "\"stop\": \"interrupted\""));
    EXPECT_TRUE(contains(folder_.read("out.csv"), "\n1,third,")) << folder_.read("out.csv");
}

TEST_F(LimitsTest, CtrlCBeforeAnyPathEndsWritesNothing) {
    folder_.write("box.toml", white_box());
    folder_.write("box.csv", "of an earlier run\n");
    EXPECT_EQ(interrupted("run box.toml --paths 1024", "Nothing was written"), 130)
        << folder_.read("err");
    EXPECT_TRUE(contains(folder_.read("err"), "Nothing was written")) << folder_.read("err");
    EXPECT_EQ(folder_.read("box.csv"), "of an earlier run\n");
}

/// From no memory for a thread to enough: what is missing is said, and is no fault of the program.
TEST_F(LimitsTest, TooLittleMemoryForThreadsIsNoFaultOfTheProgram) {
    if (kIsSanitized) {
        GTEST_SKIP() << "sanitizers need more address space than the limit leaves";
    }
    int refused = 0;
    for (int kilobytes = 40'000; kilobytes < 600'000; kilobytes += 20'000) {
        const Outcome outcome = shell(
            "ulimit -v " + std::to_string(kilobytes) +
            "; \"$quasimc\" run run.toml -q --threads 16");
        if (outcome.status == 127 || outcome.status == 0) {
            continue;  // the program's libraries don't fit, or all does
        }
        ++refused;
        EXPECT_EQ(outcome.status, 1) << kilobytes << outcome.err;
        EXPECT_NE(outcome.err.find("not enough memory"), std::string::npos) << outcome.err;
        EXPECT_EQ(outcome.err.find("about 0 MB"), std::string::npos) << outcome.err;
    }
    EXPECT_GT(refused, 0);
}

TEST_F(LimitsTest, QuietPrintsNothing) {
    const Outcome outcome = run({"run", "run.toml", "-q", "--progress"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_EQ(outcome.out + outcome.err, "");
}

}  // namespace
}  // namespace quasimc::test
