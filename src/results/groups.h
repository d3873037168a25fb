#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"
#include "sums/statistics.h"

namespace quasimc {

/// Whether light passes an organ undisturbed.
[[nodiscard]] bool is_sensor(const Scene& scene, const Organ& organ);

/// Every key of a label, in the order in which they first appear; valid as long as the scene is.
[[nodiscard]] std::vector<std::string_view> label_keys(const Scene& scene);

/// Adds a fault for each key that no organ's labels have, heights that do not ascend, and layers of
/// a scene without height.
void check_groups(const Scene& scene, const GroupSpec& spec, Faults& faults);

/// The part of check_groups() that needs no scene.
void check_layer_heights(const GroupSpec& spec, Faults& faults);

/// The light of the groups that EvaluationSpec::groups asks for, as part of evaluate().
/// @param incident  [band][replicate]: flux on the horizontal; empty if it is unknown
[[nodiscard]] GroupResults evaluate_groups(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<std::vector<double>>& incident);
/// The share of a flux in that of all organs, of which it is a part: one contribution more is one
/// to both. @param flux, all  per replicate
[[nodiscard]] Estimate share_of_all(
    std::span<const double> flux, std::span<const double> all, const ContributionSize& one);
/// Groups of a scene without light: zeros, and ratios that are NaN.
[[nodiscard]] GroupResults zero_groups(
    const Scene& scene, const GroupSpec& spec, std::size_t ratios);

/// The horizontal area that light falls on from above: that of a cell that is periodic along both
/// axes, or else of the ground seen from above; NaN without either.
[[nodiscard]] double horizontal_area(const Scene& scene);

}  // namespace quasimc
