#include "run/team_jobs.h"

#include <algorithm>
#include <iterator>

namespace quasimc {
namespace {

/// What is left should be so many jobs for each process, or more.
constexpr double kJobsPerProcess = 2;
/// A part repeats what a run prepares, and its sums are sent.
constexpr std::uint64_t kMostParts = 8;

/// The jobs of each machine: each goes to the one that has least to do.
std::vector<std::vector<std::size_t>> deal(
    const std::vector<TeamJob>& jobs, std::uint64_t machines) {
    std::vector<std::vector<std::size_t>> dealt(machines);
    std::vector<double> costs(machines);
    for (std::size_t i = 0; i < jobs.size(); ++i) {
        const auto least = std::min_element(costs.begin(), costs.end());
        *least += jobs[i].cost;
        dealt[static_cast<std::size_t>(std::distance(costs.begin(), least))].push_back(i);
    }
    return dealt;
}

}  // namespace

std::vector<TeamJob> cut_jobs(const std::vector<TeamRun>& runs, std::uint64_t processes) {
    double left = 0;
    for (const TeamRun& run : runs) {
        left += run.cost;
    }
    std::vector<TeamJob> jobs;
    for (const TeamRun& run : runs) {
        const double largest = left / (kJobsPerProcess * static_cast<double>(processes));
        std::uint64_t parts = 1;
        while (2 * parts <= run.most_parts && run.cost / static_cast<double>(parts) > largest) {
            parts *= 2;
        }
        for (std::uint64_t part = 1; part <= parts; ++part) {
            jobs.push_back({run.run, part, parts, run.cost / static_cast<double>(parts)});
        }
        left -= run.cost;
    }
    return jobs;
}

bool is_one_round(const RunSpec& spec) {
    return spec.target_error == 0 && spec.max_paths == 0 && spec.max_seconds == 0;
}

std::vector<TeamJob> jobs_of_series(
    const std::vector<TimeStepPlan>& plans,
    const RunSpec& spec,
    std::size_t first,
    std::uint64_t processes) {
    const std::uint64_t most_parts = is_one_round(spec) ? kMostParts : 1;
    std::vector<TeamRun> runs;
    for (std::size_t i = first; i < plans.size(); ++i) {
        if (plans[i].factor > 0 && plans[i].traced == i) {
            runs.push_back({i, plans[i].effort, most_parts});
        }
    }
    const bool is_worth_it = processes > 1 && runs.size() >= processes && spec.max_seconds == 0;
    return is_worth_it ? cut_jobs(runs, processes) : std::vector<TeamJob>();
}

JobQueue::JobQueue(const RunTeam& team, const std::vector<TeamJob>& jobs) {
    std::vector<std::vector<std::size_t>> dealt = deal(jobs, team.machines);
    std::size_t most = 0;
    for (const auto& machine : dealt) {
        most = std::max(most, machine.size());
    }
    // Equal shares of so many numbers: the range of this machine, from which its processes take.
    range_ = team.tasks.begin(0, team.machines * most);
    first_ = range_.end - most;
    own_ = std::move(dealt[team.machine]);
}

std::optional<std::size_t> JobQueue::next() {
    const std::uint64_t taken = range_.next->fetch_add(1) - first_;
    return taken < own_.size() ? std::optional(own_[taken]) : std::nullopt;
}

}  // namespace quasimc
