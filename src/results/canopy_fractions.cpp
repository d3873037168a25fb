#include <algorithm>
#include <array>
#include <numeric>
#include <span>

#include "results/bounds/organ_reader.h"
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

/// One contribution to the ground: flux on it and absorbed.
struct GroundContribution {
    double on_ground = 0, absorbed = 0;
};

GroundContribution contribution_on_ground(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const Organ& ground,
    std::size_t band) {
    const SumReader sum_reader(sums);
    const OrganReader reader(sum_reader, scene, spec, ground);
    const double contribution = reader.largest(sum_reader.direct, band);
    return {contribution, contribution * reader.largest_absorptance(band)};
}

/// The largest contribution of an organ to the absorbed light of each band.
std::vector<TotalContribution> total_contributions(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    std::vector<std::uint32_t> indices(scene.organs().size());
    std::iota(indices.begin(), indices.end(), 0U);
    std::vector<OrganWeights> organs;
    organs.reserve(indices.size());
    for (const std::uint32_t& index : indices) {
        organs.push_back({std::span(&index, 1)});
    }
    const std::array quantities{Quantity::absorbed_flux};
    const std::vector<ContributionSize> sizes =
        combine_replicates(sums, scene, spec, organs, quantities).sizes;
    std::vector<TotalContribution> all(sums->bands());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        const bool is_ground = scene.organs()[i / all.size()].is_ground;
        all[i % all.size()].include(
            is_ground ? TotalContribution{{}, sizes[i]} : TotalContribution{sizes[i], {}});
    }
    return all;
}

/// Makes fractions of the flows of one band.
class FractionMaker {
  public:
    /// @param incident  per replicate
    FractionMaker(const std::vector<Flows>& flows, std::vector<double> incident)
        : flows_(flows), incident_(std::move(incident)) {}

    /// @param value_per_contribution  flux of a single contribution; 0: zeros are certain
    [[nodiscard]] Estimate fraction(double Flows::*part, double value_per_contribution = 0) const {
        std::vector<double> amounts;
        for (const Flows& flows : flows_) {
            amounts.push_back(flows.*part);
        }
        const bool is_unseen =
            value_per_contribution > 0 &&
            std::all_of(amounts.begin(), amounts.end(), [](double x) { return x == 0; });
        return is_unseen
                   ? estimate_unseen(
                         static_cast<double>(amounts.size()), value_per_contribution / incident())
                   : not_negative(estimate_ratio(amounts, incident_));
    }

    [[nodiscard]] double incident() const { return estimate_mean(incident_).mean; }

  private:
    const std::vector<Flows>& flows_;
    std::vector<double> incident_;
};

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
    const BandFlows& flows, const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const Organ* ground = ground_of(scene);
    const bool infinite = is_infinite(scene);
    std::vector<std::vector<double>> incident = horizontal_flux(flows, scene, spec);
    std::vector<CanopyFractions> fractions(incident.size());
    for (std::size_t b = 0; b < fractions.size(); ++b) {
        const FractionMaker maker(flows[b], std::move(incident[b]));
        CanopyFractions& own = fractions[b];
        own = {
            infinite ? sums->emitted_flux[b] : maker.incident(), kUnknownEstimate, kUnknownEstimate,
            maker.fraction(&Flows::organs), kUnknownEstimate};
        if (ground != nullptr) {
            const GroundContribution contribution =
                contribution_on_ground(sums, scene, spec, *ground, b);
            own.reflectance = maker.fraction(reflected_flux(scene));
            own.transmittance = maker.fraction(&Flows::on_ground, contribution.on_ground);
            own.ground_absorptance = maker.fraction(&Flows::ground, contribution.absorbed);
        }
    }
    return fractions;
}

CombinedReplicates canopy_replicates(
    const BandFlows& flows, const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const Organ* ground = ground_of(scene);
    const std::array parts = parts_of_fractions(scene);
    CombinedReplicates all;
    for (std::size_t r = 0; r < sums->replicates.size(); ++r) {
        for (const std::vector<Flows>& band : flows) {
            for (const auto part : parts) {
                const bool is_known = ground != nullptr || part == &Flows::organs;
                all.values.push_back(is_known ? band[r].*part : kUnknownEstimate.mean);
            }
        }
    }
    const std::vector<TotalContribution> absorbed = total_contributions(sums, scene, spec);
    const auto replicates = static_cast<double>(sums->replicates.size());
    for (std::size_t b = 0; b < flows.size(); ++b) {
        const double on_ground =
            ground != nullptr ? contribution_on_ground(sums, scene, spec, *ground, b).on_ground : 0;
        for (const auto part : parts) {
            all.sizes.push_back(
                part == &Flows::organs      ? absorbed[b].organs
                : part == &Flows::ground    ? absorbed[b].ground
                : part == &Flows::on_ground ? ContributionSize{on_ground / replicates, 0}
                                            : ContributionSize{});
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
