// Runs that are killed, and go on from their checkpoint.

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

/// A table without the lines on how it was made.
std::string table_rows(const std::string& table) {
    const std::size_t at = table.find("id,name");
    return at == std::string::npos ? "no table" : table.substr(at);
}

class CheckpointTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        folder_.write(
            "day.toml",
            replaced(good_run_file(), "[[material]]", "on_hours = [0, 24]\n[[material]]") +
                "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
                "[time]\nfrom = \"2024-06-20\"\nto = \"2024-06-20\"\n"
                "utc_offset_hours = 1\nhours = [9, 14]\nsky = \"uniform\"\n");
        folder_.write(
            "sweep.toml", good_run_file() + "[sweep]\nmax_depth = [1, 2]\nseed = [1, 2, 3]\n");
    }
    /// Sends a signal to a run as soon as a condition of bash holds; the run must need far longer.
    [[nodiscard]] Outcome stopped_once(
        const std::string& condition, const std::string& run, const std::string& signal) const {
        return shell(  // with job control: a shell without lets its background ignore SIGINT
            "set -m; " + run + " & pid=$!\nuntil " + condition +
            " || ! kill -0 $pid; do sleep 0.01; done; kill -" + signal + " $pid; wait $pid");
    }
    /// Kills a run again and again after some time, and lets it go on in other numbers of threads.
    /// @returns how often it was killed
    [[nodiscard]] int run_and_kill(const std::string& run, int kills) const {
        const Outcome outcome = shell(
            "RANDOM=1; killed=0\n"
            "for i in $(seq 1 " +
            std::to_string(kills) +
            "); do\n"
            "  \"$quasimc\" run " +
            run +
            " --checkpoint c --resume --checkpoint-interval 0 --quiet --threads "
            "$((1 + i % 3)) & pid=$!\n"
            "  sleep 0.$(printf %02d $((RANDOM % 12)))\n"
            "  kill -9 $pid 2>/dev/null; wait $pid\n"
            "  [ $? = 137 ] && killed=$((killed + 1))\n"
            "done 2>/dev/null; echo $killed");
        return std::stoi(outcome.out);
    }
    void expect_the_bits_of_the_whole(const std::string& run, int kills) const {
        ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
        EXPECT_GT(run_and_kill(run + " --csv out.csv", kills), 0);
        const Outcome last =
            shell("\"$quasimc\" run " + run + " --csv out.csv --checkpoint c --resume --quiet");
        EXPECT_EQ(last.status, 0) << last.err;
        EXPECT_EQ(table_rows(folder_.read("out.csv")), table_rows(folder_.read("whole.csv")));
    }
};

TEST_F(CheckpointTest, LosesNothingOfARunThatIsKilled) {
    expect_the_bits_of_the_whole("run.toml --method light_tracing --paths 524288", 6);
}

TEST_F(CheckpointTest, LosesNothingOfTimesThatAreKilled) {
    expect_the_bits_of_the_whole("day.toml --paths 65536", 6);
}

TEST_F(CheckpointTest, HasTheSensorsOfTheWhole) {
    folder_.write("sensors.toml", good_run_file() + "[[sensors]]\nat = [[0.5, 0.5, 2]]\n");
    const std::string run = "\"$quasimc\" run sensors.toml --quiet --paths 1024 --sensors-csv ";
    ASSERT_EQ(shell(run + "whole.csv").status, 0);
    ASSERT_EQ(shell(run + "first.csv --checkpoint c").status, 0);
    ASSERT_EQ(shell(run + "again.csv --checkpoint c --resume").status, 0);
    EXPECT_EQ(table_rows(folder_.read("first.csv")), table_rows(folder_.read("whole.csv")));
    EXPECT_EQ(table_rows(folder_.read("again.csv")), table_rows(folder_.read("whole.csv")));
}

TEST_F(CheckpointTest, LosesNothingOfASweepThatIsKilled) {
    expect_the_bits_of_the_whole("sweep.toml --method light_tracing --paths 131072", 6);
}

TEST_F(CheckpointTest, IsNoOtherFile) {
    const std::string text = folder_.read("run.toml");
    const Outcome outcome = run({"run", "run.toml", "--checkpoint", "run.toml"});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(
        outcome.err,
        "error: run.toml: is not a checkpoint (it must be a file written by `quasimc run "
        "--checkpoint`); name another file\n");
    EXPECT_EQ(folder_.read("run.toml"), text);
}

TEST_F(CheckpointTest, OfARunThatIsDoneGivesItAgainOrMoreExactly) {
    ASSERT_EQ(run({"run", "run.toml", "--checkpoint", "c", "--csv", "a.csv"}).status, 0);
    const Outcome again = run({"run", "run.toml", "--checkpoint", "c", "--csv", "a.csv"});
    EXPECT_EQ(again.status, 1);
    EXPECT_EQ(again.err, "error: c: exists; use --resume to continue it, or delete it\n");
    const Outcome there =
        run({"run", "run.toml", "--checkpoint", "c", "--resume", "--csv", "b.csv"});
    ASSERT_EQ(there.status, 0);
    EXPECT_NE(there.out.find("time      all paths are from the checkpoint"), std::string::npos)
        << there.out;
    EXPECT_EQ(table_rows(folder_.read("b.csv")), table_rows(folder_.read("a.csv")));
    const Outcome more = run(
        {"run", "run.toml", "--checkpoint", "c", "--resume", "--max-paths", "1024", "--csv",
         "b.csv"});
    ASSERT_EQ(more.status, 0);
    EXPECT_NE(more.out.find("; 25 % of the paths are from the checkpoint\n"), std::string::npos)
        << more.out;
    ASSERT_EQ(run({"run", "run.toml", "--max-paths", "1024", "--csv", "w.csv"}).status, 0);
    EXPECT_EQ(table_rows(folder_.read("b.csv")), table_rows(folder_.read("w.csv")));
    EXPECT_NE(table_rows(folder_.read("b.csv")), table_rows(folder_.read("a.csv")));
}

TEST_F(CheckpointTest, GoesOnToMorePathsOrSaysWhyNot) {
    const std::string command = "\"$quasimc\" run run.toml --method light_tracing --quiet ";
    ASSERT_EQ(shell(command + "--paths 16384 --checkpoint c").status, 0);
    const Outcome more = shell(command + "--paths 65536 --checkpoint c --resume --csv b.csv");
    EXPECT_EQ(more.status, 0) << more.err;
    ASSERT_EQ(shell(command + "--paths 65536 --csv w.csv").status, 0);
    EXPECT_EQ(table_rows(folder_.read("b.csv")), table_rows(folder_.read("w.csv")));
    const Outcome fewer = shell(command + "--paths 16384 --checkpoint c --resume");
    EXPECT_EQ(fewer.status, 2);
    EXPECT_EQ(
        fewer.err,
        "error: --paths: the checkpoint can't be continued to 16384 paths (65536 paths are "
        "computed already); keep paths and set max_paths, or start again\n");
    // What was refused stays what it was.
    EXPECT_EQ(shell(command + "--paths 16384 --checkpoint c --resume").err, fewer.err);
}

TEST_F(CheckpointTest, OfAnotherRunOrDamagedIsRefused) {
    ASSERT_EQ(run({"run", "day.toml", "--checkpoint", "c"}).status, 0);
    const auto refusal = [&](const std::vector<std::string>& more) {
        std::vector<std::string> words{"run", "day.toml", "--checkpoint", "c", "--resume"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 1);
        return outcome.err;
    };
    EXPECT_EQ(refusal({"--seed", "9"}), "error: c: belongs to another run (seed 1, here 9)\n");
    const std::string whole = folder_.read("c");
    for (const std::size_t at : {40UL, whole.size() / 2, whole.size() - 1}) {
        std::string changed = whole;
        changed[at] = static_cast<char>(changed[at] ^ 1);
        folder_.write("c", changed);
        EXPECT_EQ(refusal({}), "error: c: is damaged (its checksum is wrong)\n");
    }
    folder_.write("c", whole.substr(0, 9));
    EXPECT_TRUE(refusal({}).starts_with("error: c: is not a checkpoint"));
    folder_.write("c", whole);
    std::string done = folder_.read("c.done");
    done[done.size() / 2] = static_cast<char>(done[done.size() / 2] ^ 1);
    folder_.write("c.done", done);
    EXPECT_TRUE(refusal({}).starts_with("error: c.done: is damaged"));
    std::filesystem::remove(folder_.path() / "c.done");
    EXPECT_TRUE(refusal({}).starts_with("error: c.done: can't be read"));
}

TEST_F(CheckpointTest, IsKeptWhenARunIsInterrupted) {
    const std::string run =
        "\"$quasimc\" run run.toml --method light_tracing --paths 1073741824 "
        "--replicates 2 --quiet --checkpoint c --checkpoint-interval 0";
    const Outcome stopped = stopped_once("[ -e c ]", run, "INT");
    EXPECT_EQ(stopped.status, 130) << stopped.err;
    // The paths that the run has traced are not traced again: the checkpoint has grown.
    EXPECT_GT(folder_.read("c").size(), 2000U);
}

TEST_F(CheckpointTest, OfAnAuditedRunLetsItBeAuditedAnew) {
    const std::string command =
        "\"$quasimc\" run run.toml --method light_tracing --paths 1048576 --audit 0.5 --json ";
    ASSERT_EQ(shell(command + "whole.json --quiet").status, 0);
    const Outcome stopped = stopped_once(
        "[ -e c ]", command + "out.json --quiet --checkpoint c --checkpoint-interval 0 --threads 1",
        "KILL");
    EXPECT_EQ(stopped.status, 137) << stopped.err;
    for (int times = 0; times < 2; ++times) {  // of the rest, and of a run that is done
        const Outcome resumed = shell(command + "out.json --quiet --checkpoint c --resume");
        EXPECT_EQ(resumed.status, 0) << resumed.err;
        const auto audit_of = [&](const std::string& name) {
            const std::string text = folder_.read(name);
            const std::size_t at = text.find("\"audit\": {");
            return at == std::string::npos ? "none" : text.substr(at, text.find('}', at) - at);
        };
        EXPECT_NE(audit_of("out.json"), "none");
        EXPECT_EQ(audit_of("out.json"), audit_of("whole.json"));
    }
}

TEST_F(CheckpointTest, IsOfOneRunAtATime) {
    const std::string command =
        "\"$quasimc\" run run.toml --method light_tracing --paths 1073741824 --quiet "
        "--threads 1 --checkpoint c --checkpoint-interval 0";
    // The first is killed, so that its lock is left behind.
    const Outcome second = shell(
        command +
        " & first=$!; until [ -e c ]; do sleep 0.01; done; "
        "\"$quasimc\" run run.toml --checkpoint c --resume; status=$?; "
        "kill -9 $first; wait $first; echo $first; exit $status");
    EXPECT_EQ(second.status, 1);
    const std::string owner = second.out.substr(0, second.out.find('\n'));
    EXPECT_TRUE(
        second.err.starts_with("error: c: is in use by another run (process " + owner + " on "))
        << second.err;
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "c.lock"));
    folder_.write("left", "before the third begins");
    const Outcome third = stopped_once("[ c -nt left ]", command + " --resume", "INT");
    EXPECT_EQ(third.status, 130) << third.err;
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "c.lock"));
}

TEST_F(CheckpointTest, HasOneLockByAnyName) {
    std::filesystem::create_symlink("c", folder_.path() / "k");
    folder_.write("c.lock", "process 1 on another machine");
    for (const char* name : {"c", "k"}) {
        const Outcome outcome = shell(
            "exec 9<>c.lock; flock -n 9 || exit 99; \"$quasimc\" run run.toml --checkpoint " +
            std::string(name));
        EXPECT_EQ(outcome.status, 1) << name;
        EXPECT_NE(
            outcome.err.find("c: is in use by another run (process 1 on another machine)"),
            std::string::npos)
            << name << outcome.err;
    }
    const Outcome done =
        shell("\"$quasimc\" run day.toml -q --checkpoint-interval 0 --checkpoint k");
    EXPECT_EQ(done.status, 0) << done.err;
    EXPECT_TRUE(std::filesystem::is_symlink(folder_.path() / "k"));
    EXPECT_TRUE(std::filesystem::exists(folder_.path() / "c.done"));
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "k.done"));
    for (const char* output : {"c", "k", "c.done"}) {
        const Outcome taken =
            shell("\"$quasimc\" run run.toml --checkpoint k --resume --csv " + std::string(output));
        EXPECT_NE(taken.err.find("is a file of the checkpoint"), std::string::npos) << taken.err;
    }
}

TEST_F(CheckpointTest, TakesNoFilesOfOthers) {
    for (const std::string name : {"c.done", "c.lock"}) {
        folder_.write(name, good_leaves());
        folder_.write(
            "stranger.toml",
            replaced(good_run_file(), "leaves.tri\"", name + "\"\nformat = \"tri\""));
        for (const char* resume : {"", " --resume"}) {
            const Outcome outcome = shell(
                std::string("\"$quasimc\" run stranger.toml --quiet --checkpoint c") + resume);
            EXPECT_EQ(outcome.status, 1) << name;
            EXPECT_TRUE(outcome.err.starts_with("error: " + name + ": ")) << outcome.err;
            EXPECT_EQ(folder_.read(name), good_leaves());
            EXPECT_FALSE(std::filesystem::exists(folder_.path() / "c"));
        }
        std::filesystem::remove(folder_.path() / name);
    }
}

/// A run that had been begun with a weaker end would have had fewer rounds than are there.
TEST_F(CheckpointTest, IsNotTheEndOfARunThatAsksForLess) {
    const std::string command = "\"$quasimc\" run run.toml --quiet --checkpoint c --resume ";
    const auto refusal = [&](const std::string& ends) {
        const Outcome outcome = shell(command + ends);
        EXPECT_EQ(outcome.status, 1) << ends;
        return outcome.err;
    };
    ASSERT_EQ(shell(command + "--max-paths 1024").status, 0);
    EXPECT_EQ(
        refusal("--max-paths 512"),
        "error: run.toml: checkpoint: has 1024 paths already, more than this run requests "
        "(max_paths is "
        "512); request at least as many paths as before, or start again\n");
    EXPECT_NE(
        refusal("").find("neither max_paths nor target_error requires more"), std::string::npos);
    EXPECT_NE(
        refusal("--max-paths 4096 --target-error 0.5").find("the target may need fewer"),
        std::string::npos);
    std::filesystem::remove(folder_.path() / "c");
    ASSERT_EQ(shell(command + "--target-error 0.001 --max-paths 1024").status % 4, 0);
    EXPECT_NE(
        refusal("--target-error 0.002 --max-paths 1024").find("may need fewer"), std::string::npos);
    const Outcome more = shell(command + "--target-error 0.0005 --max-paths 4096 --csv b.csv");
    EXPECT_EQ(more.status % 4, 0) << more.err;
    ASSERT_EQ(
        shell(
            "\"$quasimc\" run run.toml --quiet --target-error 0.0005 --max-paths 4096 --csv w.csv")
                .status %
            4,
        0);
    EXPECT_EQ(table_rows(folder_.read("b.csv")), table_rows(folder_.read("w.csv")));
}

TEST_F(CheckpointTest, HasNoSlotForParts) {
    EXPECT_EQ(run({"run", "run.toml", "--checkpoint", "c", "--part", "1/2"}).status, 2);
    EXPECT_EQ(run({"run", "run.toml", "--resume"}).status, 2);
    EXPECT_EQ(run({"run", "run.toml", "--checkpoint", "run.toml", "--resume"}).status, 1);
    EXPECT_FALSE(std::filesystem::exists(folder_.path() / "c"));
}

class LongCheckpointTest : public CheckpointTest, public ::testing::WithParamInterface<int> {};

TEST_P(LongCheckpointTest, LosesNothingAtFiftyKills) {
    expect_the_bits_of_the_whole("day.toml --paths 524288", GetParam());
}

INSTANTIATE_TEST_SUITE_P(Long, LongCheckpointTest, ::testing::Values(50));

TEST_F(CheckpointTest, IsNoOutput) {
    for (const char* output : {"--csv c", "--json ./c", "--csv c.done", "--csv c.lock"}) {
        const Outcome outcome =
            shell(std::string("\"$quasimc\" run run.toml --checkpoint c ") + output);
        EXPECT_EQ(outcome.status, 2) << output;
        EXPECT_NE(outcome.err.find("is a file of the checkpoint"), std::string::npos)
            << outcome.err;
        EXPECT_FALSE(std::filesystem::exists(folder_.path() / "c")) << output;
    }
    EXPECT_EQ(run({"run", "run.toml", "--checkpoint", "-"}).status, 2);
    EXPECT_EQ(
        run({"run", "run.toml", "--checkpoint", "c", "--checkpoint-interval", "nan"}).status, 2);
}

TEST_F(CheckpointTest, ThatHasNoRoomCostsNoResult) {
    const std::string command =
        "\"$quasimc\" run day.toml --quantities absorbed_flux --checkpoint c --checkpoint-interval "
        "0 --csv ";
    ASSERT_EQ(shell(command + "whole.csv --quiet").status, 0);
    const auto saved = std::filesystem::file_size(folder_.path() / "c.done");
    const auto table = std::filesystem::file_size(folder_.path() / "whole.csv");
    ASSERT_GT(saved, table + 2048) << "there is a limit between them";
    std::filesystem::remove(folder_.path() / "c");
    std::filesystem::remove(folder_.path() / "c.done");
    folder_.write("day.toml", replaced(folder_.read("day.toml"), "json = \"out.json\"\n", ""));
    const Outcome outcome = shell(
        "ulimit -f " + std::to_string((table + 1023) / 1024 + 1) + "; " + command + "out.csv");
    EXPECT_EQ(outcome.status, 1) << outcome.err;
    EXPECT_NE(outcome.err.find("the run goes on without a checkpoint"), std::string::npos)
        << outcome.err;
    EXPECT_EQ(table_rows(folder_.read("out.csv")), table_rows(folder_.read("whole.csv")));
}

}  // namespace
}  // namespace quasimc::test
