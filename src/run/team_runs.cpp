#include "run/team_runs.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <stdexcept>
#include <stop_token>
#include <string_view>
#include <thread>
#include <utility>

#include "base/process_time.h"
#include "run/run_state.h"
#include "run/trace_spec.h"

namespace quasimc {
namespace {

/// Before what a process of a team sends of a job.
struct JobHead {
    std::uint64_t has_sums = 0, has_state = 0;
    double seconds = 0, cpu_seconds = 0;
    std::uint64_t replicates = 0;  ///< of sums: in all
    std::uint64_t first = 0;       ///< of those that follow
};

/// Jobs that the first process may trace before they are wanted: each keeps its sums.
constexpr std::size_t kMostAhead = 4;

bool is_empty(const ExactBins& bins) {
    for (std::size_t i = 0; i < bins.size(); ++i) {
        if (bins.steps(i) != ExactBins::Steps{}) {
            return false;
        }
    }
    return true;
}

/// Leaves out the replicates before and behind those that a part has traced.
/// @returns the number of the first that is left
std::uint64_t leave_out_empty(std::vector<ExactBins>& replicates) {
    const auto has_any = [](const ExactBins& bins) { return !is_empty(bins); };
    const auto first = std::find_if(replicates.begin(), replicates.end(), has_any);
    const auto last = std::find_if(replicates.rbegin(), replicates.rend(), has_any).base();
    const auto before = static_cast<std::uint64_t>(first - replicates.begin());
    replicates.erase(std::max(first, last), replicates.end());
    replicates.erase(replicates.begin(), replicates.begin() + static_cast<std::ptrdiff_t>(before));
    return before;
}

/// Puts them back, without light. @param first  of those that are there
void put_back_empty(std::uint64_t all, std::uint64_t first, Sums& sums) {
    if (first + sums.replicates.size() > all) {
        throw std::invalid_argument("a job has more replicates than its run");
    }
    std::vector<ExactBins> replicates(all, ExactBins(sums.layout.bins()));
    std::move(
        sums.replicates.begin(), sums.replicates.end(),
        replicates.begin() + static_cast<std::ptrdiff_t>(first));
    sums.replicates = std::move(replicates);
}

/// The state of a run of one round, whose parts are these.
RunState state_of(std::vector<TracedJob> parts, double seconds) {
    Sums sums = std::move(*parts.front().sums);
    for (std::size_t i = 1; i < parts.size(); ++i) {
        sums.add_share(*parts[i].sums);
    }
    RunState state;
    state.position.rounds.done = sums.paths;
    state.position.first_paths = state.position.asked_paths = sums.paths;
    state.position.rounds.pace.add(sums.paths, seconds);
    state.position.digest = sums.digest;
    state.done = std::move(sums);
    return state;
}

/// The last state of a run of several rounds; nothing if it was not traced.
std::optional<RunState> trace_rounds(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const RunControl& asked) {
    std::optional<RunState> last;
    const bool is_kept = asked.checkpoint != nullptr;
    RunCheckpoint keeper;
    keeper.state_of = [](std::size_t) { return std::nullopt; };
    keeper.has_state = [](std::size_t) { return false; };
    keeper.is_due = is_kept ? asked.checkpoint->is_due : [] { return false; };
    keeper.save = is_kept ? asked.checkpoint->save : [](std::size_t, const RunSnapshot&) {};
    keeper.is_state_enough = true;
    keeper.finish = [&](std::size_t, const RunSnapshot& state) {
        last = {state.position, *state.done, std::nullopt};
    };
    RunControl control{.on_progress = asked.on_progress, .stop = asked.stop};
    control.checkpoint = &keeper;
    control.moment = asked.moment;
    const Result result = simulator.run(scene, sources, spec, control);
    if (result.stop == StopReason::interrupted) {
        throw Stopped(StopReason::interrupted, "stopped before all rounds were traced");
    }
    return last;
}

/// Sends the states of runs to the first process, now and then.
class StateSender {
  public:
    explicit StateSender(const RunTeam& team) : team_(team) {
        // So that the first process gets no more than a few of them in this time.
        constexpr double kAtOnce = 16;
        const double all = static_cast<double>(team.size);
        every_ = std::chrono::duration<double>(
            team.keep_every.value_or(0) * std::max(1.0, all / kAtOnce));
        hooks_.is_due = [this] { return Clock::now() >= next_ && team_.mail.has_arrived(); };
        hooks_.save = [this](std::size_t, const RunSnapshot& state) {
            team_.mail.send(state_number(job_), save_state(state));
            begin_wait();
        };
    }

    /// For the run of a job; null if no states are asked for.
    [[nodiscard]] const RunCheckpoint* hooks_of(std::size_t job) {
        job_ = job;
        begin_wait();
        return team_.keep_every ? &hooks_ : nullptr;
    }

  private:
    using Clock = std::chrono::steady_clock;
    void begin_wait() {
        next_ = Clock::now() + std::chrono::duration_cast<Clock::duration>(every_);
    }

    const RunTeam& team_;
    RunCheckpoint hooks_;
    std::size_t job_ = 0;
    std::chrono::duration<double> every_{};
    Clock::time_point next_;
};

}  // namespace

std::string save_job(TracedJob job) {
    JobHead head{job.sums ? 1U : 0U, job.state ? 1U : 0U, job.seconds, job.cpu_seconds, 0, 0};
    std::string rest;
    if (job.sums) {
        head.replicates = job.sums->replicates.size();
        head.first = leave_out_empty(job.sums->replicates);
        rest = save_sums(*job.sums);
    } else if (job.state) {
        rest = save_state({job.state->position, &*job.state->done, nullptr});
    }
    std::string bytes(sizeof head, '\0');
    std::memcpy(bytes.data(), &head, sizeof head);
    return bytes.append(rest);
}

TracedJob load_job(std::string_view bytes) {
    JobHead head;
    if (bytes.size() < sizeof head) {
        throw std::invalid_argument("a job is cut off");
    }
    std::memcpy(&head, bytes.data(), sizeof head);
    const std::string_view rest = bytes.substr(sizeof head);
    TracedJob job;
    job.seconds = head.seconds;
    job.cpu_seconds = head.cpu_seconds;
    if (head.has_sums != 0) {
        job.sums = load_sums(rest);
        put_back_empty(head.replicates, head.first, *job.sums);
    } else if (head.has_state != 0) {
        job.state = load_state(rest);
    }
    return job;
}

TracedJob trace_job(
    Simulator& simulator,
    const Scene& scene,
    const Sources& sources,
    const RunSpec& asked,
    const TeamJob& job,
    const RunControl& control) {
    RunSpec spec = asked;
    spec.audit = 0;  // the first process audits
    TracedJob traced;
    if (spec.max_seconds > 0 || (job.parts > 1 && !is_one_round(spec))) {
        return traced;
    }
    const Stopwatch watch;
    try {
        const bool is_kept = control.checkpoint != nullptr && job.parts == 1;
        if (is_one_round(spec) && !is_kept) {
            const Share share = quasimc::share_of(job.part, job.parts);
            traced.sums = simulator.sums(scene, sources, spec, 0, share, control);
        } else {
            traced.state = trace_rounds(simulator, scene, sources, spec, control);
        }
    } catch (const InputError&) {  // the first process finds it as well, and reports it
        return traced;
    }
    traced.seconds = watch.seconds();
    traced.cpu_seconds = watch.cpu_seconds();
    return traced;
}

TraceJob series_tracer(
    Simulator& simulator,
    const Scene& scene,
    const std::vector<TimeStep>& time_steps,
    const std::vector<TimeStepPlan>& plans,
    const RunSpec& spec) {
    std::vector<std::uint64_t> traces_before{0};
    for (std::size_t i = 0; i < plans.size(); ++i) {
        const bool is_traced = plans[i].factor > 0 && plans[i].traced == i;
        traces_before.push_back(traces_before.back() + (is_traced ? 1 : 0));
    }
    return [&simulator, &scene, &time_steps, &plans, &spec, traces_before](
               const TeamJob& job, const RunControl& control) {
        const RunSpec own = trace_spec(spec, plans[job.run], traces_before[job.run]);
        return trace_job(simulator, scene, time_steps[job.run].sources, own, job, control);
    };
}

TeamRuns::TeamRuns(
    const RunTeam& team, const TeamOrder& order, std::vector<TeamJob> jobs, TraceJob trace)
    : team_(team),
      jobs_(std::move(jobs)),
      trace_(std::move(trace)),
      queue_((static_cast<void>(team.order(order)), JobQueue(team, jobs_))) {}

TeamRuns::~TeamRuns() {
    team_.mail.close();
    team_.mail.end();
}

std::optional<TracedRun> TeamRuns::take(std::uint64_t run, const RunControl& control) {
    std::vector<TracedJob> parts;
    TracedRun traced;
    double seconds = 0;
    run_ = run;
    while (next_ < jobs_.size() && jobs_[next_].run <= run) {
        TracedJob job = take_job(next_, control);
        if (jobs_[next_++].run == run) {
            seconds += job.seconds;
            traced.cpu_seconds += job.cpu_seconds;
            parts.push_back(std::move(job));
        }
    }
    const bool is_traced =
        std::all_of(parts.begin(), parts.end(), [](const auto& part) { return part.is_traced(); });
    if (parts.empty() || !is_traced) {
        return std::nullopt;
    }
    traced.state =
        parts.front().state ? std::move(*parts.front().state) : state_of(std::move(parts), seconds);
    return traced;
}

std::optional<TracedJob> TeamRuns::find(std::size_t job) {
    const auto own = own_.find(job);
    if (own == own_.end()) {
        const std::optional<std::string> bytes = team_.mail.receive(result_number(job));
        return bytes ? std::optional(load_job(*bytes)) : std::nullopt;
    }
    TracedJob traced = std::move(own->second);
    own_.erase(own);
    return traced;
}

TracedJob TeamRuns::take_job(std::size_t job, const RunControl& control) {
    using std::chrono::microseconds;
    constexpr microseconds kFirstPause{50}, kLongestPause{2000};
    microseconds pause = kFirstPause;
    while (true) {
        if (control.checkpoint != nullptr && control.checkpoint->is_due()) {
            keep_states(control);
            control.checkpoint->flush();
        }
        if (std::optional<TracedJob> traced = find(job)) {
            return std::move(*traced);
        }
        if (control.stop.stop_requested()) {
            throw Stopped(StopReason::interrupted, "stopped while other processes were at work");
        }
        const auto more = own_.size() < kMostAhead ? queue_.next() : std::nullopt;
        if (more) {
            own_[*more] = trace_here(*more, control);
        } else {
            std::this_thread::sleep_for(pause);
            pause = std::min(2 * pause, kLongestPause);
        }
    }
}

TracedJob TeamRuns::trace_here(std::size_t job, const RunControl& control) {
    RunControl own{.stop = control.stop};
    own.moment = moment_of(job, control);
    RunCheckpoint hooks;
    if (control.checkpoint != nullptr) {
        hooks.is_due = control.checkpoint->is_due;
        hooks.save = [&](std::size_t moment, const RunSnapshot& state) {
            keep_states(control);
            control.checkpoint->save(moment, state);
        };
        own.checkpoint = &hooks;
    }
    return trace_(jobs_[job], own);
}

/// What a checkpoint knows the run of a job by, which is the one that is taken or behind it.
std::size_t TeamRuns::moment_of(std::size_t job, const RunControl& control) const {
    return control.moment + (jobs_[job].run - run_);
}

/// Lets the checkpoint have what is done of the runs behind this one, here and elsewhere.
void TeamRuns::keep_states(const RunControl& control) {
    for (const auto& [job, traced] : own_) {
        if (traced.state && kept_.insert(job).second) {
            control.checkpoint->keep(
                moment_of(job, control),
                save_state({traced.state->position, &*traced.state->done, nullptr}));
        }
    }
    for (std::size_t job = next_; job < jobs_.size(); ++job) {
        std::optional<std::string> last;
        while (auto bytes = team_.mail.receive(state_number(job))) {
            last = std::move(bytes);
        }
        if (last) {
            control.checkpoint->keep(moment_of(job, control), std::move(*last));
        }
    }
}

void help_with_runs(const RunTeam& team, const std::vector<TeamJob>& jobs, const TraceJob& trace) {
    JobQueue queue(team, jobs);
    StateSender states(team);
    std::stop_source stop;
    RunControl control{.stop = stop.get_token()};
    control.on_progress = [&](const Progress&) {
        if (team.mail.is_closed()) {
            stop.request_stop();
        }
    };
    try {
        for (auto job = queue.next(); job && !team.mail.is_closed(); job = queue.next()) {
            control.checkpoint = states.hooks_of(*job);
            team.mail.send(result_number(*job), save_job(trace(jobs[*job], control)));
        }
    } catch (const Stopped&) {  // by the first process, which wants no more
    }
    team.mail.end();
}

}  // namespace quasimc
