#include "run/rounds.h"

#include <algorithm>

namespace quasimc {
namespace {

/// Points a replicate may have when nothing else ends a run.
constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 30U;
/// A trial has so many times the paths of the one before.
constexpr std::uint64_t kTrialGrowth = 4;
/// What is begun anew should be done by this part of the time left: predictions have errors.
constexpr double kSureOfTime = 0.85;
/// So many times the paths of a trial may be begun straight after it if that seems to take half of
/// the time left. More may cost more than a trial of few can tell, and a round that is not done in
/// time is lost.
constexpr std::uint64_t kFarthestLeap = 16;
constexpr double kSureOfLeap = 0.5;

/// A round is huge from so many paths on; trials before it have so many at first, and in the end at
/// most this part of it.
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
    // What has taken less than this tells little of the cost of a round: half of it is left to
    // the paths.
    constexpr double kLongEnough = 0.2;
    const double slope = (last.seconds - before.seconds) / (last.paths - before.paths);
    const double least = last.seconds < kLongEnough ? mean / 2 : 0;
    const double each = std::clamp(slope, least, mean);
    return std::max(0.0, last.seconds + each * (static_cast<double>(paths) - last.paths));
}

bool Rounds::fits(std::uint64_t paths) const {
    return state_.cost.seconds_for(paths) <= kSureOfTime * seconds_left();
}

/// Whether all paths may be begun straight after a trial.
bool Rounds::may_leap() const {
    return spec_.paths <= kFarthestLeap * state_.done &&
           state_.cost.seconds_for(spec_.paths) <= kSureOfLeap * seconds_left();
}

Round Rounds::begin(std::uint64_t paths) {
    state_.is_trial = paths < spec_.paths;
    state_.done = 0;
    count_ = paths;
    return {0, paths};
}

std::optional<Round> Rounds::next() {
    if (state_.done == 0) {
        return begin(first_paths());
    }
    return state_.is_trial ? after_trial() : as_many_again();
}

std::uint64_t Rounds::first_paths() const {
    if (has_limit()) {
        return std::min(limits_.fewest, spec_.paths);
    }
    const bool is_huge = limits_.may_be_stopped && spec_.paths >= kHugeRound;
    return is_huge ? std::clamp(limits_.fewest, kFirstInsured, spec_.paths) : spec_.paths;
}

/// All paths if they fit; if not, a larger trial as long as that fits; if not, as many again. Each
/// trial is the result if the next one is not done in time.
std::optional<Round> Rounds::after_trial() {
    const std::uint64_t next = std::min(kTrialGrowth * state_.done, spec_.paths);
    if (!has_limit()) {
        return begin(next <= spec_.paths / kInsuredPart ? next : spec_.paths);
    }
    if (may_leap() || fits(next)) {
        return begin(may_leap() ? spec_.paths : next);
    }
    state_.is_trial = false;
    return as_many_again();
}

std::optional<Round> Rounds::as_many_again() {
    if (state_.done >= spec_.paths && !asks_for_more()) {
        return std::nullopt;
    }
    // A run that goes on to a larger first round looks at its target after that, as it would have.
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
