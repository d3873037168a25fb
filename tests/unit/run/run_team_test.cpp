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

namespace quasimc::test {
namespace {

/// What the processes of a team share.
class Meeting {
  public:
    explicit Meeting(unsigned size) : size_(size), barrier_(size) {}

    /// The team as one of them sees it.
    [[nodiscard]] RunTeam seen_by(unsigned rank) {
        RunTeam team;
        team.rank = rank;
        team.size = size_;
        team.tasks.share = share_of(rank + 1, size_);
        team.tasks.meet = [=, this](bool is_done) {
            is_stopped_ = is_stopped_ || (rank == 0 && !is_done);
            const bool is_first_done = told(rank, is_done, met_);
            is_stopped_ = false;
            return is_first_done;
        };
        team.order = [=, this](const TeamOrder& own) { return told(rank, own, order_); };
        team.add_up = [=, this](std::vector<std::int64_t>& numbers) { add_up(rank, numbers); };
        team.send = [=, this](std::string_view bytes) {
            const std::lock_guard lock(mutex_);
            sent_[rank].emplace_back(bytes);
        };
        team.receive = [this](std::uint64_t from, const std::stop_token& stop) {
            return receive(from, stop);
        };
        team.stop = [this] { is_stopped_ = true; };
        team.is_stopped = [this] { return is_stopped_.load(); };
        team.await_stop = [this] {
            while (!is_stopped_) {
                std::this_thread::yield();
            }
        };
        return team;
    }

  private:
    [[nodiscard]] std::string receive(std::uint64_t from, const std::stop_token& stop) {
        while (true) {
            if (stop.stop_requested()) {
                throw Stopped(StopReason::interrupted, "");
            }
            std::this_thread::yield();
            const std::lock_guard lock(mutex_);
            if (!sent_[from].empty()) {
                std::string bytes = std::move(sent_[from].front());
                sent_[from].pop_front();
                return bytes;
            }
        }
    }

    /// What the first has to say.
    template <typename T>
    T told(unsigned rank, const T& own, T& place) {
        if (rank == 0) {
            place = own;
        }
        barrier_.arrive_and_wait();
        const T told = place;
        barrier_.arrive_and_wait();
        return told;
    }
    void add_up(unsigned rank, std::vector<std::int64_t>& numbers) {
        if (rank == 0) {
            total_.assign(numbers.size(), 0);
        }
        barrier_.arrive_and_wait();
        {
            const std::lock_guard lock(mutex_);
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                total_[i] += numbers[i];
            }
        }
        barrier_.arrive_and_wait();
        if (rank == 0) {
            numbers = total_;
        }
    }

    unsigned size_;
    std::barrier<> barrier_;
    bool met_ = true;
    TeamOrder order_;
    std::mutex mutex_;
    std::map<std::uint64_t, std::deque<std::string>> sent_;  // by whom
    std::atomic<bool> is_stopped_{false};
    std::vector<std::int64_t> total_;
};

struct Day {
    Scene scene = leaf_over_ground();
    std::vector<TimeStep> moments;

    explicit Day(const std::vector<double>& elevations = {20, 50, 50, 80}) {
        for (const double elevation : elevations) {
            moments.push_back(
                {.name = "",
                 .sources = {sun(elevation, {1}), sky({1})},
                 .shapes = std::to_string(elevation),
                 .seconds = 3600,
                 .day = 0});
        }
    }
};

/// How a team traces a day: every run together, or each process some of them.
enum class Sharing { tasks, runs };

/// What another process does, until the first has no more orders.
void help(const RunTeam& team, const Day& day, const RunSpec& spec) {
    TeamHelper helper;
    TeamOrder order = team.order({});
    while (order.kind != TeamOrder::kEnd) {
        order = helper.help(day.scene, day.moments, spec, team, order);
        if (order.kind == TeamOrder::kDealt) {
            HelpedRuns runs(team);
            try {
                runs.trace(day.scene, day.moments, spec, order.moment);
            } catch (const Stopped&) {  // by the first
            }
            runs.end();
            order = team.order({});
        }
    }
}

/// The results of a day that a team of so many processes traces.
std::vector<Result> trace_day(
    const Day& day,
    const RunSpec& spec,
    unsigned ranks,
    const RunCheckpoint* checkpoint = nullptr,
    const std::stop_token& stop = {},
    Sharing sharing = Sharing::tasks) {
    Meeting meeting(ranks);
    std::vector<std::jthread> helpers;
    for (unsigned rank = 1; rank < ranks; ++rank) {
        helpers.emplace_back([&, rank] { help(meeting.seen_by(rank), day, spec); });
    }
    const RunTeam team = meeting.seen_by(0);
    std::vector<Result> results;
    SeriesEvents events;
    events.on_time_step = [&](auto, const Result& result, auto) { results.push_back(result); };
    events.checkpoint = checkpoint;
    events.team = &team;
    Simulator simulator;
    std::optional<DealtRuns> dealt;
    if (sharing == Sharing::runs) {
        events.sums_of = [&](std::size_t i, const RunSpec& own,
                             const RunControl& control) -> std::optional<GivenSums> {
            if (!dealt && checkpoint != nullptr && checkpoint->has_state(i)) {
                return std::nullopt;
            }
            if (!dealt) {
                dealt.emplace(team, 0, i);
            }
            return dealt->next(simulator, day.scene, day.moments[i].sources, own, control);
        };
    }
    const auto end = [&] {
        dealt.reset();
        static_cast<void>(team.order({.kind = TeamOrder::kEnd}));
    };
    try {
        static_cast<void>(run_series(day.scene, day.moments, spec, events, stop));
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
                return x.mean == y.mean && x.low == y.low && x.high == y.high;
            }));
    }
}

std::vector<Result> day_alone(const Day& day, const RunSpec& spec) {
    std::vector<Result> results;
    SeriesEvents events;
    events.on_time_step = [&](auto, const Result& result, auto) { results.push_back(result); };
    static_cast<void>(run_series(day.scene, day.moments, spec, events));
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
    std::vector<std::pair<std::size_t, std::string>> saved;
    RunCheckpoint checkpoint;
    checkpoint.state_of = [&](std::size_t moment) {
        const auto state = std::find_if(
            saved.begin(), saved.end(), [&](const auto& each) { return each.first == moment; });
        return state == saved.end() ? std::nullopt : std::optional(load_state(state->second));
    };
    checkpoint.has_state = [&](std::size_t moment) {
        return std::any_of(
            saved.begin(), saved.end(), [&](const auto& each) { return each.first == moment; });
    };
    checkpoint.is_due = [] { return true; };
    checkpoint.save = [&](std::size_t moment, const RunSnapshot& state) {
        saved.emplace_back(moment, save_state(state));
    };
    checkpoint.finish = [](std::size_t, const RunSnapshot&) {};
    const std::vector<Result> paused = trace_day(day, spec(), 3, &checkpoint);
    const std::vector<Result> alone = day_alone(day, spec());
    expect_equal_days(paused, alone);
    ASSERT_GE(saved.size(), 3U);
    std::reverse(saved.begin(), saved.end());  // the last of each moment
    checkpoint.is_due = [] { return false; };
    expect_equal_days(trace_day(day, spec(), 2, &checkpoint), alone);
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
    std::map<std::size_t, std::string> kept;
    std::size_t restored = 0;
    RunCheckpoint checkpoint;
    checkpoint.has_state = [&](std::size_t moment) { return kept.contains(moment); };
    checkpoint.state_of = [&](std::size_t moment) {
        restored += kept.contains(moment) ? 1 : 0;
        return kept.contains(moment) ? std::optional(load_state(kept[moment])) : std::nullopt;
    };
    checkpoint.is_due = [] { return false; };
    checkpoint.save = [](std::size_t, const RunSnapshot&) {};
    checkpoint.finish = [&](std::size_t moment, const RunSnapshot& state) {
        kept[moment] = save_state(state);
    };
    const std::vector<Result> alone = day_alone(day, spec);
    expect_equal_days(trace_day(day, spec, 3, &checkpoint, {}, Sharing::runs), alone);
    ASSERT_EQ(kept.size(), 3U) << "one of the four is like another";
    EXPECT_EQ(restored, 0U);
    kept.erase(3);
    expect_equal_days(trace_day(day, spec, 1, &checkpoint, {}, Sharing::runs), alone);
    EXPECT_EQ(restored, 2U);
    EXPECT_EQ(kept.size(), 3U);
    // More paths than before, of those that are there and of one that is not.
    kept.erase(3);
    spec.max_paths = 2 * spec.paths;
    expect_equal_days(trace_day(day, spec, 2, &checkpoint), day_alone(day, spec));
}

INSTANTIATE_TEST_SUITE_P(
    EveryMethod,
    RunTeams,
    ::testing::Values(Method::light_tracing, Method::from_organs, Method::first_hits));

TEST(RunTeam, TellsTheProcessorTimeOfAll) {
    const Day day;
    RunSpec spec = spec_of(Method::light_tracing, 1U << 18U);
    spec.threads = 1;
    const Stopwatch watch;
    double told = 0;
    for (const Result& result : trace_day(day, spec, 3)) {
        told += result.trace_cpu_seconds;
    }
    // Here all are threads of one process, and each tells the time of all.
    EXPECT_GT(told, 1.5 * watch.cpu_seconds());
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
                add_up(meeting.seen_by(rank), own);
            });
        }
    }
    Sums first = bins_of(0);
    add_up(meeting.seen_by(0), first);
    EXPECT_EQ(first->replicates[0], expected);
}

}  // namespace
}  // namespace quasimc::test
