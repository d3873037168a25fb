// How runs are dealt to processes that trace them each by itself.

#include "run/team_jobs.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <map>
#include <vector>

#include <gtest/gtest.h>

namespace quasimc::test {
namespace {

std::vector<TeamRun> equal_runs(std::uint64_t count, std::uint64_t most_parts) {
    std::vector<TeamRun> runs;
    for (std::uint64_t i = 0; i < count; ++i) {
        runs.push_back({i, 1, most_parts});
    }
    return runs;
}

/// When all processes are done if each takes the next job as soon as it is free.
double end_of(const std::vector<TeamJob>& jobs, std::size_t processes) {
    std::vector<double> busy_until(processes);
    for (const TeamJob& job : jobs) {
        *std::min_element(busy_until.begin(), busy_until.end()) += job.cost;
    }
    return *std::max_element(busy_until.begin(), busy_until.end());
}

TEST(CutJobs, HaveEveryPartOfEveryRunOnceAndInOrder) {
    for (const std::uint64_t processes : {1U, 2U, 3U, 16U}) {
        const std::vector<TeamJob> jobs = cut_jobs(equal_runs(17, 8), processes);
        std::uint64_t run = 0;
        for (std::size_t i = 0; i < jobs.size(); ++run) {
            const std::uint64_t parts = jobs[i].parts;
            for (std::uint64_t part = 1; part <= parts; ++part, ++i) {
                ASSERT_LT(i, jobs.size());
                EXPECT_EQ(jobs[i], (TeamJob{run, part, parts, 1 / static_cast<double>(parts)}));
            }
        }
        EXPECT_EQ(run, 17U);
    }
}

TEST(CutJobs, LeaveRunsWholeWhileManyAreLeftAndCutTheLast) {
    const std::vector<TeamJob> jobs = cut_jobs(equal_runs(100, 8), 4);
    EXPECT_EQ(jobs[80].parts, 1U);
    EXPECT_EQ(jobs[80].run, 80U);
    EXPECT_EQ(jobs.back().parts, 8U);
    for (const TeamJob& job : cut_jobs(equal_runs(100, 1), 4)) {
        EXPECT_EQ(job.parts, 1U);
    }
}

TEST(CutJobs, KeepAllProcessesAtWorkToTheEnd) {
    for (const std::uint64_t runs : {3U, 13U, 17U}) {
        const double ideal = static_cast<double>(runs) / 2;
        EXPECT_LT(end_of(cut_jobs(equal_runs(runs, 8), 2), 2), 1.05 * ideal) << runs;
    }
    EXPECT_GT(end_of(cut_jobs(equal_runs(3, 1), 2), 2), 1.3 * 1.5) << "whole runs can't";
}

TEST(JobsOfSeries, AreOfTracesAloneAndOnlyWhereTheyAreWorthIt) {
    std::vector<TimeStepPlan> plans(6);
    for (std::size_t i = 0; i < plans.size(); ++i) {
        plans[i].traced = i;
    }
    plans[1].factor = 0;  // dark
    plans[4].traced = 3;
    const RunSpec spec;
    std::map<std::uint64_t, int> runs;
    for (const TeamJob& job : jobs_of_series(plans, spec, 0, 2)) {
        ++runs[job.run];
    }
    EXPECT_EQ(runs.size(), 4U);
    EXPECT_FALSE(runs.contains(1) || runs.contains(4));
    EXPECT_EQ(jobs_of_series(plans, spec, 3, 2).front().run, 3U);
    EXPECT_TRUE(jobs_of_series(plans, spec, 0, 1).empty());
    EXPECT_TRUE(jobs_of_series(plans, spec, 0, 5).empty());
    EXPECT_TRUE(jobs_of_series(plans, spec, 5, 2).empty());
    RunSpec timed;
    timed.max_seconds = 1;
    EXPECT_TRUE(jobs_of_series(plans, timed, 0, 2).empty());
    RunSpec rounds;
    rounds.target_error = 0.1;
    for (const TeamJob& job : jobs_of_series(plans, rounds, 0, 2)) {
        EXPECT_EQ(job.parts, 1U) << "a target is of a whole run";
    }
}

TEST(JobQueue, GivesEveryJobToOneMachineAndInOrder) {
    const std::vector<TeamJob> jobs = cut_jobs(equal_runs(20, 8), 6);
    std::vector<int> given(jobs.size());
    std::vector<double> costs;
    for (std::uint64_t machine = 0; machine < 3; ++machine) {
        std::atomic<std::uint64_t> counter{0};
        RunTeam team;
        team.machine = machine;
        team.machines = 3;
        team.tasks.begin = [&](std::uint64_t begin, std::uint64_t end) {
            const auto [first, last] = share_of(machine + 1, 3).range(end - begin);
            counter = begin + first;
            return TaskRange{&counter, begin + last, false};
        };
        JobQueue queue(team, jobs);
        costs.push_back(0);
        std::size_t last = 0;
        while (const auto job = queue.next()) {
            EXPECT_GE(*job, last);
            last = *job;
            ++given[*job];
            costs.back() += jobs[*job].cost;
        }
        EXPECT_FALSE(queue.next().has_value());
    }
    EXPECT_EQ(std::count(given.begin(), given.end(), 1), static_cast<int>(jobs.size()));
    EXPECT_LT(*std::max_element(costs.begin(), costs.end()), 1.2 * 20 / 3);
}

}  // namespace
}  // namespace quasimc::test
