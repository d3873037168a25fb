// Runs that several processes trace together; here each is a thread.

#include "run/run_team.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <barrier>
#include <cstdint>
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
#include "run/run_state.h"
#include "statistical/scenes.h"

namespace quasimc::test {
namespace {

/// What the processes of a team share.
class Meeting {
  public:
    explicit Meeting(unsigned size) : barrier_(size) {}

    /// The team as one of them sees it; each node has a counter.
    [[nodiscard]] RunTeam seen_by(unsigned rank, unsigned nodes) {
        RunTeam team;
        team.is_first = rank == 0;
        team.machine = rank % nodes;
        team.machines = nodes;
        set_mail(rank, team.mail);
        team.tasks.begin = [=, this](std::uint64_t begin, std::uint64_t end) {
            const unsigned node = rank % nodes;
            const auto [first, last] = share_of(node + 1, nodes).range(end - begin);
            if (rank < nodes) {
                counters_[node] = begin + first;
            }
            barrier_.arrive_and_wait();
            return TaskRange{&counters_[node], begin + last, nodes == 1};
        };
        team.tasks.meet = [=, this](std::uint64_t own) { return told(rank, own, met_); };
        team.order = [=, this](const TeamOrder& own) { return told(rank, own, order_); };
        team.add_up = [=, this](std::vector<std::int64_t>& numbers) { add_up(rank, numbers); };
        return team;
    }

  private:
    void set_mail(unsigned rank, TeamMail& mail) {
        mail.send = [this](std::uint64_t number, std::string_view bytes) {
            const std::lock_guard lock(mutex_);
            mail_.emplace(number, bytes);  // behind what has the same number
        };
        mail.has_arrived = [] { return true; };
        mail.receive = [this](std::uint64_t number) -> std::optional<std::string> {
            const std::lock_guard lock(mutex_);
            const auto first = mail_.lower_bound(number);
            // What came of a job waits until its states were received.
            const bool is_held = number % 2 == 0 && mail_.contains(number + 1);
            if (first == mail_.end() || first->first != number || is_held) {
                return std::nullopt;
            }
            return mail_.extract(first).mapped();
        };
        mail.close = [this] { is_closed_ = true; };
        mail.is_closed = [this] { return is_closed_.load(); };
        mail.end = [this, rank] {
            barrier_.arrive_and_wait();
            if (rank == 0) {
                mail_.clear();
                is_closed_ = false;
            }
            barrier_.arrive_and_wait();
        };
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

    std::barrier<> barrier_;
    std::array<std::atomic<std::uint64_t>, 8> counters_{};
    std::uint64_t met_ = 0;
    TeamOrder order_;
    std::mutex mutex_;
    std::multimap<std::uint64_t, std::string> mail_;
    std::atomic<bool> is_closed_{false};
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

/// How a team traces a day: every run together, or runs each by itself, also with their states sent
/// after each task.
enum class Sharing { tasks, runs, runs_with_states };

/// The results of a day that a team of so many processes traces.
std::vector<Result> trace_day(
    const Day& day,
    const RunSpec& spec,
    unsigned ranks,
    unsigned nodes,
    const RunCheckpoint* checkpoint = nullptr,
    const std::stop_token& stop = {},
    Sharing sharing = Sharing::tasks) {
    Meeting meeting(ranks);
    const auto seen_by = [&](unsigned rank) {
        RunTeam team = meeting.seen_by(rank, nodes);
        // A team of one has nobody to give runs to.
        team.size = sharing != Sharing::tasks ? ranks : 1;
        if (sharing == Sharing::runs_with_states) {
            team.keep_every = 0;
        }
        return team;
    };
    std::vector<std::jthread> helpers;
    for (unsigned rank = 1; rank < ranks; ++rank) {
        helpers.emplace_back([&, rank] {
            const RunTeam team = seen_by(rank);
            TeamHelper helper;
            TeamOrder order = team.order({});
            while (order.is_end == 0) {
                order = helper.help(day.scene, day.moments, spec, team, order);
            }
        });
    }
    const RunTeam team = seen_by(0);
    std::vector<Result> results;
    SeriesEvents events;
    events.on_time_step = [&](auto, const Result& result, auto) { results.push_back(result); };
    events.checkpoint = checkpoint;
    events.team = &team;
    try {
        static_cast<void>(run_series(day.scene, day.moments, spec, events, stop));
    } catch (const Stopped&) {
        static_cast<void>(team.order({.is_end = 1}));
        throw;
    }
    static_cast<void>(team.order({.is_end = 1}));
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
    for (const auto& [ranks, nodes] :
         std::vector<std::pair<unsigned, unsigned>>{{1, 1}, {3, 1}, {4, 2}}) {
        expect_equal_days(trace_day(day, spec(), ranks, nodes), alone);
    }
}

TEST_P(RunTeams, PauseForCheckpointsThatOthersGoOnFrom) {
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
    const std::vector<Result> paused = trace_day(day, spec(), 3, 1, &checkpoint);
    const std::vector<Result> alone = day_alone(day, spec());
    expect_equal_days(paused, alone);
    ASSERT_GE(saved.size(), 3U);
    std::reverse(saved.begin(), saved.end());  // the last of each moment
    checkpoint.is_due = [] { return false; };
    expect_equal_days(trace_day(day, spec(), 2, 1, &checkpoint), alone);
}

TEST_P(RunTeams, TraceRunsEachByItselfToTheSameBits) {
    const Day day;
    RunSpec one_round = spec();
    one_round.max_paths = 0;  // so that runs are cut into parts as well
    RunSpec target = spec();
    target.target_error = 1e-3;
    for (const RunSpec& spec : {one_round, spec(), target}) {
        const std::vector<Result> alone = day_alone(day, spec);
        for (const auto& [ranks, nodes] :
             std::vector<std::pair<unsigned, unsigned>>{{2, 1}, {3, 1}, {3, 3}}) {
            const std::vector<Result> shared =
                trace_day(day, spec, ranks, nodes, nullptr, {}, Sharing::runs);
            expect_equal_days(shared, alone);
            for (std::size_t i = 0; i < shared.size(); ++i) {
                EXPECT_EQ(shared[i].stop, alone[i].stop);
                EXPECT_EQ(shared[i].fraction_at_target, alone[i].fraction_at_target);
            }
        }
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
    expect_equal_days(trace_day(day, spec, 3, 1, &checkpoint, {}, Sharing::runs), alone);
    ASSERT_EQ(kept.size(), 3U) << "one of the four is like another";
    EXPECT_EQ(restored, 0U);
    kept.erase(3);
    expect_equal_days(trace_day(day, spec, 1, 1, &checkpoint, {}, Sharing::runs), alone);
    EXPECT_EQ(restored, 2U);
    EXPECT_EQ(kept.size(), 3U);
    // More paths than before, of those that are there and of one that is not.
    kept.erase(3);
    spec.max_paths = 2 * spec.paths;
    expect_equal_days(
        trace_day(day, spec, 2, 1, &checkpoint, {}, Sharing::runs), day_alone(day, spec));
}

TEST_P(RunTeams, KeepWhatIsDoneOfRunsThatAreTracedElsewhere) {
    const Day day({20, 30, 40, 50, 60, 70, 80, 85});  // so many that some are not cut into parts
    for (const std::uint64_t max_paths : {std::uint64_t{0}, spec().max_paths}) {
        RunSpec spec = RunTeams::spec();
        spec.max_paths = max_paths;
        std::map<std::size_t, std::string> kept;  // the first of each moment: little is done
        RunCheckpoint checkpoint;
        checkpoint.has_state = [](std::size_t) { return false; };
        checkpoint.state_of = [](std::size_t) { return std::nullopt; };
        checkpoint.is_due = [] { return true; };
        checkpoint.save = [&](std::size_t moment, const RunSnapshot& state) {
            kept.emplace(moment, save_state(state));
        };
        checkpoint.finish = [](std::size_t, const RunSnapshot&) {};
        checkpoint.keep = [&](std::size_t moment, std::string state) {
            kept.emplace(moment, std::move(state));
        };
        checkpoint.flush = [] {};
        const std::vector<Result> alone = day_alone(day, spec);
        expect_equal_days(
            trace_day(day, spec, 2, 1, &checkpoint, {}, Sharing::runs_with_states), alone);
        ASSERT_FALSE(kept.empty());
        double paths_before = 0;
        checkpoint.is_due = [] { return false; };
        checkpoint.has_state = [&](std::size_t moment) { return kept.contains(moment); };
        checkpoint.state_of = [&](std::size_t moment) {
            return kept.contains(moment) ? std::optional(load_state(kept[moment])) : std::nullopt;
        };
        const std::vector<Result> resumed =
            trace_day(day, spec, 3, 1, &checkpoint, {}, Sharing::runs);
        expect_equal_days(resumed, alone);
        for (const Result& result : resumed) {
            paths_before += result.paths_before;
        }
        EXPECT_GT(paths_before, 0);
    }
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
    for (const Result& result : trace_day(day, spec, 3, 1)) {
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
    const std::vector<Result> results = trace_day(day, spec, 3, 1, nullptr, source.get_token());
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
    EXPECT_THROW(trace_day(day, spec, 3, 1, nullptr, source.get_token(), Sharing::runs), Stopped);
}

TEST(AddUp, IsExactForLargeSumsOfEitherSign) {
    constexpr std::int64_t kLarge = ExactBins::kCarry - 3;
    const std::vector<std::int64_t> values{kLarge, -kLarge, 5, -7, 0, kLarge, -1};
    ExactBins expected(values.size());
    Meeting meeting(5);
    const auto bins_of = [&](unsigned rank) {
        Sums sums;
        sums.replicates = {ExactBins(values.size())};
        for (std::size_t i = 0; i < values.size(); ++i) {
            for (unsigned times = 0; times <= rank; ++times) {
                sums.replicates[0].add(i, i % 2 == 0 ? values[i] : values[i] / (rank + 1));
            }
        }
        return sums;
    };
    std::vector<std::jthread> others;
    for (unsigned rank = 0; rank < 5; ++rank) {
        expected += bins_of(rank).replicates[0];
        if (rank > 0) {
            others.emplace_back([&, rank] {
                Sums own = bins_of(rank);
                add_up(meeting.seen_by(rank, 1), own);
            });
        }
    }
    Sums first = bins_of(0);
    add_up(meeting.seen_by(0, 1), first);
    EXPECT_EQ(first.replicates[0], expected);
}

}  // namespace
}  // namespace quasimc::test
