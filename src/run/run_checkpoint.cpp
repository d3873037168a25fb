#include "run/run_checkpoint.h"

#include <algorithm>
#include <bit>
#include <string>

#include <fmt/format.h>

#include "quasimc/error.h"
#include "samplers/catalogue.h"
#include "solvers/catalogue.h"

namespace quasimc {

namespace {

/// Why a resumed run can't get `paths` with the same bits as a run that began with them; "" if it
/// can.
std::string refusal_of_paths(const RunPosition& position, const Scene& scene, const RunSpec& spec) {
    const std::uint64_t first = position.first_paths;
    if (spec.target_error > 0) {
        return "a run with a target begins with fewer";
    }
    if (spec.paths < position.rounds.done) {
        return fmt::format("{} paths are computed already", position.rounds.done);
    }
    if (spec.paths % first != 0 || !std::has_single_bit(spec.paths / first)) {
        return fmt::format("they must be {}, doubled any number of times", first);
    }
    const SolverEntry* solver = find_solver(spec.method);
    const bool adds_up =
        solver->do_rounds_add_up != nullptr && solver->do_rounds_add_up(scene, first);
    const auto samplers = sampler_catalogue();
    const auto sampler = std::find_if(
        samplers.begin(), samplers.end(), [&](const auto& e) { return e.name == spec.sampler; });
    if (!adds_up || !sampler->is_sequence) {
        return fmt::format(
            "{0}: the first {2} paths of {1} differ from those of a run with {3} paths",
            solver->name, spec.sampler, first, spec.paths);
    }
    return "";
}

/// @throws InputError  if the stored run can't become the requested one
void check_other_paths(const RunPosition& position, const Scene& scene, const RunSpec& spec) {
    const std::string why = refusal_of_paths(position, scene, spec);
    if (!why.empty()) {
        throw InputError(
            {{"paths", fmt::format("the checkpoint can't be continued to {} paths", spec.paths),
              why, "keep paths and set max_paths, or start again"}});
    }
}

/// Why a run with these options might have ended before the stored rounds; "" if it can't.
std::string refusal_of_ends(const RunPosition& position, const RunSpec& spec) {
    if (position.rounds.done <= spec.paths) {
        return "";
    }
    if (spec.max_paths > 0 && spec.max_paths < position.rounds.done) {
        return fmt::format("max_paths is {}", spec.max_paths);
    }
    const bool has_target = spec.target_error > 0;
    if (!has_target && spec.max_paths == 0) {
        return fmt::format(
            "paths is {}, and neither max_paths nor target_error requires more", spec.paths);
    }
    const bool is_no_weaker = position.target_error > 0 &&
                              spec.target_error <= position.target_error &&
                              spec.target_fraction >= position.target_fraction;
    return !has_target || is_no_weaker ? "" : "the target may need fewer";
}

/// @throws InputError  if the requested run might have ended earlier
void check_ends(const RunPosition& position, const RunSpec& spec) {
    const std::string why = refusal_of_ends(position, spec);
    if (!why.empty()) {
        throw InputError(
            {{"checkpoint",
              fmt::format(
                  "has {} paths already, more than this run requests", position.rounds.done),
              why, "request at least as many paths as before, or start again"}});
    }
}

/// Whether the stored rounds are a pilot round, and a run with this target might have had others:
/// it begins again.
bool is_other_pilot(const RunState& stored, const RunSpec& spec) {
    const RunPosition& position = stored.position;
    const bool is_same = position.target_error == spec.target_error &&
                         position.target_fraction == spec.target_fraction &&
                         position.asked_paths == spec.paths;
    const bool has_target = position.target_error > 0 || spec.target_error > 0;
    return stored.done && position.rounds.is_pilot && has_target && !is_same;
}

}  // namespace

std::optional<RunState> state_to_go_on_from(StoredStates* states, const RunFacts& facts) {
    std::optional<RunState> stored =
        states != nullptr ? states->state_of(facts.time_step) : std::nullopt;
    if (!stored) {
        return std::nullopt;
    }
    const auto fits = [&](const std::optional<Sums>& sums) {
        return !sums || (*sums)->replicates.size() == facts.spec.replicates;
    };
    if (stored->position.digest != facts.digest() || !fits(stored->done) ||
        !fits(stored->partial)) {
        throw InputError(
            {{"checkpoint", "it belongs to another run",
              "scene, sources, options or version differ", ""}});
    }
    if (is_other_pilot(*stored, facts.spec)) {
        return std::nullopt;
    }
    const bool is_begun = stored->done && !stored->position.rounds.is_pilot;
    if (is_begun && stored->position.asked_paths != facts.spec.paths) {
        check_other_paths(stored->position, facts.prepared.scene(), facts.spec);
    }
    if (is_begun) {
        check_ends(stored->position, facts.spec);
    }
    return stored;
}

}  // namespace quasimc
