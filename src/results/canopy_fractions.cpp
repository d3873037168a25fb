#include <array>
#include <span>

#include "results/flows.h"
#include "results/fraction_table.h"
#include "results/groups.h"
#include "results/totals.h"
#include "scene/lint.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

bool is_infinite(const Scene& scene) {
    return scene.cell().along_x && scene.cell().along_y;
}

/// The flux of each fraction, in the order of fraction_table().
std::array<double Flows::*, fraction_table().size()> parts_of_fractions(const Scene& scene) {
    return {
        is_infinite(scene) ? &Flows::escaped : &Flows::escaped_scattered, &Flows::on_ground,
        &Flows::organs, &Flows::ground};
}

/// One contribution to each fraction, as flux, in the order of fraction_table().
std::array<ContributionSize, fraction_table().size()> sizes_of_fractions(const TotalSizes& sizes) {
    return {ContributionSize{}, sizes.on_ground, sizes.organs, sizes.ground};
}

bool is_known(std::size_t fraction, const Scene& scene) {
    return ground_of(scene) != nullptr ||
           fraction_table()[fraction].part == &CanopyFractions::absorptance;
}

}  // namespace

std::vector<std::vector<double>> horizontal_flux(
    const BandFlows& flows, const Scene& scene, const EvaluationSpec& spec) {
    const bool infinite = is_infinite(scene);
    const bool is_known =
        infinite || (ground_of(scene) != nullptr && !spec.horizontal_irradiance.empty());
    std::vector<std::vector<double>> incident(is_known ? flows.size() : 0);
    for (std::size_t b = 0; b < incident.size(); ++b) {
        for (const Flows& one : flows[b]) {
            incident[b].push_back(
                infinite ? one.emitted : spec.horizontal_irradiance[b] * horizontal_area(scene));
        }
    }
    return incident;
}

std::vector<double> mean_horizontal_flux(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    if (is_infinite(scene)) {
        return sums->emitted_flux;
    }
    std::vector<double> flux;
    for (const double irradiance : spec.horizontal_irradiance) {
        if (ground_of(scene) != nullptr) {
            flux.push_back(irradiance * horizontal_area(scene));
        }
    }
    return flux;
}

double Flows::*reflected_flux(const Scene& scene) {
    return is_infinite(scene) ? &Flows::escaped : &Flows::escaped_scattered;
}

std::vector<CanopyFractions> evaluate_canopy(
    const BandFlows& flows,
    std::span<const TotalSizes> sizes,
    std::span<const double> emitted,
    const Scene& scene,
    const EvaluationSpec& spec) {
    const std::array parts = parts_of_fractions(scene);
    const std::vector<std::vector<double>> incident = horizontal_flux(flows, scene, spec);
    std::vector<CanopyFractions> all(incident.size());
    for (std::size_t b = 0; b < all.size(); ++b) {
        const std::array one = sizes_of_fractions(sizes[b]);
        all[b].incident = is_infinite(scene) ? emitted[b] : mean_of(incident[b]);
        for (std::size_t i = 0; i < parts.size(); ++i) {
            all[b].*fraction_table()[i].part =
                is_known(i, scene)
                    ? estimate_share(values_of(flows[b], parts[i]), incident[b], one[i])
                    : kUnknownEstimate;
        }
    }
    return all;
}

CombinedReplicates canopy_replicates(
    const BandFlows& flows, const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const std::array parts = parts_of_fractions(scene);
    CombinedReplicates all;
    for (std::size_t r = 0; r < sums->replicates.size(); ++r) {
        for (const std::vector<Flows>& band : flows) {
            for (std::size_t i = 0; i < parts.size(); ++i) {
                all.values.push_back(
                    is_known(i, scene) ? band[r].*parts[i] : kUnknownEstimate.mean);
            }
        }
    }
    const std::vector<TotalContributions> contributions =
        contributions_to_totals(sums, scene, spec);
    for (std::size_t b = 0; b < flows.size(); ++b) {
        for (const ContributionSize& one :
             sizes_of_fractions(sizes_of(contributions[b], flows[b]))) {
            all.sizes.push_back(one);
        }
    }
    return all;
}

std::vector<CanopyFractions> zero_canopy(const Scene& scene) {
    const bool is_known = is_infinite(scene) || ground_of(scene) != nullptr;
    return std::vector<CanopyFractions>(
        is_known ? scene.bands().size() : 0,
        {0, kUnknownEstimate, kUnknownEstimate, kUnknownEstimate, kUnknownEstimate});
}

}  // namespace quasimc
