// What the catalogue of outputs promises, for every row.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "runfile/output_catalogue.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::vector<std::string> output_names() {
    std::vector<std::string> names;
    for (const OutputKey& key : output_keys()) {
        names.emplace_back(key.name);
    }
    return names;
}

/// A run file that has what any output needs.
std::string with_output(const std::string& output) {
    RunText text;
    text.top += "[output]\n" + output;
    text.sources += "[site]\nlatitude_deg = 50\nlongitude_deg = 8\n";
    text.rest =
        "[time]\nday = '2024-06-21'\nutc_offset_hours = 2\n[[detector]]\ntype = "
        "'escaped_by_zenith'\n[[sensors]]\nat = [[0, 0, 2]]\n[[gap_fraction]]\nat = [[0, 0]]\n";
    return text.text();
}

class EveryOutput : public ::testing::TestWithParam<std::string> {
  protected:
    [[nodiscard]] OutputKey key() const {
        const std::vector<OutputKey> keys = output_keys();
        return *std::find_if(
            keys.begin(), keys.end(), [](const OutputKey& one) { return one.name == GetParam(); });
    }
};

INSTANTIATE_TEST_SUITE_P(
    Catalogue, EveryOutput, ::testing::ValuesIn(output_names()), [](const auto& row) {
        return row.param;
    });

TEST_P(EveryOutput, IsAKeyOfTheRunFile) {
    const RunFile run = read_text(with_output(GetParam() + " = 'out/file'\n"));
    ASSERT_EQ(run.output.files.size(), 1U);
    EXPECT_EQ(run.output.files.at(GetParam()), "/run/out/file");
}

TEST_P(EveryOutput, IsNamedInTheDefaultRunFile) {
    const std::string file = default_run_file();
    const std::string after = file.substr(file.find("\n[output]"));
    EXPECT_LT(after.find(GetParam()), after.find("[[source]]"));
}

TEST_P(EveryOutput, NeedsWhatItsRowSays) {
    const std::string bare = "[output]\n" + GetParam() + " = 'file'\n";
    RunText text;
    text.top += bare;
    const std::vector<std::string> faults = faults_of(text.text());
    std::size_t count = 0;
    for (const OutputNeed& need : key().needs) {
        const bool is_known =
            mentions(faults, fmt::format("{} without {}", GetParam(), need.shown));
        EXPECT_TRUE(need.table.empty() || is_known) << need.shown;
        count += need.table.empty() ? 0 : 1;
    }
    EXPECT_EQ(faults.size(), count);
}

TEST_P(EveryOutput, HasAFileOfItsOwn) {
    const std::string other = GetParam() == "csv" ? "json" : "csv";
    EXPECT_TRUE(mentions(
        faults_of(with_output(GetParam() + " = 'file'\n" + other + " = './file'\n")),
        "name the same file"));
}

TEST(OutputCatalogue, HasNamesThatAreFlagsAndEndsWithTheWholeResult) {
    const std::vector<std::string> names = output_names();
    EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
    for (const std::string& name : names) {
        EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_"), std::string::npos) << name;
    }
    EXPECT_EQ(names.back(), "json");
}

TEST(OutputCatalogue, SuggestsTheKeyThatIsMeant) {
    EXPECT_TRUE(mentions(
        faults_of(with_output("detector = 'file'\n")),
        "unknown key 'detector'; did you mean 'detectors'?"));
}

}  // namespace
}  // namespace quasimc::test
