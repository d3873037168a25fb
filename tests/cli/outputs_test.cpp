// What the program does to files: it destroys nothing that it reads, mixes nothing, and leaves old
// files or new ones, whatever happens.

#include <cmath>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

class OutputsTest : public ProgramTest {
  protected:
    /// The good run file without [output].
    void SetUp() override {
        ProgramTest::SetUp();
        folder_.write(
            "bare.toml",
            replaced(good_run_file(), "[output]\ncsv = \"out.csv\"\njson = \"out.json\"\n", ""));
    }
    void make_links() const {
        fs::create_symlink("bare.toml", folder_.path() / "soft.csv");
        fs::create_hard_link(folder_.path() / "bare.toml", folder_.path() / "hard.csv");
        fs::create_symlink(".", folder_.path() / "here");
    }
    void write_old() {
        folder_.write("out.csv", "old");
        folder_.write("out.json", "old");
    }
    [[nodiscard]] bool has_new_csv() const {
        return folder_.read("out.csv").find("\n1,third,") != std::string::npos;
    }
    [[nodiscard]] bool has_new_json() const {
        const std::string json = folder_.read("out.json");
        return json.find("\"organs_sha256\"") != std::string::npos && json.ends_with("}\n");
    }
    [[nodiscard]] Words hidden_files() const {
        Words hidden;
        for (const std::string& name : new_files()) {
            if (name.starts_with(".")) {
                hidden.push_back(name);
            }
        }
        return hidden;
    }
};

TEST_F(OutputsTest, AreNeverInputs) {
    make_links();
    const std::string leaves = folder_.read("leaves.tri");
    const std::string text = folder_.read("bare.toml");
    const std::vector<Words> table{
        {"--csv", "bare.toml"},      {"--json", "./bare.toml"},
        {"--csv", "soft.csv"},       {"--json", "hard.csv"},
        {"--csv", "here/bare.toml"}, {"--csv", (folder_.path() / "bare.toml").string()},
        {"--csv", "leaves.tri"},     {"--csv", "out.csv", "--json", "leaves.tri"}};
    for (const Words& row : table) {
        Words arguments{"run", "bare.toml"};
        arguments.insert(arguments.end(), row.begin(), row.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 1) << ::testing::PrintToString(row);
        EXPECT_NE(outcome.err.find("is an input of the run ("), std::string::npos) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with(row[row.size() - 2] + ": ")) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_EQ(folder_.read("bare.toml"), text);
    EXPECT_EQ(folder_.read("leaves.tri"), leaves);
    EXPECT_FALSE(fs::exists(folder_.path() / "out.csv"));
}

TEST_F(OutputsTest, OfRunFilesAreNeverInputs) {
    for (const std::string name : {"run.toml", "leaves.tri", "./none/../leaves.tri"}) {
        folder_.write(
            "run.toml", replaced(good_run_file(), "csv = \"out.csv\"", "csv = \"" + name + "\""));
        for (const char* command : {"run", "check"}) {
            const Outcome outcome = run({command, "run.toml"});
            EXPECT_EQ(outcome.status, 1);
            EXPECT_NE(outcome.err.find("run.toml:7: [output]: csv = '"), std::string::npos)
                << outcome.err;
            EXPECT_NE(outcome.err.find("is an input of the run"), std::string::npos);
        }
    }
    EXPECT_EQ(folder_.read("leaves.tri"), good_leaves());
}

TEST_F(OutputsTest, OfExportAreNeverInputs) {
    for (const char* output : {"leaves.tri", "./leaves.tri"}) {
        const Outcome outcome = run({"export", "run.toml", output});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("is an input of the run"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run({"export", "run.toml", "run.toml", "--format", "obj"}).status, 1);
    EXPECT_EQ(folder_.read("leaves.tri"), good_leaves());
    EXPECT_EQ(folder_.read("run.toml"), good_run_file());
}

TEST_F(OutputsTest, AreNotTheResultThatIsRepeated) {
    ASSERT_EQ(run({"run", "bare.toml", "--json", "old.json"}).status, 0);
    const std::string old = folder_.read("old.json");
    for (const char* flag : {"--csv", "--json"}) {
        const Outcome outcome = run({"run", "--from", "old.json", flag, "./old.json"});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("is an input of the run"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(folder_.read("old.json"), old);
    EXPECT_EQ(run({"run", "--from", "old.json", "--json", "new.json"}).status, 0);
}

TEST_F(OutputsTest, AreNotEachOther) {
    fs::create_symlink("new.csv", folder_.path() / "soft.csv");
    fs::create_symlink(".", folder_.path() / "here");
    const std::vector<Words> table{
        {"new.csv", "./new.csv"},
        {"new.csv", "soft.csv"},
        {"here/new.csv", "new.csv"},
        {"-", "/dev/stdout"}};
    for (const Words& row : table) {
        const Outcome outcome = run({"run", "bare.toml", "--csv", row[0], "--json", row[1]});
        EXPECT_EQ(outcome.status, 1) << ::testing::PrintToString(row);
        EXPECT_NE(outcome.err.find("--json: '"), std::string::npos) << outcome.err;
        EXPECT_NE(
            outcome.err.find("is the file of another output (--csv names it)"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(outcome.out, "");
    }
    EXPECT_FALSE(fs::exists(folder_.path() / "new.csv"));
    EXPECT_EQ(
        run({"run", "bare.toml", "--csv", "/dev/null", "--json", "/dev/../dev/null"}).status, 0);
}

TEST_F(OutputsTest, FollowLinksToWhatIsNotThereYet) {
    fs::create_symlink("new.csv", folder_.path() / "soft.csv");
    EXPECT_EQ(run({"run", "bare.toml", "--csv", "soft.csv"}).status, 0);
    EXPECT_TRUE(fs::is_symlink(folder_.path() / "soft.csv"));
    EXPECT_NE(folder_.read("new.csv").find("third"), std::string::npos);
}

TEST_F(OutputsTest, ByTheNameOfStandardOutputLeaveItToThem) {
    const Outcome outcome = run({"run", "bare.toml", "--csv", "/dev/stdout"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_TRUE(outcome.out.starts_with("# QuasiMC"));
    EXPECT_EQ(outcome.out.find("energy    "), std::string::npos);
    EXPECT_NE(outcome.err.find("energy    "), std::string::npos);
}

TEST_F(OutputsTest, AreNotMixedWithClosedStreams) {
    for (const char* closed : {"<&-", ">&-", "2>&-", "<&- >&-", ">&- 2>&-", "<&- >&- 2>&-"}) {
        write_old();
        const Outcome outcome = shell("\"$quasimc\" run run.toml " + std::string(closed));
        EXPECT_EQ(outcome.status, 0) << closed << outcome.err;
        EXPECT_TRUE(folder_.read("out.csv").starts_with("# QuasiMC")) << closed;
        EXPECT_EQ(folder_.read("out.csv").find("energy    "), std::string::npos) << closed;
        EXPECT_TRUE(folder_.read("out.json").starts_with("{")) << closed;
        EXPECT_TRUE(has_new_json()) << closed;
        EXPECT_EQ(folder_.read("leaves.tri"), good_leaves());
    }
    const Outcome refused = shell("\"$quasimc\" run bare.toml --csv - >&-");
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(refused.err, "standard output: can't be written (it is closed)\n");
    EXPECT_EQ(shell("\"$quasimc\" run - <&-").status, 1);
}

TEST_F(OutputsTest, ThatFailDoNotCostTheOthers) {
    write_old();
    const Outcome full = run({"run", "run.toml", "--csv", "/dev/full"});
    EXPECT_EQ(full.status, 1);
    EXPECT_NE(full.err.find("/dev/full: can't be written (No space left"), std::string::npos)
        << full.err;
    EXPECT_TRUE(has_new_json());
    EXPECT_EQ(full.out.find("/dev/full"), std::string::npos) << full.out;
    const Outcome gone = shell(
        "\"$quasimc\" run run.toml --json - 2>err | true; cat err; "
        "exit ${PIPESTATUS[0]}");
    EXPECT_NE(gone.out.find("standard output: can't be written (Broken pipe)"), std::string::npos)
        << gone.out;
    EXPECT_TRUE(has_new_csv());
}

// A limit on the size of files stands for a disk that is full: the table fits, the result does not.
TEST_F(OutputsTest, OnAFullDiskStayAsTheyWere) {
    write_old();
    const Outcome outcome = shell("ulimit -f 5; \"$quasimc\" run run.toml -q");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("out.json: can't be written (File too large)"), std::string::npos)
        << outcome.err;
    EXPECT_TRUE(has_new_csv());
    EXPECT_EQ(folder_.read("out.json"), "old");
    write_old();
    const Outcome none = shell("ulimit -f 0; \"$quasimc\" run run.toml -q 2>/dev/full");
    EXPECT_EQ(none.status, 1);
    EXPECT_EQ(folder_.read("out.csv"), "old");
    EXPECT_EQ(folder_.read("out.json"), "old");
    EXPECT_EQ(hidden_files(), Words{});
}

// A bad output is told before anything is computed, and the good one is left alone.
TEST_F(OutputsTest, ThatCanNotBeOpenedAreToldAtOnce) {
    write_old();
    const Outcome outcome = run({"run", "run.toml", "--csv", "none/a.csv", "--json", "out.json"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("none/a.csv: can't be written"), std::string::npos);
    EXPECT_EQ(folder_.read("out.json"), "old");
}

// Between the two renames the table is new and the result is old: the only mixture that may be.
// Killed at a moment that is spread over the run, it is hit about once in ten thousand.
class KilledOutputs : public OutputsTest, public ::testing::WithParamInterface<int> {};

TEST_P(KilledOutputs, AreOldOrNew) {
    const int sweeps = GetParam();
    constexpr int kKills = 20;  // of a sweep, from its start to behind its end
    const Outcome outcome = shell(
        "start=$(date +%s%N); \"$quasimc\" run run.toml -q --paths 65536; end=$(date +%s%N); "
        "echo $((end - start))");
    double whole_s = std::stod(outcome.out) * 1e-9;
    int old = 0;
    int fresh = 0;
    constexpr int kMost = 8;  // on a machine that becomes busier and busier
    for (int sweep = 0; sweep < sweeps || (fresh == 0 && sweep < kMost); ++sweep) {
        const int fresh_before = fresh;
        for (int i = 0; i < kKills; ++i) {
            write_old();
            const double moment_s =
                1.3 * whole_s * (i + std::fmod((sweep + 0.5) / sweeps, 1)) / kKills;
            static_cast<void>(shell(
                "\"$quasimc\" run run.toml -q --paths 65536 & sleep " + std::to_string(moment_s) +
                "; kill -9 $! 2>/dev/null; wait $!"));
            const bool old_csv = folder_.read("out.csv") == "old";
            const bool old_json = folder_.read("out.json") == "old";
            EXPECT_TRUE(old_csv || has_new_csv()) << moment_s;
            EXPECT_TRUE(old_json || has_new_json()) << moment_s;
            EXPECT_TRUE(old_json || !old_csv) << "the result gets its name last";
            (old_csv && old_json ? old : fresh) += 1;
            if (old_csv != old_json) {  // the next run that has one of them finishes both
                EXPECT_EQ(run({"run", "bare.toml", "-q", "--csv", "out.csv"}).status, 0);
                EXPECT_TRUE(has_new_csv() && has_new_json()) << moment_s;
            }
        }
        if (fresh == fresh_before) {
            whole_s *= 2;  // the machine has become busier
        }
    }
    EXPECT_GT(old, 0);
    EXPECT_GT(fresh, 0);
}

INSTANTIATE_TEST_SUITE_P(Ordinary, KilledOutputs, ::testing::Values(2));
INSTANTIATE_TEST_SUITE_P(Long, KilledOutputs, ::testing::Values(10));

/// Moments spread over a run, from its start to behind its end.
class OutputsAtMoments : public OutputsTest, public ::testing::WithParamInterface<int> {
  protected:
    static constexpr const char* kRun = "\"$quasimc\" run run.toml -q --paths 65536";

    /// How long a run takes, seconds.
    [[nodiscard]] double duration() {
        const Outcome outcome = shell(
            std::string("start=$(date +%s%N); ") + kRun +
            "; end=$(date +%s%N); echo $((end - start))");
        return std::stod(outcome.out) * 1e-9;
    }
    [[nodiscard]] static double moment(int i) { return 1.3 * (i + 0.5) / GetParam(); }

    /// Each output is old or new, and nothing is left beside them.
    void expect_old_or_new(const std::string& words) {
        EXPECT_TRUE(folder_.read("out.csv") == "old" || has_new_csv()) << words;
        EXPECT_TRUE(folder_.read("out.json") == "old" || has_new_json()) << words;
        EXPECT_EQ(hidden_files(), Words{}) << words;
    }
};

/// As many bytes as fit on a disk that is nearly full: none, half of one output, all of one.
TEST_P(OutputsAtMoments, AreOldOrNewWhereverTheDiskIsFull) {
    ASSERT_EQ(run({"run", "run.toml", "-q"}).status, 0);
    const auto size = static_cast<double>(folder_.read("out.json").size());
    int whole = 0, told = 0;
    for (int i = 0; i < GetParam(); ++i) {
        write_old();
        const auto bytes = static_cast<long>(moment(i) * size);
        const Outcome outcome =
            shell("prlimit --fsize=" + std::to_string(bytes) + " \"$quasimc\" run run.toml -q");
        const std::string words = std::to_string(bytes) + " bytes: " + outcome.err;
        expect_old_or_new(words);
        EXPECT_EQ(outcome.status == 0, has_new_csv() && has_new_json()) << words;
        EXPECT_EQ(outcome.status == 0, outcome.err.empty()) << words;
        (outcome.status == 0 ? whole : told) += 1;
    }
    EXPECT_GT(whole, 0);
    EXPECT_GT(told, 0);
}

/// The disk is full from a moment on.
TEST_P(OutputsAtMoments, AreOldOrNewWheneverTheDiskBecomesFull) {
    const double whole_s = duration();
    for (int i = 0; i < GetParam(); ++i) {
        write_old();
        const double moment_s = whole_s * moment(i);
        const Outcome outcome = shell(
            std::string(kRun) + " & sleep " + std::to_string(moment_s) +
            "; prlimit --pid $! --fsize=0 2>/dev/null; wait $!");
        const std::string words = std::to_string(moment_s) + " s: " + outcome.err;
        expect_old_or_new(words);
        EXPECT_EQ(outcome.status == 0, has_new_csv() && has_new_json()) << words;
    }
}

/// Who reads what the program prints goes away; its files are written all the same.
TEST_P(OutputsAtMoments, AreWrittenWhoeverStopsReading) {
    const double whole_s = duration();
    for (int i = 0; i < GetParam(); ++i) {
        write_old();
        const double moment_s = whole_s * moment(i);
        const Outcome outcome = shell(
            "\"$quasimc\" run run.toml --paths 65536 2>&1 | sleep " + std::to_string(moment_s) +
            "; exit ${PIPESTATUS[0]}");
        expect_old_or_new(std::to_string(moment_s) + " s");
        EXPECT_TRUE(has_new_csv() && has_new_json()) << moment_s << " s";
        EXPECT_LE(outcome.status, 1) << moment_s << " s";
    }
}

INSTANTIATE_TEST_SUITE_P(Ordinary, OutputsAtMoments, ::testing::Values(12));
INSTANTIATE_TEST_SUITE_P(Long, OutputsAtMoments, ::testing::Values(100));

/// The library of NetCDF is loaded when a file is asked for. A file that is none lies before it here.
TEST_F(OutputsTest, AsNetcdfNeedItsLibraryBeforeAnythingIsComputed) {
    if (run({"formats"}).out.find("not built in") != std::string::npos) {
        GTEST_SKIP() << "built without NetCDF";
    }
    const Outcome good = run({"run", "run.toml", "-q", "--nc", "out.nc"});
    ASSERT_EQ(good.status, 0) << good.err;
    EXPECT_TRUE(folder_.read("out.nc").starts_with("\x89HDF"));
    write_old();
    folder_.write("out.nc", "old");
    constexpr int kVersions = 40;
    fs::create_directory(folder_.path() / "broken");
    for (int version = 1; version < kVersions; ++version) {
        folder_.write("broken/libnetcdf.so." + std::to_string(version), "");
    }
    const std::string broken = "LD_LIBRARY_PATH=broken \"$quasimc\" run run.toml -q";
    const Outcome refused = shell(broken + " --nc out.nc");
    EXPECT_EQ(refused.status, 1);
    EXPECT_NE(refused.err.find("NetCDF: can't be written ("), std::string::npos) << refused.err;
    EXPECT_NE(refused.err.find("install the netCDF library"), std::string::npos) << refused.err;
    EXPECT_EQ(folder_.read("out.csv") + folder_.read("out.nc"), "oldold");
    EXPECT_EQ(shell(broken).status, 0) << "who does not ask for it does not need it";
    EXPECT_TRUE(has_new_csv());
}

TEST_F(OutputsTest, PipesAreReadAndWritten) {
    const Outcome substituted = shell("\"$quasimc\" run <(cat run.toml)");
    EXPECT_EQ(substituted.status, 0) << substituted.err;
    EXPECT_TRUE(has_new_csv());
    EXPECT_EQ(run({"run", "/dev/stdin"}, good_run_file()).status, 0);
    EXPECT_EQ(shell("cat run.toml | \"$quasimc\" run /dev/stdin").status, 0);
    EXPECT_EQ(shell("cat run.toml | \"$quasimc\" run -").status, 0);
    const Outcome late =
        shell("mkfifo late; (sleep 0.3; cat run.toml >late) & \"$quasimc\" run late; wait");
    EXPECT_EQ(late.status, 0) << late.err;
    const Outcome slow = shell("\"$quasimc\" run <(sleep 0.3; cat run.toml)");
    EXPECT_EQ(slow.status, 0) << slow.err;
    const Outcome written = shell("\"$quasimc\" run bare.toml --csv >(cat >piped.csv); sleep 0.2");
    EXPECT_EQ(written.status, 0) << written.err;
    EXPECT_NE(folder_.read("piped.csv").find("third"), std::string::npos);
}

TEST_F(OutputsTest, APipeThatNobodyServesIsRefused) {
    const Outcome outcome = shell(
        "mkfifo a.tri b.csv; sed s/leaves.tri/a.tri/ run.toml >a.toml\n"
        "timeout 60 \"$quasimc\" check a.toml & "
        "timeout 60 \"$quasimc\" run bare.toml --csv b.csv; b=$?; wait $!; echo $? $b");
    EXPECT_EQ(outcome.out, "1 1\n") << outcome.err;
    EXPECT_NE(outcome.err.find("nothing writes into this pipe"), std::string::npos) << outcome.err;
    EXPECT_NE(outcome.err.find("nothing reads this pipe"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace quasimc::test
