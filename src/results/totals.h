#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/bounds/organ_contributions.h"
#include "results/flows.h"
#include "results/organ_blocks.h"
#include "scene/scene.h"
#include "sums/statistics.h"

namespace quasimc {

/// The contributions to the totals of organs and ground, in a band.
struct TotalContributions {
    OrganContributions organs, ground;

    void include(const OrganContributions& contributions, const Scene& scene, const Organ& organ);
    void include(const TotalContributions& other);
};

/// One contribution to the totals of a band, as flux.
struct TotalSizes {
    ContributionSize organs, ground;  ///< absorbed light
    ContributionSize on_ground;       ///< light on the ground
};
[[nodiscard]] TotalSizes sizes_of(const TotalContributions& all, const std::vector<Flows>& flows);

/// Runs work(first, last, own) for some organs at a time, on all threads, and adds up the
/// contributions by band that it puts into `own`, in the order of organs.
template <typename Work>
void gather_contributions(
    std::size_t begin,
    std::size_t end,
    unsigned threads,
    const Work& work,
    std::vector<TotalContributions>& all) {
    std::vector<std::vector<TotalContributions>> of_blocks(
        blocks_for(end - begin), std::vector<TotalContributions>(all.size()));
    for_each_block(begin, end, threads, [&](std::size_t first, std::size_t last) {
        work(first, last, of_blocks[(first - begin) / kOrgansPerBlock]);
    });
    for (const std::vector<TotalContributions>& own : of_blocks) {
        for (std::size_t b = 0; b < all.size(); ++b) {
            all[b].include(own[b]);
        }
    }
}

/// The contributions of all measured organs. @returns by band
[[nodiscard]] std::vector<TotalContributions> contributions_to_totals(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

/// The light of the whole scene, replicate by replicate, for arithmetic beyond the budget and the
/// fractions of the canopy.
struct TotalReplicates {
    std::string_view name;                ///< as in the budget; or incident, reflected, transmitted
    std::vector<double> values;           ///< [replicate * bands + band], flux
    std::vector<ContributionSize> sizes;  ///< by band: one contribution, as in the budget's errors
};
/// @returns the parts of the budget; and light on the horizontal, light that the canopy reflects,
/// and light on the ground, where these are known
[[nodiscard]] std::vector<TotalReplicates> replicates_of_totals(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec);

}  // namespace quasimc
