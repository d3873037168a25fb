#pragma once

#include <span>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/combine.h"
#include "scene/scene.h"

namespace quasimc {

/// Budget of the light of one band in one replicate: flux.
struct Flows {
    double emitted = 0, organs = 0, ground = 0, escaped = 0, cut_off = 0, imbalance = 0;
    double on_ground = 0;          ///< falls on the ground
    double escaped_scattered = 0;  ///< part of `escaped`; NaN where escaped light is a remainder
};

/// [band][replicate]
using BandFlows = std::vector<std::vector<Flows>>;

[[nodiscard]] BandFlows read_flows(const Sums& sums, const Scene& scene);

/// A part, per replicate.
[[nodiscard]] std::vector<double> values_of(const std::vector<Flows>& flows, double Flows::*part);

struct TotalSizes;

/// The energy budget of each band.
/// @param sizes  by band
/// @param emitted  by band: the most that any part can be; empty if not all of it is counted
[[nodiscard]] std::vector<BandBudget> evaluate_budget(
    const BandFlows& flows, std::span<const TotalSizes> sizes, std::span<const double> emitted);

/// Flux on the horizontal area of the cell or ground, [band][replicate]: what an infinite scene
/// emits, or the irradiance of the sources; empty if it is unknown.
[[nodiscard]] std::vector<std::vector<double>> horizontal_flux(
    const BandFlows& flows, const Scene& scene, const EvaluationSpec& spec);

/// The flux that leaves a canopy upwards: all that escapes from a cell that is periodic along both
/// axes, or scattered light that does.
[[nodiscard]] double Flows::*reflected_flux(const Scene& scene);

/// The mean of the light on the horizontal by band, without the error of its samples; empty if it
/// is unknown.
[[nodiscard]] std::vector<double> mean_horizontal_flux(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

/// The fractions of each band (Result::canopy).
/// @param sizes, emitted  as those of evaluate_budget()
[[nodiscard]] std::vector<CanopyFractions> evaluate_canopy(
    const BandFlows& flows,
    std::span<const TotalSizes> sizes,
    std::span<const double> emitted,
    const Scene& scene,
    const EvaluationSpec& spec);
/// The fluxes of the fractions of a canopy, replicate by replicate, for arithmetic beyond sums:
/// bands in place of sums, fractions (fraction_table()) in place of quantities and bands. NaN where
/// they are unknown.
[[nodiscard]] CombinedReplicates canopy_replicates(
    const BandFlows& flows, const Sums& sums, const Scene& scene, const EvaluationSpec& spec);
/// Fractions of a scene without light: NaN.
[[nodiscard]] std::vector<CanopyFractions> zero_canopy(const Scene& scene);

}  // namespace quasimc
