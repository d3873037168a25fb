#include "results/totals.h"

#include <algorithm>
#include <utility>

#include "results/bounds/organ_contributions.h"
#include "results/flows.h"
#include "results/groups.h"
#include "results/organ_blocks.h"
#include "scene/lint.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// A total without the size of a contribution. @param values  [band][replicate]
TotalReplicates total_of(std::string_view name, const std::vector<std::vector<double>>& values) {
    TotalReplicates total{name, {}, std::vector<ContributionSize>(values.size())};
    for (std::size_t r = 0; r < values.front().size(); ++r) {
        for (const std::vector<double>& band : values) {
            total.values.push_back(band[r]);
        }
    }
    return total;
}

}  // namespace

std::vector<TotalReplicates> replicates_of_totals(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const BandFlows flows = read_flows(sums, scene);
    const auto part = [&](std::string_view name, double Flows::*of) {
        std::vector<std::vector<double>> values;
        for (const std::vector<Flows>& band : flows) {
            values.push_back(values_of(band, of));
        }
        return total_of(name, values);
    };
    TotalReplicates organs = part("absorbed_by_organs", &Flows::organs);
    TotalReplicates ground = part("absorbed_by_ground", &Flows::ground);
    const std::vector<TotalContributions> contributions =
        contributions_to_totals(sums, scene, spec);
    TotalReplicates transmitted = part("transmitted", &Flows::on_ground);
    for (std::size_t b = 0; b < flows.size(); ++b) {
        const TotalSizes sizes = sizes_of(contributions[b], flows[b]);
        organs.sizes[b] = sizes.organs;
        ground.sizes[b] = sizes.ground;
        transmitted.sizes[b] = sizes.on_ground;
    }
    std::vector<TotalReplicates> all{
        part("emitted", &Flows::emitted),
        std::move(organs),
        std::move(ground),
        part("escaped", &Flows::escaped),
        part("cut_off", &Flows::cut_off),
        part("imbalance", &Flows::imbalance)};
    const std::vector<std::vector<double>> incident = horizontal_flux(flows, scene, spec);
    if (!incident.empty()) {
        all.push_back(total_of("incident", incident));
    }
    if (!incident.empty() && ground_of(scene) != nullptr) {
        all.push_back(part("reflected", reflected_flux(scene)));
        all.push_back(std::move(transmitted));
    }
    return all;
}

void TotalContributions::include(
    const OrganContributions& contributions, const Scene& scene, const Organ& organ) {
    if (organ.is_ground) {
        ground.include(contributions);
    } else if (!is_sensor(scene, organ)) {
        organs.include(contributions);
    }
}

void TotalContributions::include(const TotalContributions& other) {
    organs.include(other.organs);
    ground.include(other.ground);
}

TotalSizes sizes_of(const TotalContributions& all, const std::vector<Flows>& flows) {
    const auto size = [&](const OrganContributions& of, const LightParts& parts,
                          double Flows::*part) { return of.size(parts, values_of(flows, part)); };
    const LightParts absorbed = parts_of(Quantity::absorbed_flux);
    return {
        size(all.organs, absorbed, &Flows::organs), size(all.ground, absorbed, &Flows::ground),
        size(all.ground, kIncidentLight, &Flows::on_ground)};
}

std::vector<TotalContributions> contributions_to_totals(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const SumReader reader(sums);
    std::vector<TotalContributions> all(sums->bands());
    gather_contributions(
        0, scene.organs().size(), spec.threads,
        [&](std::size_t first, std::size_t last, std::vector<TotalContributions>& own) {
            for (std::size_t i = first; i < last; ++i) {
                const Organ& organ = scene.organs()[i];
                for (std::size_t b = 0; is_measured(sums, organ) && b < own.size(); ++b) {
                    own[b].include(
                        OrganContributions(OrganReader(reader, scene, spec, organ), b), scene,
                        organ);
                }
            }
        },
        all);
    return all;
}

}  // namespace quasimc
