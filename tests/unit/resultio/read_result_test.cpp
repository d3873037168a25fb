#include "resultio/read_result.h"

#include <gtest/gtest.h>

#include "options/options.h"
#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "quasimc/run.h"
#include "quasimc/run_file.h"
#include "support/temporary_folder.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;

/// A run of two leaves from a file, done.
class StoredRunTest : public FolderTest {
  protected:
    void SetUp() override {
        RunText text;
        text.run = "[run]\npaths = 256\nreplicates = 3\nseed = 11\nlayer_heights = [0, 0.5, 2]\n";
        text.organs = "[[geometry]]\nfile = 'leaves.tri'\nmaterial = 'leaf'\n";
        text.rest =
            "[output]\ncsv = 'a.csv'\nquantities = ['incident_upper']\n"
            "[[table]]\nfile = 't.csv'\n";
        folder_.write("here/run.toml", text.text());
        folder_.write("here/leaves.tri", "0 0 0 1 0 0 0 1 0\n0.2 0 1 1 0 1.3 0 1 1\n");
        const RunFile run = read_run_file((folder_.path() / "here/run.toml").string());
        std::string json;
        digest_ = write_json(
            run, quasimc::run(run.scene, run.sources, run.spec),
            [&](std::string_view piece) { json += piece; });
        result_ = folder_.write("here/a.json", json);
    }

    [[nodiscard]] std::string faults(const fs::path& path) const {
        try {
            static_cast<void>(read_result_sweep(path.string()));
        } catch (const InputError& error) {
            return error.what();
        }
        return "";
    }

    fs::path result_;
    std::string digest_;
};

TEST_F(StoredRunTest, GivesTheSameNumbersAgain) {
    StoredSweep stored = read_result_sweep(result_.string());
    EXPECT_EQ(stored.organs_sha256, digest_);
    const RunFile run = std::move(stored.runs).only_run();
    EXPECT_EQ(digest_of_organs(run, quasimc::run(run.scene, run.sources, run.spec)), digest_);
}

TEST_F(StoredRunTest, KeepsOptionsAndTablesAndForgetsOtherOutputs) {
    const RunFile run = read_result_sweep(result_.string()).runs.take(0);
    EXPECT_EQ(run.spec.paths, 256U);
    EXPECT_EQ(run.spec.seed, 11U);
    EXPECT_EQ(run.spec.layer_heights, (std::vector<double>{0, .5, 2}));
    EXPECT_TRUE(run.output.files.empty());
    ASSERT_EQ(run.output.tables.size(), 1U);
    EXPECT_EQ(run.output.tables[0].file, (folder_.path() / "here/t.csv").string())
        << "beside the result";
    EXPECT_EQ(run.output.quantities, std::vector<std::string>{"incident_upper"});
    EXPECT_EQ(run.inputs.size(), 2U);
}

TEST_F(StoredRunTest, OptionsFromOutsideGoBeforeIt) {
    EXPECT_EQ(
        read_result_sweep(result_.string(), {{"seed", "12", "--seed"}}).runs.take(0).spec.seed,
        12U);
}

TEST_F(StoredRunTest, FindsItsInputsBesideItOrWhereTheyWere) {
    fs::create_directory(folder_.path() / "there");
    fs::rename(result_, folder_.path() / "there/a.json");
    EXPECT_EQ(faults(folder_.path() / "there/a.json"), "");
    fs::rename(folder_.path() / "here", folder_.path() / "gone");
    EXPECT_NE(faults(folder_.path() / "there/a.json").find("can't be read"), std::string::npos);
    fs::copy(folder_.path() / "gone/leaves.tri", folder_.path() / "there/leaves.tri");
    EXPECT_EQ(faults(folder_.path() / "there/a.json"), "");
}

TEST_F(StoredRunTest, RefusesAnInputThatHasChanged) {
    folder_.write("here/leaves.tri", "0 0 0 1 0 0 0 1 0\n");
    const std::string text = faults(result_);
    EXPECT_NE(text.find("leaves.tri"), std::string::npos) << text;
    EXPECT_NE(text.find("changed"), std::string::npos) << text;
}

TEST_F(StoredRunTest, RefusesWhatIsNoResult) {
    const auto faults_of_text = [&](const std::string& text) {
        return faults(folder_.write("b.json", text));
    };
    EXPECT_NE(faults_of_text("").find("not JSON"), std::string::npos);
    EXPECT_NE(faults_of_text("{ \"format\": ").find("not JSON"), std::string::npos);
    EXPECT_NE(faults_of_text("[]").find("is not a result of QuasiMC"), std::string::npos);
    EXPECT_NE(faults_of_text("{}").find("is not a result of QuasiMC"), std::string::npos);
    EXPECT_NE(
        faults_of_text(R"({"format": "quasimc-result", "format_version": 3})")
            .find("format_version"),
        std::string::npos);
    EXPECT_NE(
        faults_of_text(R"({"format": "quasimc-result", "format_version": 2})")
            .find("contains no run file"),
        std::string::npos);
    EXPECT_NE(
        faults_of_text(
            R"({"format": "quasimc-result", "format_version": 2, "run_file": {"a": null}})")
            .find("unknown key 'a'"),
        std::string::npos);
    EXPECT_NE(faults_of_text(R"({"format": 1e999})").find("too large"), std::string::npos);
    const std::string json = folder_.read("here/a.json");
    EXPECT_NE(faults_of_text(json.substr(0, json.size() / 2)).find("not JSON"), std::string::npos);
}

TEST_F(StoredRunTest, RefusesDeepNesting) {
    std::string text = R"({"format": "quasimc-result", "format_version": 2, "run_file": {"a": )";
    text += std::string(100000, '[') + std::string(100000, ']') + "}}";
    EXPECT_NE(
        faults(folder_.write("b.json", text)).find("is nested too deeply"), std::string::npos);
}

}  // namespace
}  // namespace quasimc::test
