#include "run/rounds.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace quasimc {
namespace {

/// Largest number of points per replicate without other limits.
constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 30U;
/// Ratio of paths between consecutive pilot rounds.
constexpr std::uint64_t kPilotGrowth = 4;
/// Fraction of the remaining time that a restart may be predicted to take: predictions have errors.
constexpr double kSafeFraction = 0.85;
/// Largest ratio of all paths to those of a pilot round before them, if they are predicted to take
/// at most half of the remaining time. The cost of more paths is hard to predict from few, and an
/// incomplete round is lost.
constexpr std::uint64_t kMaxLeap = 16;
constexpr double kSafeLeapFraction = 0.5;

/// Pilot rounds of a target have the specification's paths divided by powers of this.
constexpr std::uint64_t kTargetGrowth = 4;
/// Paths of the first pilot round as a fraction of the fixed cost.
constexpr double kCheapFraction = 1. / 8;

/// Number of paths from which a round is huge; before it, pilot rounds start with kFirstInsured
/// paths and end with 1 / kInsuredPart of it.
constexpr std::uint64_t kHugeRound = std::uint64_t{1} << 22U;
constexpr std::uint64_t kFirstInsured = std::uint64_t{1} << 14U;
constexpr std::uint64_t kInsuredPart = 64;

/// The fewest paths of a first round that are at least `fewest`: `paths`, or the next power of two
/// divided by a power of kTargetGrowth. So the rounds of all targets have the same sizes.
std::uint64_t first_at_least(std::uint64_t fewest, std::uint64_t paths) {
    std::uint64_t first = paths;
    for (std::uint64_t next = std::bit_ceil(paths) / kTargetGrowth; next >= fewest && next > 0;
         next /= kTargetGrowth) {
        first = next;
    }
    return first;
}

}  // namespace

void CostModel::add(std::uint64_t paths, double seconds) {
    const auto count = static_cast<double>(paths);
    if (count > last.paths) {
        before = last;
    }
    last = {count, seconds};
}

double CostModel::seconds_for(std::uint64_t paths) const {
    const double mean = last.seconds / last.paths;
    if (before.paths == 0 || before.paths >= last.paths) {
        return mean * static_cast<double>(paths);
    }
    // A shorter time does not show the cost per path well: it is assumed to be at least half of the
    // mean.
    constexpr double kLongEnough = 0.2;
    const double slope = (last.seconds - before.seconds) / (last.paths - before.paths);
    const double least = last.seconds < kLongEnough ? mean / 2 : 0;
    const double each = std::clamp(slope, least, mean);
    return std::max(0.0, last.seconds + each * (static_cast<double>(paths) - last.paths));
}

bool Rounds::fits(std::uint64_t paths) const {
    return state_.cost.seconds_for(paths) <= kSafeFraction * seconds_left();
}

/// Whether this number of paths may follow directly after a pilot round.
bool Rounds::may_leap_to(std::uint64_t paths) const {
    return !has_limit() || state_.cost.seconds_for(paths) <= kSafeLeapFraction * seconds_left();
}

Round Rounds::begin(std::uint64_t paths) {
    state_.is_pilot = paths < spec_.paths;
    state_.done = 0;
    count_ = paths;
    return {0, paths};
}

std::optional<Round> Rounds::next() {
    if (state_.done == 0) {
        return begin(first_paths());
    }
    return state_.is_pilot ? after_pilot() : as_many_again();
}

std::uint64_t Rounds::first_paths() const {
    if (has_target()) {
        return first_for_target();
    }
    if (has_limit()) {
        return std::min(limits_.fewest, spec_.paths);
    }
    const bool is_huge = limits_.may_be_stopped && spec_.paths >= kHugeRound;
    return is_huge ? std::clamp(limits_.fewest, kFirstInsured, spec_.paths) : spec_.paths;
}

/// A first pilot round whose paths cost little beside the round itself; all paths if it would cost
/// more than half of them.
std::uint64_t Rounds::first_for_target() const {
    const double fixed = limits_.fixed_cost;
    const auto cheap = static_cast<std::uint64_t>(kCheapFraction * fixed);
    const std::uint64_t first = first_at_least(std::max(limits_.fewest, cheap), spec_.paths);
    const bool is_worth_it =
        2 * (fixed + static_cast<double>(first)) <= fixed + static_cast<double>(spec_.paths);
    return is_worth_it ? first : spec_.paths;
}

/// The fewest paths of a pilot round that restarts the run.
std::uint64_t Rounds::next_pilot() const {
    return has_target() ? first_at_least(state_.done + 1, spec_.paths)
                        : std::min(kPilotGrowth * state_.done, spec_.paths);
}

/// Whether a pilot round is to get as many paths again instead of a restart: if a target probably
/// needs no more, as its error falls with the root of the number of paths. Once only, so that no
/// round of many paths has the density of lines of few.
bool Rounds::may_double() const {
    return has_target() && !is_doubled() && std::pow(distance_.ratio_to_target, 2) <= 2;
}

bool Rounds::is_doubled() const {
    return first_at_least(state_.done, spec_.paths) != state_.done;
}

/// The paths of a restart for a target: at least half of those that it probably needs, for they can
/// be doubled, and so many that the round costs at least three times the discarded one.
std::uint64_t Rounds::paths_for_target() const {
    const auto done = static_cast<double>(state_.done);
    const double before = is_doubled() ? done / 2 : done;
    const double half = std::pow(distance_.ratio_to_target, 2) / 2 * done;
    const double least = 3 * before + 2 * limits_.fixed_cost;
    const double paths = std::max(least, std::min(half, kMaxLeap * before));
    return paths < static_cast<double>(spec_.paths)
               ? first_at_least(static_cast<std::uint64_t>(std::ceil(paths)), spec_.paths)
               : spec_.paths;
}

/// The paths with which a run is to restart after a pilot round, whatever time they take.
std::uint64_t Rounds::wanted_paths() const {
    if (has_target()) {
        return paths_for_target();
    }
    const std::uint64_t next = next_pilot();
    const bool may_be_all =
        has_limit() ? spec_.paths <= kMaxLeap * state_.done : next > spec_.paths / kInsuredPart;
    return may_be_all ? spec_.paths : next;
}

/// As many paths as are wanted if they fit; else a larger pilot round while that fits; else as many
/// again. Each pilot round is the result if the next one is not complete in time.
std::optional<Round> Rounds::after_pilot() {
    const std::uint64_t wanted = wanted_paths();
    const bool is_no_restart = is_at_target() || may_double();
    if (!is_no_restart && (may_leap_to(wanted) || fits(next_pilot()))) {
        return begin(may_leap_to(wanted) ? wanted : next_pilot());
    }
    state_.is_pilot = is_no_restart;
    return as_many_again();
}

std::optional<Round> Rounds::as_many_again() {
    if (state_.done >= spec_.paths && !asks_for_more()) {
        return std::nullopt;
    }
    if (is_at_target()) {
        stop_ = StopReason::target_reached;
        return std::nullopt;
    }
    const std::uint64_t limit = spec_.max_paths > 0 ? spec_.max_paths : kMaxPoints;
    if (asks_for_more() && state_.done * 2 > limit) {
        stop_ = StopReason::path_limit;
        return std::nullopt;
    }
    const bool is_too_much = !asks_for_more() && state_.done * 2 > spec_.paths;
    if (is_too_much || (has_limit() && state_.cost.seconds_for(state_.done) > seconds_left())) {
        stop_ = StopReason::time_limit;
        return std::nullopt;
    }
    count_ = state_.done;
    return Round{state_.done, count_};
}

void Rounds::finish(Deadline::Clock::time_point now, const TargetDistance& distance) {
    state_.cost.add(count_, std::chrono::duration<double>(now - now_).count());
    state_.done += count_;
    now_ = now;
    distance_ = distance;
}

std::vector<std::pair<std::size_t, std::size_t>> ratio_bands(
    const Scene& scene, const RunSpec& spec) {
    const auto& names = *scene.names();
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::string& ratio : spec.ratios) {
        const std::size_t colon = ratio.find(':');
        pairs.emplace_back(
            names.band_index(ratio.substr(0, colon)), names.band_index(ratio.substr(colon + 1)));
    }
    return pairs;
}

}  // namespace quasimc
