#include "run/trace_rounds.h"

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

#include "results/evaluate.h"
#include "run/run_checkpoint.h"

namespace quasimc {
namespace {

using Clock = Deadline::Clock;

/// Cost of a round without paths, in paths for each triangle: preparing a solver and evaluating
/// sums cost 1.6 (light tracing) to 4.3 (ray bundles).
constexpr double kFixedCost = 3;

/// Paths of the first pilot round; a power of two. Sampling from organs needs one point
/// per organ; with bundles the time must depend on the paths.
std::uint64_t min_paths(const Scene& scene, const RunSpec& spec) {
    constexpr std::uint64_t kMinPaths = 256;
    if (spec.method == Method::ray_bundles) {
        constexpr std::uint64_t kTrianglesPerPath = 8;
        return std::max(kMinPaths, std::bit_ceil(scene.triangle_count() / kTrianglesPerPath));
    }
    if (spec.method != Method::from_organs) {
        return kMinPaths;
    }
    const auto measured = static_cast<std::uint64_t>(std::count_if(
        scene.organs().begin(), scene.organs().end(), [](const Organ& o) { return o.measured; }));
    return std::max(kMinPaths, std::bit_ceil(measured));
}

ErrorsSoFar errors_of(const RoundsInput& input, const Sums& sums) {
    const RunSpec& spec = input.facts.spec;
    return errors_so_far(
        sums, input.facts.prepared.scene(), input.facts.asked,
        {spec.target_error, spec.target_fraction});
}

TargetDistance distance_of(const ErrorsSoFar& errors) {
    return {errors.round.fraction_at_target, errors.ratio_to_target};
}

/// The rounds from which a run resumes. The state retains the completed part of the next round.
std::optional<DoneRounds> take_done(std::optional<RunState>& stored) {
    if (!stored || !stored->done) {
        return std::nullopt;
    }
    DoneRounds done{
        std::move(*stored->done), stored->position.rounds, stored->position.first_paths};
    done.paths_before = static_cast<double>(done.sums.paths());
    return done;
}

/// New rounds, or rounds that continue from others.
Rounds make_rounds(const RoundsInput& input, const std::optional<DoneRounds>& done) {
    const RunSpec& spec = input.facts.spec;
    Rounds rounds(
        spec, {.deadline = input.deadline,
               .fewest = min_paths(input.facts.prepared.scene(), spec),
               .fixed_cost =
                   kFixedCost * static_cast<double>(input.facts.prepared.scene().triangle_count()),
               .start = input.first_round,
               .may_be_stopped = input.control.stop.stop_possible()});
    if (done) {
        rounds.restore(
            done->state,
            rounds.has_target() ? distance_of(errors_of(input, done->sums)) : TargetDistance());
    }
    return rounds;
}

/// Sums of a few paths for a run that was stopped before its first round was complete.
/// @throws StopRequested  if there is no time for them, or not enough
TracedRounds trace_few(const RoundsInput& input) {
    const RunFacts& facts = input.facts;
    const std::uint64_t paths = min_paths(facts.prepared.scene(), facts.spec);
    const bool may = input.control.stop.stop_requested() && input.seconds_after_stop > 0;
    if (!may || paths >= facts.spec.paths) {
        throw StopRequested();
    }
    EarlyStop end({});
    end.stop_at(Deadline::after(input.seconds_after_stop).at());
    RoundSolver solver(facts.prepared, input.sampler, facts.spec, end.token());
    TracedRounds few{.sums = solver.empty_sums(paths), .stop = StopReason::interrupted};
    static_cast<void>(solver.solve({{0, paths}, paths}, few.sums, nullptr));
    return few;
}

/// The input of a round.
struct RoundInput {
    RoundStart start;
    Sums sums;                ///< to which it adds
    double paths_before = 0;  ///< of these sums, as in DoneRounds
};

/// @param done  the previous rounds, if any. Their sums are moved if they are not needed any more
/// @param stored  the state from which the run resumes, if this is its first round
RoundInput begin_round(
    const RoundsInput& input,
    RoundSolver& solver,
    const Round& round,
    std::optional<DoneRounds>& done,
    std::optional<RunState> stored) {
    const bool is_first = round.first == 0;
    const std::uint64_t first_paths = is_first ? round.count : done->first_paths;
    const double paths_before = is_first ? 0 : done->paths_before;
    if (stored && stored->partial && stored->position.round == round) {
        const RoundStart start{round, first_paths, stored->position.tasks};
        return {start, std::move(*stored->partial), paths_before};
    }
    if (is_first) {
        return {{round, first_paths}, solver.empty_sums(first_paths), paths_before};
    }
    const bool are_needed = input.early.is_possible() || !input.control.listeners.empty();
    return {{round, first_paths}, are_needed ? done->sums : std::move(done->sums), paths_before};
}

/// Traces a round. @returns nothing  if it was stopped
/// @param done, stored  see begin_round()
std::optional<DoneRounds> trace_round(
    const RoundsInput& input,
    RoundSolver& solver,
    const Rounds& rounds,
    const Round& next,
    std::optional<DoneRounds>& done,
    std::optional<RunState> stored) try {
    RoundInput round = begin_round(input, solver, next, done, std::move(stored));
    RoundWatch watch(
        input.facts, input.control.listeners, {round.start, done ? &*done : nullptr, round.sums},
        solver, input.work.part(rounds.fraction_before(), rounds.share()), rounds.at_target());
    const SolvedRound solved = solver.solve(round.start, round.sums, &watch);
    const double cpu_seconds_before = done ? done->cpu_seconds_of_others : 0;
    return DoneRounds{
        .sums = std::move(round.sums),
        .state = {},
        .first_paths = round.start.first_paths,
        .paths_before =
            round.paths_before + solved.part_done_before * static_cast<double>(next.count),
        .cpu_seconds_of_others = cpu_seconds_before + solved.cpu_seconds_of_others};
} catch (const StopRequested&) {
    return std::nullopt;
}

/// Records a traced round. @returns its errors, if some listener needs them
std::optional<RoundErrors> finish_round(
    const RoundsInput& input, Rounds& rounds, const Sums& sums) {
    const bool is_reported =
        rounds.has_target() || (rounds.asks_for_more() && !rounds.state().is_pilot);
    ErrorsSoFar errors = is_reported ? errors_of(input, sums) : ErrorsSoFar{};
    const Clock::time_point now = Clock::now();
    errors.round.seconds = std::chrono::duration<double>(now - input.start).count();
    rounds.finish(now, distance_of(errors));
    return is_reported ? std::optional(errors.round) : std::nullopt;
}

}  // namespace

TracedRounds trace_rounds(const RoundsInput& input) {
    const SumsOrigin& origin = input.control.origin;
    std::optional<RunState> stored = state_to_go_on_from(origin.states, input.facts);
    std::optional<DoneRounds> done = take_done(stored);
    Rounds rounds = make_rounds(input, done);
    RoundSolver solver(
        input.facts.prepared, input.sampler, input.facts.spec, input.early.token(),
        {origin.team, origin.point, input.facts.time_step});
    std::vector<RoundErrors> errors;
    std::optional<Round> round = rounds.next();
    while (round) {
        std::optional<DoneRounds> traced =
            trace_round(input, solver, rounds, *round, done, std::exchange(stored, std::nullopt));
        if (!traced) {
            rounds.interrupt(input.early.why());
            break;
        }
        done = std::move(traced);
        if (!input.deadline.is_never()) {
            input.early.stop_at(input.deadline.at());
        }
        if (const auto now = finish_round(input, rounds, done->sums)) {
            errors.push_back(*now);
        }
        done->state = rounds.state();
        round = rounds.next();
        if (round) {
            report(input.control, &RunListener::on_round, {input.facts, *done});
        }
    }
    if (!done) {
        return trace_few(input);
    }
    input.early.stop_at(Clock::time_point::max());
    if (rounds.stop() != StopReason::interrupted) {
        report(input.control, &RunListener::on_last_round, {input.facts, *done});
    }
    return {
        .sums = std::move(done->sums),
        .stop = rounds.stop(),
        .at_target = rounds.at_target(),
        .paths_before = done->paths_before,
        .cpu_seconds_of_others = done->cpu_seconds_of_others,
        .errors = std::move(errors)};
}

}  // namespace quasimc
