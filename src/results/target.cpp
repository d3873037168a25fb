// How accurate the absorbed light of organs is, and how far it is from a target.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "results/bounds/organ_contributions.h"
#include "results/bounds/organ_reader.h"
#include "results/evaluate.h"
#include "results/organ_blocks.h"

namespace quasimc {
namespace {

/// Adds the mean flux that an organ absorbs, per band.
void add_absorbed(const OrganReader& reader, std::vector<double>& flux) {
    const std::uint32_t replicates = reader.replicates();
    for (std::size_t b = 0; b < flux.size(); ++b) {
        double sum = 0;
        for (std::uint32_t r = 0; r < replicates; ++r) {
            sum += reader.incident(r, b).absorbed;
        }
        flux[b] += sum / replicates;
    }
}

/// Mean flux that a measured organ absorbs, per band; independent of the number of threads.
std::vector<double> mean_absorbed_flux(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    const std::size_t bands = sums->bands();
    const SumReader reader(sums);
    std::vector<std::vector<double>> of_block(blocks_of(scene));
    std::atomic<std::size_t> count{0};
    for_each_block(scene, spec.threads, [&](std::size_t first, std::size_t last) {
        std::vector<double>& flux = of_block[first / kOrgansPerBlock];
        flux.resize(bands);
        for (std::size_t i = first; i < last; ++i) {
            const Organ& organ = scene.organs()[i];
            if (is_measured(sums, organ)) {
                add_absorbed(OrganReader(reader, scene, spec, organ), flux);
                ++count;
            }
        }
    });
    std::vector<double> mean(bands);
    for (const std::vector<double>& flux : of_block) {
        for (std::size_t b = 0; b < bands; ++b) {
            mean[b] += flux[b] / std::max(static_cast<double>(count), 1.0);
        }
    }
    return mean;
}

/// Absorbed flux of an organ in a band.
Estimate absorbed_flux(const OrganReader& reader, std::size_t band) {
    std::vector<double> absorbed(reader.replicates());
    for (std::uint32_t r = 0; r < absorbed.size(); ++r) {
        absorbed[r] = reader.incident(r, band).absorbed;
    }
    return OrganContributions(reader, band).estimate(quantity_table().front(), 0, absorbed);
}

/// Whether the absorbed flux of an organ meets the target in every band, as it does for organs that
/// can't absorb. An upper bound of unsampled light must be small compared with other organs.
/// @param absorbed  [band]
bool is_at_target(
    const std::vector<Estimate>& absorbed, double target, const std::vector<double>& mean_flux) {
    for (std::size_t b = 0; b < absorbed.size(); ++b) {
        const Estimate& estimate = absorbed[b];
        const bool is_unlit = std::isnan(estimate.standard_error);
        const bool is_known = is_unlit ? estimate.ci95_high <= target * mean_flux[b]
                                       : estimate.standard_error <= target * estimate.mean;
        if (!is_known) {
            return false;
        }
    }
    return true;
}

double relative_error(const Estimate& estimate) {
    return estimate.standard_error / estimate.mean;
}

struct ErrorSpread {
    double median = std::numeric_limits<double>::quiet_NaN();
    double worst = std::numeric_limits<double>::quiet_NaN();
};

/// Statistics of the finite errors; NaN without any.
ErrorSpread spread_of(std::vector<double> errors) {
    std::erase_if(errors, [](double error) { return !std::isfinite(error); });
    if (errors.empty()) {
        return {};
    }
    const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
    std::nth_element(errors.begin(), middle, errors.end());
    return {*middle, *std::max_element(middle, errors.end())};
}

}  // namespace

RoundErrors errors_so_far(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, double target) {
    const std::size_t bands = sums->bands();
    const SumReader sum_reader(sums);
    const std::vector<double> mean_flux =
        target > 0 ? mean_absorbed_flux(sums, scene, spec) : std::vector<double>();
    std::atomic<std::size_t> reached{0};
    std::vector<double> errors(
        scene.organs().size() * bands, std::numeric_limits<double>::quiet_NaN());
    for_each_block(scene, spec.threads, [&](std::size_t first, std::size_t last) {
        std::vector<Estimate> absorbed(bands);
        for (std::size_t i = first; i < last; ++i) {
            const Organ& organ = scene.organs()[i];
            if (!is_measured(sums, organ)) {
                ++reached;
                continue;
            }
            const OrganReader reader(sum_reader, scene, spec, organ);
            for (std::size_t b = 0; b < bands; ++b) {
                absorbed[b] = absorbed_flux(reader, b);
            }
            if (!organ.is_ground) {
                const auto at = errors.begin() + static_cast<std::ptrdiff_t>(i * bands);
                std::transform(absorbed.begin(), absorbed.end(), at, relative_error);
            }
            const bool is_covered = organ.covered_area >= kFullyLit * organ.area;
            reached +=
                is_covered || (target > 0 && is_at_target(absorbed, target, mean_flux)) ? 1 : 0;
        }
    });
    const auto organs = static_cast<double>(scene.organs().size());
    const ErrorSpread spread = spread_of(std::move(errors));
    return {
        .paths = sums.paths(),
        .median = spread.median,
        .worst = spread.worst,
        .fraction_at_target = target > 0 ? static_cast<double>(reached) / organs : 0};
}

}  // namespace quasimc
