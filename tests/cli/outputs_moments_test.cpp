// Whenever a run ends or fails, its files are complete, old or new.

#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "outputs.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// Points of a run at even distances, from its start to behind its end.
class InterruptedOutputs : public OutputsTest, public ::testing::WithParamInterface<int> {
  protected:
    static constexpr const char* kRun = "\"$quasimc\" run run.toml -q --paths 65536";
    static constexpr double kUntil = 1.3;  // of the duration of a run

    /// How long a run takes, seconds.
    [[nodiscard]] double duration() {
        const Outcome outcome = shell(
            std::string("start=$(date +%s%N); ") + kRun +
            "; end=$(date +%s%N); echo $((end - start))");
        return std::stod(outcome.out) * 1e-9;
    }

    /// Calls act(point) for as many points of a run as the parameter gives, each with old outputs.
    /// @param whole  the end of a run, in the unit of its points
    template <typename Act>
    void for_each_point(double whole, const Act& act) {
        for (int i = 0; i < GetParam(); ++i) {
            write_old();
            act(kUntil * whole * (i + 0.5) / GetParam());
        }
    }

    /// Each output is old or new, and nothing is left beside them.
    void expect_old_or_new(const std::string& words) {
        EXPECT_TRUE(folder_.read("out.csv") == "old" || has_new_csv()) << words;
        EXPECT_TRUE(folder_.read("out.json") == "old" || has_new_json()) << words;
        EXPECT_EQ(hidden_files(), Texts{}) << words;
    }
};

// Between the two renames the table is new and the result is old: the only mixture that may be.
// A run that is killed at a random time hits it about once in ten thousand times.
class KilledOutputs : public InterruptedOutputs {};

TEST_P(KilledOutputs, AreOldOrNew) {
    const int sweeps = GetParam();
    constexpr int kKills = 20;  // of a sweep, from its start to behind its end
    double whole_s = duration();
    int old = 0;
    int fresh = 0;
    constexpr int kMost = 8;  // on a machine that becomes busier and busier
    for (int sweep = 0; sweep < sweeps || (fresh == 0 && sweep < kMost); ++sweep) {
        const int fresh_before = fresh;
        for (int i = 0; i < kKills; ++i) {
            write_old();
            const double time_s =
                kUntil * whole_s * (i + std::fmod((sweep + 0.5) / sweeps, 1)) / kKills;
            static_cast<void>(shell(
                std::string(kRun) + " & sleep " + std::to_string(time_s) +
                "; kill -9 $! 2>/dev/null; wait $!"));
            const bool old_csv = folder_.read("out.csv") == "old";
            const bool old_json = folder_.read("out.json") == "old";
            EXPECT_TRUE(old_csv || has_new_csv()) << time_s;
            EXPECT_TRUE(old_json || has_new_json()) << time_s;
            EXPECT_TRUE(old_json || !old_csv) << "the result gets its name last";
            (old_csv && old_json ? old : fresh) += 1;
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

/// As many bytes as fit on a disk that is nearly full: none, half of one output, all of one.
TEST_P(InterruptedOutputs, AreOldOrNewWhereverTheDiskIsFull) {
    ASSERT_EQ(run({"run", "run.toml", "-q"}).status, 0);
    const auto size = static_cast<double>(folder_.read("out.json").size());
    int whole = 0, reported = 0;
    for_each_point(size, [&](double point) {
        const auto bytes = static_cast<long>(point);
        const Outcome outcome =
            shell("prlimit --fsize=" + std::to_string(bytes) + " \"$quasimc\" run run.toml -q");
        const std::string words = std::to_string(bytes) + " bytes: " + outcome.err;
        expect_old_or_new(words);
        EXPECT_EQ(outcome.status == 0, has_new_csv() && has_new_json()) << words;
        EXPECT_EQ(outcome.status == 0, outcome.err.empty()) << words;
        (outcome.status == 0 ? whole : reported) += 1;
    });
    EXPECT_GT(whole, 0);
    EXPECT_GT(reported, 0);
}

/// The disk becomes full at some time.
TEST_P(InterruptedOutputs, AreOldOrNewWheneverTheDiskBecomesFull) {
    for_each_point(duration(), [&](double time_s) {
        const Outcome outcome = shell(
            std::string(kRun) + " & sleep " + std::to_string(time_s) +
            "; prlimit --pid $! --fsize=0 2>/dev/null; wait $!");
        const std::string words = std::to_string(time_s) + " s: " + outcome.err;
        expect_old_or_new(words);
        EXPECT_EQ(outcome.status == 0, has_new_csv() && has_new_json()) << words;
    });
}

/// If standard output is closed, files are written all the same.
TEST_P(InterruptedOutputs, AreWrittenIfStandardOutputIsClosed) {
    for_each_point(duration(), [&](double time_s) {
        const Outcome outcome = shell(
            "\"$quasimc\" run run.toml --paths 65536 2>&1 | sleep " + std::to_string(time_s) +
            "; exit ${PIPESTATUS[0]}");
        expect_old_or_new(std::to_string(time_s) + " s");
        EXPECT_TRUE(has_new_csv() && has_new_json()) << time_s << " s";
        EXPECT_TRUE(outcome.status == 0 || outcome.status == 141)
            << outcome.status << " after " << time_s << " s";
    });
}

INSTANTIATE_TEST_SUITE_P(Ordinary, InterruptedOutputs, ::testing::Values(12));
INSTANTIATE_TEST_SUITE_P(Long, InterruptedOutputs, ::testing::Values(100));

}  // namespace
}  // namespace quasimc::test
