// Runs that several processes trace together; here each is a thread.

#include "run/run_team.h"

#include <algorithm>
#include <atomic>
#include <barrier>
#include <cstdint>
#include <deque>
#include <map>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "base/process_time.h"
#include "parallel/dealt_runs.h"
#include "parallel/team_helper.h"
#include "run/run_state.h"
#include "statistical/scenes.h"
#include "sums/sum_data.h"
#include "support/listening.h"

namespace quasimc::test {
namespace {

/// Shared data of the processes of a team.
class Meeting {
  public:
    explicit Meeting(unsigned size) : size_(size), barrier_(size) {}

  private:
    friend class Member;

    /// Orders of the first process.
    template <typename T>
    T reported(unsigned rank, const T& own, T& shared) {
        if (rank == 0) {
            shared = own;
        }
        barrier_.arrive_and_wait();
        const T reported = shared;
        barrier_.arrive_and_wait();
        return reported;
    }

    unsigned size_;
    std::barrier<> barrier_;
    bool met_ = true;
    TeamOrder order_;
    std::mutex mutex_;
    std::map<std::uint64_t, std::deque<std::string>> sent_;  // by sender
    std::atomic<bool> is_stopped_{false};
    std::vector<std::int64_t> total_;
};

/// A team from the view of one of its processes.
class Member final : public RunTeam {
  public:
    Member(Meeting& all, unsigned rank) : all_(all), rank_(rank) {}

    [[nodiscard]] std::uint64_t rank() const override { return rank_; }
    [[nodiscard]] std::uint64_t size() const override { return all_.size_; }
    [[nodiscard]] bool meet(bool is_done) override {
        all_.is_stopped_ = all_.is_stopped_ || (rank_ == 0 && !is_done);
        const bool is_first_done = all_.reported(rank_, is_done, all_.met_);
        all_.is_stopped_ = false;
        return is_first_done;
    }
    TeamOrder order(const TeamOrder& own) override {
        return all_.reported(rank_, own, all_.order_);
    }
    void add_up(std::vector<std::int64_t>& numbers) override {
        if (rank_ == 0) {
            all_.total_.assign(numbers.size(), 0);
        }
        all_.barrier_.arrive_and_wait();
        {
            const std::lock_guard lock(all_.mutex_);
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                all_.total_[i] += numbers[i];
            }
        }
        all_.barrier_.arrive_and_wait();
        if (rank_ == 0) {
            numbers = all_.total_;
        }
    }
    void share_bytes(std::string& /*bytes*/) override { ADD_FAILURE() << "no file is read"; }
    void send(std::string_view bytes) override {
        const std::lock_guard lock(all_.mutex_);
        all_.sent_[rank_].emplace_back(bytes);
    }
    [[nodiscard]] std::string receive(std::uint64_t from, const std::stop_token& stop) override {
        while (true) {
            if (stop.stop_requested()) {
                throw Stopped(StopReason::interrupted, "");
            }
            std::this_thread::yield();
            const std::lock_guard lock(all_.mutex_);
            if (!all_.sent_[from].empty()) {
                std::string bytes = std::move(all_.sent_[from].front());
                all_.sent_[from].pop_front();
                return bytes;
            }
        }
    }
    void stop() override { all_.is_stopped_ = true; }
    [[nodiscard]] bool is_stopped() override { return all_.is_stopped_; }
    void await_stop() override {
        while (!all_.is_stopped_) {
            std::this_thread::yield();
        }
    }

  private:
    Meeting& all_;
    unsigned rank_;
};

struct Day {
    Scene scene = leaf_over_ground();
    std::vector<TimeStep> time_steps;

    explicit Day(const std::vector<double>& elevations = {20, 50, 50, 80}) {
        for (const double elevation : elevations) {
            time_steps.push_back(
                {.name = "",
                 .sources = {sun(elevation, {1}), sky({1})},
                 .directional_key = std::to_string(elevation),
                 .seconds = 3600,
                 .day = 0});
        }
    }
};

/// How a team traces a day: every run together, or some runs in each process.
enum class Sharing { tasks, runs };

/// The work of another process, until the first has no more orders.
void help(RunTeam& team, const Day& day, const RunSpec& spec) {
    TeamHelper helper;
    TeamOrder order = team.order({});
    while (order.kind != TeamOrder::kEnd) {
        order = helper.help(day.scene, day.time_steps, spec, team, order);
        if (order.kind == TeamOrder::kDealt) {
            HelpedRuns runs(team);
            try {
                runs.trace(day.scene, day.time_steps, spec, order.time_step);
            } catch (const Stopped&) {  // by the first
            }
            runs.end();
            order = team.order({});
        }
    }
}

/// Stored states of runs, as bytes.
class RecordedRuns : public RunListener, public StoredStates {
  public:
    std::map<std::size_t, std::string> saved, finished;  // by time step
    std::size_t saves = 0, restored = 0;
    bool saves_rounds = true;

    [[nodiscard]] bool has_state(std::size_t time_step) const {
        return saved.contains(time_step) || finished.contains(time_step);
    }
    [[nodiscard]] std::optional<RunState> state_of(std::size_t time_step) override {
        restored += has_state(time_step) ? 1 : 0;
        const auto& from = finished.contains(time_step) ? finished : saved;
        return has_state(time_step) ? std::optional(load_state(from.at(time_step))) : std::nullopt;
    }
    [[nodiscard]] bool wants_pause() override { return saves_rounds; }
    void on_pause(const RunSoFar& run) override { on_round(run); }
    void on_round(const RunSoFar& run) override {
        if (saves_rounds) {
            saved[run.time_step()] = save_state(run.snapshot());
            ++saves;
        }
    }
    void on_last_round(const RunSoFar& run) override {
        if (!saves_rounds) {
            finished[run.time_step()] = save_state(run.snapshot());
        }
    }
};

/// Distributes the runs of a day to a team, from the first that was not stored.
class DealtDay final : public SumsSource {
  public:
    DealtDay(RunTeam& team, const Day& day, const RecordedRuns* kept)
        : team_(team), day_(day), cached_(kept) {}

    [[nodiscard]] std::optional<GivenSums> sums_of(
        std::size_t time_step, const RunSpec& spec, const RunControl& control) override {
        if (!dealt_ && cached_ != nullptr && cached_->has_state(time_step)) {
            return std::nullopt;
        }
        if (!dealt_) {
            dealt_.emplace(team_, 0, time_step);
        }
        return dealt_->next(
            simulator_, day_.scene, day_.time_steps[time_step].sources, spec, control);
    }

  private:
    RunTeam& team_;
    const Day& day_;
    const RecordedRuns* cached_;
    Simulator simulator_;
    std::optional<DealtRuns> dealt_;
};

/// The results of a day that a team of `size` processes traces.
std::vector<Result> trace_day(
    const Day& day,
    const RunSpec& spec,
    unsigned ranks,
    RecordedRuns* kept = nullptr,
    const std::stop_token& stop = {},
    Sharing sharing = Sharing::tasks) {
    Meeting meeting(ranks);
    std::vector<std::jthread> helpers;
    for (unsigned rank = 1; rank < ranks; ++rank) {
        helpers.emplace_back([&, rank] {
            Member member(meeting, rank);
            help(member, day, spec);
        });
    }
    Member team(meeting, 0);
    std::vector<Result> results;
    Listening events;
    events.time_step = [&](auto, const Result& result, auto) { results.push_back(result); };
    std::optional<DealtDay> dealt;
    RunControl control{
        .stop = stop, .listeners = {&events}, .origin = {.states = kept, .team = &team}};
    if (kept != nullptr) {
        control.listeners.push_back(kept);
    }
    if (sharing == Sharing::runs) {
        control.origin.given = &dealt.emplace(team, day, kept);
    }
    const auto end = [&] {
        dealt.reset();
        static_cast<void>(team.order({.kind = TeamOrder::kEnd}));
    };
    try {
        static_cast<void>(run_series(day.scene, day.time_steps, spec, control));
    } catch (const Stopped&) {
        end();
        throw;
    }
    end();
    return results;
}

void expect_equal_days(const std::vector<Result>& a, const std::vector<Result>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(a[i].rays, b[i].rays);
        EXPECT_EQ(a[i].paths, b[i].paths);
        EXPECT_TRUE(std::equal(
            a[i].values.begin(), a[i].values.end(), b[i].values.begin(), b[i].values.end(),
            [](const Estimate& x, const Estimate& y) {
                return x.mean == y.mean && x.ci95_low == y.ci95_low && x.ci95_high == y.ci95_high;
            }));
    }
}

std::vector<Result> day_alone(const Day& day, const RunSpec& spec) {
    std::vector<Result> results;
    Listening events;
    events.time_step = [&](auto, const Result& result, auto) { results.push_back(result); };
    static_cast<void>(run_series(day.scene, day.time_steps, spec, {.listeners = {&events}}));
    return results;
}

class RunTeams : public ::testing::TestWithParam<Method> {
  protected:
    [[nodiscard]] static RunSpec spec() {
        RunSpec spec = spec_of(GetParam(), 1U << 14U);
        spec.replicates = 3;
        spec.max_paths = 2 * spec.paths;
        spec.threads = 1;
        return spec;
    }
};

TEST_P(RunTeams, GiveTheBitsOfOneProcess) {
    const Day day;
    const std::vector<Result> alone = day_alone(day, spec());
    for (const unsigned ranks : {1U, 3U, 4U}) {
        expect_equal_days(trace_day(day, spec(), ranks), alone);
    }
}

TEST_P(RunTeams, KeepRoundsThatOthersGoOnFrom) {
    const Day day;
    RecordedRuns kept;
    const std::vector<Result> alone = day_alone(day, spec());
    expect_equal_days(trace_day(day, spec(), 3, &kept), alone);
    ASSERT_GE(kept.saves, 3U);
    kept.saves_rounds = false;
    expect_equal_days(trace_day(day, spec(), 2, &kept), alone);
    EXPECT_EQ(kept.restored, 3U);
}

TEST_P(RunTeams, TraceRunsEachByItselfToTheSameBits) {
    const Day day;
    RunSpec spec = RunTeams::spec();
    spec.max_paths = 0;
    const std::vector<Result> alone = day_alone(day, spec);
    for (const unsigned ranks : {2U, 3U, 5U}) {
        expect_equal_days(trace_day(day, spec, ranks, nullptr, {}, Sharing::runs), alone);
    }
}

TEST_P(RunTeams, KeepRunsThatOthersHaveTracedAndGoOnFromThem) {
    const Day day;
    RunSpec spec = RunTeams::spec();
    spec.max_paths = 0;
    RecordedRuns kept;
    kept.saves_rounds = false;
    const std::vector<Result> alone = day_alone(day, spec);
    expect_equal_days(trace_day(day, spec, 3, &kept, {}, Sharing::runs), alone);
    ASSERT_EQ(kept.finished.size(), 3U) << "one of the four is like another";
    EXPECT_EQ(kept.restored, 0U);
    kept.finished.erase(3);
    expect_equal_days(trace_day(day, spec, 1, &kept, {}, Sharing::runs), alone);
    EXPECT_EQ(kept.restored, 2U);
    EXPECT_EQ(kept.finished.size(), 3U);
    // More paths than before, of those that are there and of one that is not.
    kept.finished.erase(3);
    spec.max_paths = 2 * spec.paths;
    expect_equal_days(trace_day(day, spec, 2, &kept), day_alone(day, spec));
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    RunTeams,
    ::testing::Values(Method::light_tracing, Method::from_organs, Method::first_hits));

TEST(RunTeam, ReportsTheProcessorTimeOfAll) {
    const Day day;
    RunSpec spec = spec_of(Method::light_tracing, 1U << 16U);
    spec.threads = 1;
    const Stopwatch watch;
    double reported = 0;
    for (const Result& result : trace_day(day, spec, 3)) {
        reported += result.solve_cpu_seconds;
    }
    // All processes are threads of one here, and each reports the time of all.
    EXPECT_GT(reported, 1.5 * watch.cpu_seconds());
}

TEST(RunTeam, StopsWhenTheFirstIsStopped) {
    const Day day;
    RunSpec spec = spec_of(Method::light_tracing, 1U << 28U);
    std::stop_source source;
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        source.request_stop();
    });
    const std::vector<Result> results = trace_day(day, spec, 3, nullptr, source.get_token());
    ASSERT_EQ(results.size(), 1U);
    EXPECT_EQ(results[0].stop, StopReason::interrupted);
}

TEST(RunTeam, StopsRunsThatItTracesEachByItself) {
    const Day day;
    const RunSpec spec = spec_of(Method::light_tracing, 1U << 28U);
    std::stop_source source;
    std::jthread later([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(300));
        source.request_stop();
    });
    EXPECT_THROW(trace_day(day, spec, 3, nullptr, source.get_token(), Sharing::runs), Stopped);
}

TEST(AddUp, IsExactForLargeSumsOfEitherSign) {
    constexpr std::int64_t kLarge = ExactBins::kCarry - 3;
    const std::vector<std::int64_t> values{kLarge, -kLarge, 5, -7, 0, kLarge, -1};
    ExactBins expected(values.size());
    Meeting meeting(5);
    const auto bins_of = [&](unsigned rank) {
        Sums sums;
        sums->replicates = {ExactBins(values.size())};
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (unsigned times = 0; times <= rank; ++times) {
                sums->replicates[0].add(i, i % 2 == 0 ? values[i] : values[i] / (rank + 1));
            }
        }
        return sums;
    };
    std::vector<std::jthread> others;
    for (unsigned rank = 0; rank < 5; ++rank) {
        expected += bins_of(rank)->replicates[0];
        if (rank > 0) {
            others.emplace_back([&, rank] {
                Sums own = bins_of(rank);
                Member member(meeting, rank);
                add_up(member, own);
            });
        }
    }
    Sums first = bins_of(0);
    Member member(meeting, 0);
    add_up(member, first);
    EXPECT_EQ(first->replicates[0], expected);
}

}  // namespace
}  // namespace quasimc::test
