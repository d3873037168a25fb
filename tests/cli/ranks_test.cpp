// Runs on several ranks of MPI, all on this machine.

#include <chrono>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "program.h"

namespace quasimc::test {
namespace {

/// A table without the lines on how it was made.
std::string rows_of(const std::string& table) {
    const std::size_t at = table.find("id,name");
    return at == std::string::npos ? "no table" : table.substr(at);
}

class RanksTest : public ProgramTest {
  protected:
    /// Runs the program on ranks. @param node  ranks that share memory; 0: all
    [[nodiscard]] Outcome run_ranks(
        int ranks,
        const std::string& arguments,
        int node = 0,
        const std::string& after = "") const {
        return shell(
            "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
            "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none "
            "QUASIMC_RANKS_OF_NODE=" +
            std::to_string(node) + "; '" QUASIMC_MPIRUN "' -n " + std::to_string(ranks) +
            " \"$quasimc\" run " + arguments + " " + after);
    }
    void write_day() const {
        folder_.write(
            "day.toml", good_run_file() +
                            "[place]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
                            "[time]\nfrom = \"2024-06-20\"\nto = \"2024-06-20\"\n"
                            "utc_offset_hours = 1\nhours = [9, 12]\nsky = \"uniform\"\n");
    }
};

class RanksOfMethods : public RanksTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(RanksOfMethods, GiveTheSameBitsInAnyNumber) {
    const std::string run = std::string("run.toml --paths 32768 --method ") + GetParam();
    ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
    for (const int ranks : {1, 2, 3, 4}) {
        const Outcome outcome = run_ranks(
            ranks, run + " --csv r.csv --threads " + std::to_string(1 + ranks % 2), ranks / 2);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv"))) << ranks;
        const std::string& text = outcome.out;
        EXPECT_EQ(text.find("written"), text.rfind("written")) << text;  // one summary
    }
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod, RanksOfMethods, ::testing::Values("light_tracing", "first_hits", "from_organs"));

TEST_F(RanksTest, GiveTheBitsOfTimesSweepsAndTargets) {
    write_day();
    folder_.write(
        "sweep.toml", good_run_file() + "[sweep]\nmax_depth = [1, 2]\nseed = [1, 2, 3]\n");
    for (const std::string run :
         {"day.toml", "sweep.toml", "run.toml --target-error 0.02 --method light_tracing"}) {
        ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
        const Outcome outcome = run_ranks(3, run + " --csv r.csv --quiet");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv"))) << run;
    }
}

TEST_F(RanksTest, KeepToALimitOfTimeAndStopAtCtrlC) {
    const std::string endless = "run.toml --paths 1073741824 --method light_tracing --quiet";
    const Outcome timed = run_ranks(2, endless + " --max-seconds 1");
    EXPECT_EQ(timed.status, 4) << timed.err;
    const Outcome stopped = run_ranks(
        2, endless, 0,
        "& sleep 2; kill -INT $(pgrep -f 'quasimc run run.toml --paths 1073741824' | "
        "while read p; do grep -qz OMPI_COMM_WORLD_RANK=0 /proc/$p/environ && "
        "[ $(readlink /proc/$p/cwd) = $PWD ] && echo $p; done) ; wait $!");
    EXPECT_EQ(stopped.status, 130) << stopped.err;
    EXPECT_NE(folder_.read("out.csv").find("id,name"), std::string::npos);
}

TEST_F(RanksTest, ReportBadInputOnce) {
    folder_.write("run.toml", "format = 1\n");
    const Outcome outcome = run_ranks(3, "run.toml");
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.err.find("bands"), outcome.err.rfind("bands")) << outcome.err;
}

/// The scripts of examples/06-cluster, as far as they go without SLURM.
TEST_F(RanksTest, OfTheScriptForSlurmWriteTheSameTable) {
    const std::string prepare =
        "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
        "OMPI_MCA_rmaps_base_oversubscribe=1 MPIRUN='" QUASIMC_MPIRUN
        "' QUASIMC=\"$quasimc\"; "
        "scripts='" QUASIMC_SOURCE_DIR "/examples/06-cluster'; ";
    ASSERT_EQ(run({"run", "run.toml", "--csv", "whole.csv"}).status, 0);
    for (int times = 0; times < 2; ++times) {  // as if it had been put back into the queue
        const Outcome ranks =
            shell(prepare + "SLURM_CPUS_PER_TASK=1 sh \"$scripts/ranks.sh\" run.toml --csv r.csv");
        EXPECT_EQ(ranks.status, 0) << ranks.err;
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv")));
    }
    const Outcome array = shell(
        prepare +
        "export SLURM_ARRAY_TASK_COUNT=3; for i in 1 2 3; do SLURM_ARRAY_TASK_ID=$i "
        "sh \"$scripts/array.sh\" run.toml; done; \"$quasimc\" merge part.* --csv m.csv");
    EXPECT_EQ(array.status, 0) << array.err;
    EXPECT_EQ(rows_of(folder_.read("m.csv")), rows_of(folder_.read("whole.csv")));
}

/// The whole job ends when one of its ranks is killed, and goes on on another number of ranks.
TEST_F(RanksTest, EndWithinSecondsWhenOneDiesAndGoOn) {
    const std::string run =
        "run.toml --method light_tracing --paths 1048576 --replicates 4 --quiet";
    ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv").status, 0);
    const Outcome killed = run_ranks(
        3, run + " --csv r.csv --checkpoint c --every 0 --threads 1", 0,
        "& until [ $(stat -c %s c 2>/dev/null || echo 0) -gt 2500 ]; do sleep 0.02; done; "
        "kill -9 $(for p in $(pgrep -f 'quasimc run run.toml --method'); do "
        "[ $(readlink /proc/$p/cwd) = $PWD ] && grep -qz OMPI_COMM_WORLD_RANK=1 /proc/$p/environ "
        "&& echo $p; done) ; wait $!");
    EXPECT_NE(killed.status, 0);
    EXPECT_NE(killed.err.find("rank 1"), std::string::npos) << killed.err;
    const Outcome resumed = run_ranks(2, run + " --csv r.csv --checkpoint c --resume");
    EXPECT_EQ(resumed.status, 0) << resumed.err;
    EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv")));
}

}  // namespace
}  // namespace quasimc::test
