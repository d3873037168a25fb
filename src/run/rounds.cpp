#include "run/rounds.h"

#include <algorithm>

namespace quasimc {
namespace {

/// Points a replicate may have when nothing else ends a run.
constexpr std::uint64_t kMostPoints = std::uint64_t{1} << 30U;

}  // namespace

std::optional<Round> Rounds::next() {
    if (done_ == 0) {
        count_ = spec_.paths;
        return Round{0, count_};
    }
    if (!has_budget()) {
        return std::nullopt;
    }
    if (spec_.target_error > 0 && at_target_ >= spec_.target_fraction) {
        stop_ = StopReason::target_reached;
        return std::nullopt;
    }
    const std::uint64_t most = spec_.max_paths > 0 ? spec_.max_paths : kMostPoints;
    if (done_ * 2 > most) {
        stop_ = StopReason::path_limit;
        return std::nullopt;
    }
    // As many points again take about as long again.
    if (spec_.max_seconds > 0 && 2 * seconds_ > spec_.max_seconds) {
        stop_ = StopReason::time_is_up;
        return std::nullopt;
    }
    count_ = done_;
    return Round{done_, count_};
}

void Rounds::finish(double seconds, double fraction_at_target) {
    done_ += count_;
    count_ = 0;
    seconds_ = seconds;
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
