// Runs that resume from a stored state.

#include "run/run_state.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "samplers/catalogue.h"
#include "solvers/catalogue.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// Stores every state of a run, as bytes.
class RecordedStates final : public RunListener, public StoredStates {
  public:
    std::vector<std::string> saved;
    std::string finished;
    std::optional<RunState> from;

    [[nodiscard]] std::optional<RunState> state_of(std::size_t /*time_step*/) override {
        return std::exchange(from, std::nullopt);
    }
    [[nodiscard]] bool wants_pause() override { return true; }
    void on_pause(const RunSoFar& run) override { saved.push_back(save_state(run.snapshot())); }
    void on_round(const RunSoFar& run) override { on_pause(run); }
    void on_last_round(const RunSoFar& run) override { finished = save_state(run.snapshot()); }
};

Scene test_scene() {
    return leaf_over_ground();
}
Sources test_lights() {
    return {sun(30, {1}), sky({1})};
}

Result run_recorded(RunSpec spec, RecordedStates& states, unsigned threads = 1) {
    spec.threads = threads;
    std::stop_source never;
    return run(
        test_scene(), test_lights(), spec,
        {.stop = never.get_token(), .listeners = {&states}, .origin = {.states = &states}});
}

void expect_equal_runs(const Result& a, const Result& b) {
    EXPECT_EQ(a.paths, b.paths);
    EXPECT_EQ(a.rays, b.rays);
    EXPECT_EQ(a.stop, b.stop);
    EXPECT_EQ(a.fraction_at_target, b.fraction_at_target);
    EXPECT_TRUE(std::equal(
        a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
        [](const Estimate& x, const Estimate& y) {
            return x.mean == y.mean && x.ci95_low == y.ci95_low && x.ci95_high == y.ci95_high;
        }));
}

class RunStates : public ::testing::TestWithParam<Method> {
  protected:
    /// A run with several tasks.
    [[nodiscard]] static RunSpec spec() {
        RunSpec spec = spec_of(GetParam(), 1U << 15U);
        spec.replicates = 3;
        return spec;
    }
};

TEST_P(RunStates, GoOnToTheSameBitsFromEveryPause) {
    RunSpec rounds = spec();
    rounds.paths /= 2;
    rounds.max_paths = 2 * rounds.paths;
    for (const RunSpec& spec : {spec(), rounds}) {
        const Result whole = run(test_scene(), test_lights(), spec);
        RecordedStates first;
        expect_equal_runs(run_recorded(spec, first), whole);
        ASSERT_GE(first.saved.size(), 3U);
        const std::size_t step = std::max<std::size_t>(1, first.saved.size() / 5);
        for (std::size_t i = 0; i < first.saved.size(); i += step) {
            RecordedStates later;
            later.from = load_state(first.saved[i]);
            const Result resumed = run_recorded(spec, later, static_cast<unsigned>(1 + i % 3));
            expect_equal_runs(resumed, whole);
            // Each pause comes after one more task.
            const auto tasks = static_cast<double>(first.saved.size());
            const double expected = static_cast<double>((i + 1) * whole.paths) / tasks;
            EXPECT_NEAR(
                resumed.paths_before, expected, 2 * static_cast<double>(whole.paths) / tasks);
            // Completed tasks are not repeated.
            if (i % 3 == 0) {
                EXPECT_EQ(later.saved.size(), first.saved.size() - i - 1);
            }
        }
    }
}

/// A run with a target begins with pilot rounds.
TEST_P(RunStates, OfATargetGoOnToTheSameBitsFromEveryPause) {
    RunSpec spec = RunStates::spec();
    spec.paths = 1U << 12U;
    spec.max_paths = 2 * spec.paths;
    for (const double target : {.05, 1e-9}) {
        spec.target_error = target;
        const Result whole = run(test_scene(), test_lights(), spec);
        RecordedStates first;
        expect_equal_runs(run_recorded(spec, first), whole);
        EXPECT_LT(whole.rounds.front().paths, spec.paths) << "a pilot round";
        for (std::size_t i = 0; i < first.saved.size(); i += 2) {
            RecordedStates later;
            later.from = load_state(first.saved[i]);
            expect_equal_runs(run_recorded(spec, later, static_cast<unsigned>(1 + i % 3)), whole);
        }
    }
}

/// Pilot rounds that a run with a smaller target might not have are traced again.
TEST_P(RunStates, OfAPilotBeginAgainForASmallerTarget) {
    RunSpec spec = RunStates::spec();
    spec.paths = 1U << 12U;
    spec.max_paths = spec.paths;
    spec.target_error = 0.5;
    RecordedStates first;
    ASSERT_LT(run_recorded(spec, first).paths, spec.paths);
    spec.target_error = 1e-9;
    RecordedStates later;
    later.from = load_state(first.finished);
    const Result exact = run_recorded(spec, later);
    EXPECT_EQ(exact.paths_before, 0);
    expect_equal_runs(exact, run(test_scene(), test_lights(), spec));
}

TEST_P(RunStates, OfRunsThatAreDoneGiveTheResultAndGoOnToASmallerTarget) {
    RunSpec spec = RunStates::spec();
    spec.paths = 1U << 8U;  // no pilot rounds
    spec.target_error = 0.5;
    RecordedStates first;
    const Result whole = run_recorded(spec, first);
    ASSERT_EQ(whole.stop, StopReason::target_reached);
    RecordedStates again;
    again.from = load_state(first.finished);
    const Result there = run_recorded(spec, again);
    expect_equal_runs(there, whole);
    EXPECT_EQ(there.paths_before, static_cast<double>(whole.paths));
    EXPECT_EQ(whole.paths_before, 0);
    EXPECT_TRUE(again.saved.empty());
    EXPECT_EQ(again.finished, first.finished);

    spec.target_error = 1e-9;
    spec.max_paths = 1U << 12U;
    RecordedStates later;
    later.from = load_state(first.finished);
    const Result exact = run_recorded(spec, later);
    EXPECT_EQ(exact.paths, spec.max_paths);
    EXPECT_EQ(exact.paths_before, static_cast<double>(whole.paths));
    EXPECT_EQ(exact.stop, StopReason::path_limit);
    expect_equal_runs(exact, run(test_scene(), test_lights(), spec));
}

TEST_P(RunStates, BecomeRunsOfMorePathsWhereTheBitsAreTheSame) {
    RunSpec few = spec();
    few.paths = 1U << 14U;
    RunSpec many = few;
    many.paths *= 4;
    const bool adds_up = find_solver(GetParam())->do_rounds_add_up != nullptr;
    EXPECT_EQ(adds_up, GetParam() != Method::first_hits);
    for (const SamplerEntry& sampler : sampler_catalogue()) {
        few.sampler = many.sampler = sampler.name;
        const bool can = adds_up && sampler.is_sequence;
        RecordedStates first;
        static_cast<void>(run_recorded(few, first));
        RecordedStates later;
        later.from = load_state(first.finished);
        if (can) {
            expect_equal_runs(run_recorded(many, later), run(test_scene(), test_lights(), many));
        } else {
            EXPECT_THROW(static_cast<void>(run_recorded(many, later)), InputError) << sampler.name;
        }
    }
}

TEST(RunState, BecomesNoRunThatWouldHaveOtherBits) {
    RunSpec few = spec_of(Method::light_tracing, 1U << 15U);
    few.max_paths = 2 * few.paths;
    RecordedStates first;
    static_cast<void>(run_recorded(few, first));
    const auto refusal_of = [&](std::uint64_t paths) {
        RunSpec other = few;
        other.paths = paths;
        other.max_paths = 0;
        RecordedStates later;
        later.from = load_state(first.finished);
        try {
            static_cast<void>(run_recorded(other, later));
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(refusal_of(1U << 16U), "");
    EXPECT_EQ(refusal_of(1U << 17U), "");
    EXPECT_NE(refusal_of(1U << 14U).find("65536 paths are computed already"), std::string::npos);
    few.sampler = "halton";
    few.max_paths = 0;
    few.paths = 20000;  // no whole blocks
    first.saved.clear();
    static_cast<void>(run_recorded(few, first));
    EXPECT_NE(
        refusal_of(40000).find("differ from those of a run with 40000 paths"), std::string::npos);
    EXPECT_NE(refusal_of(60000).find("must be 20000, doubled"), std::string::npos);
}

/// A run with more paths checks its target after these, like a run that began with them.
TEST(RunState, ChecksATargetAfterTheFirstRequestedRound) {
    RunSpec few = spec_of(Method::light_tracing, 1U << 14U);
    few.target_error = 0.9;
    RecordedStates first;
    ASSERT_EQ(run_recorded(few, first).stop, StopReason::target_reached);
    RunSpec many = few;
    many.paths = 1U << 16U;
    RecordedStates later;
    later.from = load_state(first.finished);
    expect_equal_runs(run_recorded(many, later), run(test_scene(), test_lights(), many));
}

TEST_P(RunStates, OfAnotherRunAreRefused) {
    RecordedStates first;
    static_cast<void>(run_recorded(spec(), first));
    RunSpec other = spec();
    ++other.seed;
    RecordedStates later;
    later.from = load_state(first.saved[0]);
    EXPECT_THROW(static_cast<void>(run_recorded(other, later)), InputError);
    other = spec();
    ++other.replicates;
    later.from = load_state(first.saved[0]);
    EXPECT_THROW(static_cast<void>(run_recorded(other, later)), InputError);
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    RunStates,
    ::testing::Values(Method::light_tracing, Method::from_organs, Method::first_hits));

TEST(RunState, ThatIsCutOffIsRefused) {
    const std::string bytes = save_state({});
    EXPECT_FALSE(load_state(bytes).done.has_value());
    EXPECT_THROW(static_cast<void>(load_state(bytes + "x")), std::invalid_argument);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_THROW(static_cast<void>(load_state(bytes.substr(0, size))), std::invalid_argument);
    }
}

}  // namespace
}  // namespace quasimc::test
