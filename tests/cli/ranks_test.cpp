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

/// Lets Open MPI run here: as any user, on any number of cores.
const std::string kOpenMpi =
    "export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 "
    "OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_hwloc_base_binding_policy=none; ";

class RanksTest : public ProgramTest {
  protected:
    /// Runs the program on ranks.
    [[nodiscard]] Outcome run_ranks(
        int ranks, const std::string& arguments, const std::string& after = "") const {
        return shell(
            kOpenMpi + "'" QUASIMC_MPIRUN "' -n " + std::to_string(ranks) + " \"$quasimc\" run " +
            arguments + " " + after);
    }
    void write_day() const {
        folder_.write(
            "day.toml", good_run_file() +
                            "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
                            "[time]\nfrom = \"2024-06-20\"\nto = \"2024-06-20\"\n"
                            "utc_offset_hours = 1\nhours = [9, 12]\nsky = \"uniform\"\n");
    }
};

class RanksOfMethods : public RanksTest, public ::testing::WithParamInterface<const char*> {};

TEST_F(RanksTest, PrintOnceWhatTheyDoNotShare) {
    for (const char* command : {"check run.toml", "list samplers", "info run.toml", "--version"}) {
        const Outcome alone = shell("\"$quasimc\" " + std::string(command));
        const Outcome all =
            shell(kOpenMpi + "'" QUASIMC_MPIRUN "' -n 3 \"$quasimc\" " + std::string(command));
        EXPECT_EQ(all.status, 0) << all.err;
        EXPECT_EQ(all.out, alone.out);
    }
    EXPECT_NE(shell(kOpenMpi + "'" QUASIMC_MPIRUN "' -n 3 \"$quasimc\" check none.toml").status, 0);
}

TEST_P(RanksOfMethods, GiveTheSameBitsInAnyNumber) {
    const std::string run = std::string("run.toml --paths 32768 --method ") + GetParam();
    ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
    for (const int ranks : {1, 2, 3, 4}) {
        const Outcome outcome =
            run_ranks(ranks, run + " --csv r.csv --threads " + std::to_string(1 + ranks % 2));
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv"))) << ranks;
        const std::string& text = outcome.out;
        EXPECT_EQ(text.find("written"), text.rfind("written")) << text;  // one summary
    }
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    RanksOfMethods,
    ::testing::Values("light_tracing", "first_hits", "from_organs", "ray_bundles"));

TEST_F(RanksTest, GiveTheBitsOfTimesSweepsAndTargets) {
    write_day();
    folder_.write(
        "sweep.toml", good_run_file() +
                          "[sweep]\nmax_depth = [1, 2]\nseed = [1, 2, 3]\n"
                          "[[table]]\nfile = \"sum.csv\"\nper = \"sweep\"\n");
    for (const std::string run :
         {"day.toml", "sweep.toml", "run.toml --target-error 0.02 --method light_tracing"}) {
        ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
        const std::string sum = run == "sweep.toml" ? rows_of(folder_.read("sum.csv")) : "";
        for (const int ranks : {2, 3, 5}) {
            const Outcome outcome = run_ranks(ranks, run + " --csv r.csv --quiet");
            EXPECT_EQ(outcome.status, 0) << outcome.err;
            EXPECT_EQ(outcome.out, "");
            EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv"))) << run;
            if (run == "sweep.toml") {
                EXPECT_EQ(rows_of(folder_.read("sum.csv")), sum);
            }
        }
    }
}

/// Each rank decides on the lamps under control itself.
TEST_F(RanksTest, DimLampsUnderControlAlike) {
    folder_.write(
        "lamps.toml",
        good_run_file() +
            "[[source]]\ntype = \"point\"\nname = \"hps\"\nposition = [2, 2, 6]\npower = 4000\n"
            "[[sensors]]\nname = \"bench\"\nat = [[0.2, 0.2, 0]]\n"
            "[[control]]\nsources = \"hps\"\nsensors = \"bench\"\nset_point = 3\n"
            "[site]\nlatitude_deg = 51.97\nlongitude_deg = 5.67\n"
            "[time]\nday = \"2024-12-15\"\nutc_offset_hours = 1\nhours = [7, 11]\n"
            "[[table]]\nfile = \"control.csv\"\nrows = \"control\"\n");
    const auto controls = [&] {
        const std::string table = folder_.read("control.csv");
        return table.substr(table.find("\ntime,"));
    };
    ASSERT_EQ(shell("\"$quasimc\" run lamps.toml --csv whole.csv --quiet").status, 0);
    const std::string whole = controls();
    for (const int ranks : {2, 3}) {
        const Outcome outcome = run_ranks(ranks, "lamps.toml --csv r.csv --quiet");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv"))) << ranks;
        EXPECT_EQ(controls(), whole);
    }
}

TEST_F(RanksTest, GoOnWithTimesThatACheckpointKnows) {
    write_day();
    ASSERT_EQ(shell("\"$quasimc\" run day.toml --csv whole.csv --quiet").status, 0);
    // More paths of times that are kept, on other numbers of ranks.
    ASSERT_EQ(run_ranks(2, "day.toml --checkpoint c --quiet").status, 0);
    const Outcome again = run_ranks(3, "day.toml --checkpoint c --resume --csv r.csv --quiet");
    EXPECT_EQ(again.status, 0) << again.err;
    EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv")));
    const std::string more = "day.toml --max-paths 1024 --quiet";
    ASSERT_EQ(shell("\"$quasimc\" run " + more + " --csv whole.csv").status, 0);
    const Outcome exact = run_ranks(2, more + " --checkpoint c --resume --csv r.csv");
    EXPECT_EQ(exact.status, 0) << exact.err;
    EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv")));
}

/// What comes through pipes is there once.
TEST_F(RanksTest, ReadEachFileOnceForAllOfThem) {
    ASSERT_EQ(run({"run", "run.toml", "--csv", "whole.csv"}).status, 0);
    const std::string whole = rows_of(folder_.read("whole.csv"));
    const Outcome from_input = run_ranks(3, "- --csv r.csv --json r.json --quiet", "< run.toml");
    EXPECT_EQ(from_input.status, 0) << from_input.err;
    EXPECT_EQ(rows_of(folder_.read("r.csv")), whole);
    folder_.write("piped.toml", replaced(good_run_file(), "leaves.tri", "pipe.tri"));
    ASSERT_EQ(shell("mkfifo pipe.tri").status, 0);
    const Outcome piped =
        run_ranks(3, "piped.toml --csv r.csv --quiet", "& cat leaves.tri > pipe.tri; wait $!");
    EXPECT_EQ(piped.status, 0) << piped.err;
    EXPECT_EQ(rows_of(folder_.read("r.csv")), whole);
    const Outcome repeated = run_ranks(2, "--repeat r.json --csv r.csv --quiet");
    EXPECT_EQ(repeated.status, 0) << repeated.err;
    EXPECT_EQ(rows_of(folder_.read("r.csv")), whole);
}

/// The first rank of the job in this folder gets a signal once a file has more than `bytes` bytes.
std::string signal_when(const std::string& file, int bytes) {
    return "& until [ $(stat -c %s " + file + " 2>/dev/null || echo 0) -gt " +
           std::to_string(bytes) +
           " ]; do sleep 0.02; done; "
           "kill -INT $(for p in $(pgrep -f 'quasimc run day.toml'); do "
           "[ $(readlink /proc/$p/cwd) = $PWD ] && grep -qz OMPI_COMM_WORLD_RANK=0 "
           "/proc/$p/environ && echo $p; done); wait $!";
}

/// A month, stopped in its first days, begins as its first two days by themselves.
TEST_F(RanksTest, StopASeriesOfTimesAfterTheLastThatIsComplete) {
    write_day();
    const std::string days = replaced(folder_.read("day.toml"), "[9, 12]", "[0, 23]");
    const std::string last = "to = \"2024-06-20\"";
    folder_.write("day.toml", replaced(days, last, "to = \"2024-07-19\""));
    folder_.write("two.toml", replaced(days, last, "to = \"2024-06-21\""));
    const Outcome stopped = run_ranks(
        3,
        "day.toml --paths 262144 --csv r.csv --checkpoint c --checkpoint-interval 0.5 --quiet "
        "--threads 1",
        signal_when("c.done", 1));
    EXPECT_EQ(stopped.status, 130) << stopped.err;
    ASSERT_EQ(shell("\"$quasimc\" run two.toml --paths 262144 --csv two.csv --quiet").status, 0);
    const std::string rows = rows_of(folder_.read("r.csv"));
    const std::string two = rows_of(folder_.read("two.csv"));
    EXPECT_GT(rows.size(), 100U);
    EXPECT_LT(rows.size(), 10 * two.size());
    EXPECT_EQ(rows.substr(0, two.size()), two.substr(0, rows.size()));
}

TEST_F(RanksTest, KeepToALimitOfTimeAndStopAtCtrlC) {
    const std::string infinite = "run.toml --paths 1073741824 --method light_tracing --quiet";
    const Outcome timed = run_ranks(2, infinite + " --max-seconds 1");
    EXPECT_EQ(timed.status, 4) << timed.err;
    const Outcome stopped = run_ranks(
        2, infinite,
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
        "run.toml --method light_tracing --paths 16384 --max-paths 1048576 --replicates 4 --quiet";
    ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv").status, 0);
    const Outcome killed = run_ranks(
        3, run + " --csv r.csv --checkpoint c --checkpoint-interval 0 --threads 1",
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

/// Jobs of three ranks, one of which is killed at some time, repeatedly.
class KilledRanks : public RanksTest, public ::testing::WithParamInterface<int> {
  protected:
    /// Kills a rank of each of `jobs` jobs. Each resumes the job before.
    /// @returns how many jobs were killed, and how many of them took more than 10 s to end
    [[nodiscard]] std::string kill_jobs(const std::string& run, int jobs) const {
        return shell(
                   kOpenMpi +
                   "RANDOM=3; killed=0; late=0\n"
                   "for i in $(seq 1 " +
                   std::to_string(jobs) +
                   "); do\n"
                   "  '" QUASIMC_MPIRUN "' -n 3 \"$quasimc\" run " +
                   run +
                   " --checkpoint c --resume --checkpoint-interval 0 --quiet --threads 1 2> err & "
                   "job=$!\n"
                   "  rank=$((RANDOM % 3)); ours=\n"
                   "  until [ -n \"$ours\" ] || ! kill -0 $job 2> /dev/null; do sleep 0.02\n"
                   "    ours=$(for p in $(pgrep -f 'quasimc run day.toml'); do "
                   "[ $(readlink /proc/$p/cwd) = $PWD ] && "
                   "grep -qz OMPI_COMM_WORLD_RANK=$rank /proc/$p/environ && echo $p; done)\n"
                   "  done\n"
                   "  sleep 0.$(printf %02d $((RANDOM % 90)))\n"
                   "  kill -9 $ours; before=$(date +%s); wait $job\n"
                   "  if [ $? != 0 ]; then killed=$((killed + 1)); fi\n"
                   "  if [ $(($(date +%s) - before)) -gt 10 ]; then late=$((late + 1)); fi\n"
                   "done 2> /dev/null; echo $killed killed, $late late")
            .out;
    }
    void expect_the_bits_of_the_whole(int jobs) const {
        const std::string run = "day.toml --method light_tracing --paths 262144";
        ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
        const std::string counts = kill_jobs(run + " --csv r.csv", jobs);
        EXPECT_FALSE(counts.starts_with("0 ")) << counts;
        EXPECT_NE(counts.find(" 0 late"), std::string::npos) << counts;
        const Outcome last = run_ranks(2, run + " --csv r.csv --checkpoint c --resume --quiet");
        EXPECT_EQ(last.status, 0) << last.err;
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv")));
    }
};

TEST_P(KilledRanks, LoseNothingThatWasKept) {
    write_day();
    folder_.write("day.toml", replaced(folder_.read("day.toml"), "[9, 12]", "[4, 20]"));
    expect_the_bits_of_the_whole(GetParam());
}

INSTANTIATE_TEST_SUITE_P(FewTimes, KilledRanks, ::testing::Values(4));
INSTANTIATE_TEST_SUITE_P(Long, KilledRanks, ::testing::Values(50));

/// Four ranks on two machines that share nothing but a wire: two network namespaces with names of
/// their own, between which the launcher starts its daemons as it would by ssh.
TEST_F(RanksTest, OfTwoNetworksGiveTheSameBits) {
    const std::string make =
        "a=qmc${$}a; b=qmc${$}b; "
        "trap 'ip netns del $a; ip netns del $b' EXIT; "
        "{ ip netns add $a && ip netns add $b && "
        "ip link add $a netns $a type veth peer name $b netns $b && "
        "ip -n $a addr add 10.77.0.1/24 dev $a && ip -n $b addr add 10.77.0.2/24 dev $b && "
        "ip -n $a link set $a up && ip -n $b link set $b up && "
        "ip -n $a link set lo up && ip -n $b link set lo up; } 2> /dev/null || exit 77\n";
    if (shell(make).status == 77) {
        GTEST_SKIP() << "network namespaces take a privilege that is not there";
    }
    write_day();
    folder_.write("hosts", "10.77.0.1 slots=2\n10.77.0.2 slots=2\n");
    for (const std::string run : {"run.toml --paths 65536", "day.toml --paths 16384"}) {
        ASSERT_EQ(shell("\"$quasimc\" run " + run + " --csv whole.csv --quiet").status, 0);
        const Outcome outcome = shell(
            kOpenMpi + make +
            // A machine has a name of its own as well.
            "on() { n=$1; shift; ip netns exec $n unshare --uts "
            "sh -c \"echo $n > /proc/sys/kernel/hostname; $*\"; }\n"
            "printf '%s\\n' '#!/bin/bash' \"$(declare -f on)\" 'n='$b "
            "'[ $1 = 10.77.0.1 ] && n='$a shift 'on $n $*' > agent; chmod +x agent\n"
            "on $a '" QUASIMC_MPIRUN
            "' --hostfile hosts --mca plm_rsh_agent $PWD/agent "
            "--mca btl_tcp_if_include 10.77.0.0/24 --mca oob_tcp_if_include 10.77.0.0/24 "
            "-n 4 $quasimc run " +
            run + " --csv r.csv --quiet --threads 1");
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(rows_of(folder_.read("r.csv")), rows_of(folder_.read("whole.csv"))) << run;
    }
}

}  // namespace
}  // namespace quasimc::test
