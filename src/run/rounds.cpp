#include "run/rounds.h"

#include <algorithm>

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

/// Number of paths from which a round is huge; before it, pilot rounds start with kFirstInsured
/// paths and end with 1 / kInsuredPart of it.
constexpr std::uint64_t kHugeRound = std::uint64_t{1} << 22U;
constexpr std::uint64_t kFirstInsured = std::uint64_t{1} << 14U;
constexpr std::uint64_t kInsuredPart = 64;

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

/// Whether all paths may follow directly after a pilot round.
bool Rounds::may_leap() const {
    return spec_.paths <= kMaxLeap * state_.done &&
           state_.cost.seconds_for(spec_.paths) <= kSafeLeapFraction * seconds_left();
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
    if (has_limit()) {
        return std::min(limits_.fewest, spec_.paths);
    }
    const bool is_huge = limits_.may_be_stopped && spec_.paths >= kHugeRound;
    return is_huge ? std::clamp(limits_.fewest, kFirstInsured, spec_.paths) : spec_.paths;
}

/// All paths if they fit; else a larger pilot round while that fits; else as many again. Each pilot
/// round is the result if the next one is not complete in time.
std::optional<Round> Rounds::after_pilot() {
    const std::uint64_t next = std::min(kPilotGrowth * state_.done, spec_.paths);
    if (!has_limit()) {
        return begin(next <= spec_.paths / kInsuredPart ? next : spec_.paths);
    }
    if (may_leap() || fits(next)) {
        return begin(may_leap() ? spec_.paths : next);
    }
    state_.is_pilot = false;
    return as_many_again();
}

std::optional<Round> Rounds::as_many_again() {
    if (state_.done >= spec_.paths && !asks_for_more()) {
        return std::nullopt;
    }
    // A resumed run with a larger first round checks its target after that round, like a run that
    // began with it.
    const bool is_first_done = state_.done >= spec_.paths || has_limit();
    if (is_first_done && spec_.target_error > 0 && at_target_ >= spec_.target_fraction) {
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

void Rounds::finish(Deadline::Clock::time_point now, double fraction_at_target) {
    state_.cost.add(count_, std::chrono::duration<double>(now - now_).count());
    state_.done += count_;
    now_ = now;
    at_target_ = fraction_at_target;
}

std::vector<std::pair<std::size_t, std::size_t>> ratio_bands(
    const Scene& scene, const RunSpec& spec) {
    const auto index = [&](std::string_view name) {
        const auto& bands = scene.bands();
        return static_cast<std::size_t>(
            std::find_if(
                bands.begin(), bands.end(), [&](const Band& b) { return b.name == name; }) -
            bands.begin());
    };
    std::vector<std::pair<std::size_t, std::size_t>> pairs;
    for (const std::string& ratio : spec.ratios) {
        const std::size_t colon = ratio.find(':');
        pairs.emplace_back(index(ratio.substr(0, colon)), index(ratio.substr(colon + 1)));
    }
    return pairs;
}

}  // namespace quasimc
