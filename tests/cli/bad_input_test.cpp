// The bad inputs: each ends with exit status 1, a message that names the location, nothing on
// standard output and no file written. Never a crash.

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bad_inputs.h"
#include "program.h"
#include "support/sanitized.h"

namespace quasimc::test {
namespace {

std::vector<BadInput> all_bad_inputs() {
    std::vector<BadInput> all = bad_documents();
    for (const std::vector<BadInput>& more : {bad_scenes(), bad_geometry_files()}) {
        all.insert(all.end(), more.begin(), more.end());
    }
    return all;
}

class BadInputTest : public ProgramTest, public ::testing::WithParamInterface<BadInput> {};

TEST_P(BadInputTest, EndsWithAMessageThatNamesTheLocation) {
    const BadInput& bad = GetParam();
    folder_.write(
        "run.toml",
        bad.find.empty() ? bad.replacement : replaced(good_run_file(), bad.find, bad.replacement));
    if (!bad.file.empty()) {
        folder_.write(bad.file, bad.bytes);
    }
    const Outcome outcome = run({"run", "run.toml"});
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_NE(outcome.err.find(bad.message), std::string::npos)
        << "expected: " << bad.message << "\nprinted: " << outcome.err;
    EXPECT_EQ(outcome.out, "");
    std::vector<std::string> files = new_files();
    std::erase(files, bad.file);
    EXPECT_TRUE(files.empty()) << ::testing::PrintToString(files);
}

INSTANTIATE_TEST_SUITE_P(
    Table,
    BadInputTest,
    ::testing::ValuesIn(all_bad_inputs()),
    [](const ::testing::TestParamInfo<BadInput>& input) { return input.param.name; });

TEST(BadInputs, AreAHundredOrMore) {
    EXPECT_GE(all_bad_inputs().size(), 100U);
}

// The negative control: what the table changes is good before.
TEST_F(ProgramTest, TheGoodInputIsGood) {
    const Outcome outcome = run({"run", "run.toml"});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_EQ(new_files(), (std::vector<std::string>{"out.csv", "out.json"}));
}

TEST_F(ProgramTest, AllFaultsOfAFileAreReportedAtOnce) {
    std::string text = replaced(good_run_file(), "reflectance = 0.1", "reflectance = 2");
    text = replaced(text, "direction = [0, 0, -1]", "direction = [0, 0]");
    text = replaced(text, "paths = 256", "pahts = 3");
    folder_.write("run.toml", text);
    folder_.write("leaves.tri", "0 0 1 1 0 1 0 1\n1 2 3\n");
    const std::string err = run({"run", "run.toml"}).err;
    for (const char* where :
         {"run.toml:4: ", "run.toml:11: ", "run.toml:15: ", "leaves.tri:1: ", "leaves.tri:2: "}) {
        EXPECT_NE(err.find(where), std::string::npos) << where << "\n" << err;
    }
}

TEST_F(ProgramTest, AFaultIsToldOnce) {
    folder_.write(
        "run.toml",
        replaced(
            good_run_file(), "file = \"leaves.tri\"", "file = \"leaves.tri\"\nat = [1, 2, 3]"));
    const std::string err = run({"run", "run.toml"}).err;
    EXPECT_EQ(std::count(err.begin(), err.end(), '\n'), 1) << err;
}

/// An option that is given in two ways is one error: neither key is an unknown one.
TEST_F(ProgramTest, TwoWaysToSayOneThingAreOneFault) {
    const std::string site = "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n[time]\n";
    const std::vector<std::array<std::string, 2>> table{
        {"direction = [0, 0, -1]", "direction = [0, 0, -1]\nazimuth_deg = 10\nelevation_deg = 20"},
        {"[run]", site + "day = \"2024-06-21\"\nfrom = \"2024-06-01\"\nto = \"2024-06-02\"\n"
                         "hours = [8, 9]\nutc_offset_hours = 1\n[run]"}};
    for (const auto& [find, replacement] : table) {
        folder_.write("run.toml", replaced(good_run_file(), find, replacement));
        const Outcome outcome = run({"run", "run.toml"});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_EQ(outcome.err.find("unknown key"), std::string::npos) << outcome.err;
    }
}

TEST_F(ProgramTest, AFileLargerThanTheMemoryIsAnInputError) {
    if (kIsSanitized) {
        GTEST_SKIP() << "sanitizers need more address space than the limit leaves";
    }
    const Outcome outcome =
        shell("truncate -s 60G leaves.tri; ulimit -v 8000000; \"$quasimc\" run run.toml");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(
        outcome.err.find("leaves.tri' can't be read (not enough memory for its 64424509440 bytes)"),
        std::string::npos)
        << outcome.err;
}

TEST_F(ProgramTest, AMissingRunFileIsAnInputError) {
    const Outcome outcome = run({"run", "none.toml"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err, "error: none.toml: can't be read (No such file or directory)\n");
}

}  // namespace
}  // namespace quasimc::test
