// How accurate the light of a question is, and how far it is from a target.

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "results/evaluate.h"
#include "results/organ_blocks.h"
#include "results/question.h"
#include "sums/origin_sums.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Sums over sets, in a band.
struct Pooled {
    double light = 0;
    double variance = 0;  ///< variances of the means
};

/// Sums over all sets of one quantity, per band of the question; independent of the number of
/// threads.
std::vector<Pooled> pool(const AskedLight& asked, const AskedReader& reader, unsigned threads) {
    const std::vector<std::size_t> bands = reader.bands();
    const std::size_t blocks = blocks_for(asked.sets());
    std::vector<std::vector<Pooled>> of_block(blocks, std::vector<Pooled>(bands.size()));
    for_each_block(0, asked.sets(), threads, [&](std::size_t first, std::size_t last) {
        std::vector<Pooled>& own = of_block[first / kOrgansPerBlock];
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t b = 0; b < bands.size(); ++b) {
                const Estimate e = estimate_mean(reader.values(i, bands[b]));
                own[b].light += e.mean;
                own[b].variance += e.standard_error * e.standard_error;
            }
        }
    });
    std::vector<Pooled> sums(bands.size());
    for (const std::vector<Pooled>& block : of_block) {
        for (std::size_t b = 0; b < bands.size(); ++b) {
            sums[b].light += block[b].light;
            sums[b].variance += block[b].variance;
        }
    }
    return sums;
}

double relative_error(const Estimate& estimate) {
    return estimate.standard_error / estimate.mean;
}

/// The error that a target applies to: an upper bound of unsampled light must be small compared
/// with other organs. 0 for organs that can't receive light. Infinite where it is unknown.
double judged_error(const Estimate& estimate, double mean_light) {
    const bool is_unlit = std::isnan(estimate.standard_error);
    const double error = is_unlit ? estimate.ci95_high : estimate.standard_error;
    const double relative = error == 0 ? 0 : error / (is_unlit ? mean_light : estimate.mean);
    return relative >= 0 ? relative : kInfinity;
}

/// The errors of one quantity.
struct AskedErrors {
    std::vector<double> relative;  ///< [set * bands + band]
    std::vector<double> judged;    ///< per set, the largest of all bands
};

AskedErrors errors_of(const AskedLight& asked, const AskedReader& reader, unsigned threads) {
    const std::vector<Pooled> sums = pool(asked, reader, threads);
    const std::vector<std::size_t> bands = reader.bands();
    AskedErrors errors{
        std::vector<double>(asked.sets() * bands.size(), kNan), std::vector<double>(asked.sets())};
    for_each_block(0, asked.sets(), threads, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            for (std::size_t b = 0; b < bands.size(); ++b) {
                const Estimate e = reader.estimate(i, bands[b], reader.values(i, bands[b]));
                const double mean_light = sums[b].light / static_cast<double>(asked.sets());
                errors.relative[i * bands.size() + b] = relative_error(e);
                errors.judged[i] = std::max(errors.judged[i], judged_error(e, mean_light));
            }
        }
    });
    return errors;
}

struct ErrorSpread {
    double median = kNan;
    double worst = kNan;
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

/// The smallest error that a fraction of them does not exceed.
double quantile(std::vector<double> errors, double fraction) {
    const auto count = static_cast<double>(errors.size());
    const double rank = std::clamp(std::ceil(fraction * count), 1.0, count);
    const auto at = errors.begin() + static_cast<std::ptrdiff_t>(rank) - 1;
    std::nth_element(errors.begin(), at, errors.end());
    return *at;
}

}  // namespace

ErrorsSoFar errors_so_far(
    const Sums& sums, const Scene& scene, const EvaluationSpec& spec, const TargetLevel& target) {
    if (!sums->origins.empty()) {
        return errors_so_far(of_all_origins(sums), scene, spec, target);
    }
    std::vector<double> relative;
    double reached = 1, largest = 0;
    for (const AskedLight& asked : asked_light(scene, spec)) {
        const AskedReader reader(sums, scene, spec, asked);
        const AskedErrors errors = errors_of(asked, reader, spec.threads);
        relative.insert(relative.end(), errors.relative.begin(), errors.relative.end());
        const auto at_target = std::count_if(
            errors.judged.begin(), errors.judged.end(),
            [&](double error) { return error <= target.error; });
        reached =
            std::min(reached, static_cast<double>(at_target) / static_cast<double>(asked.sets()));
        largest = std::max(largest, quantile(errors.judged, target.fraction));
    }
    const ErrorSpread spread = spread_of(std::move(relative));
    const bool has_target = target.error > 0;
    return {
        .round =
            {.paths = sums.paths(),
             .median = spread.median,
             .worst = spread.worst,
             .fraction_at_target = has_target ? reached : 0},
        .ratio_to_target = has_target ? largest / target.error : kInfinity};
}

double pooled_error(const Sums& sums, const Scene& scene, const EvaluationSpec& spec) {
    if (!sums->origins.empty()) {
        return pooled_error(of_all_origins(sums), scene, spec);
    }
    double worst = 0;
    bool has_light = false;
    for (const AskedLight& asked : asked_light(scene, spec)) {
        const AskedReader reader(sums, scene, spec, asked);
        const std::vector<std::size_t> bands = reader.bands();
        const std::vector<Pooled> pooled = pool(asked, reader, spec.threads);
        const auto sets = static_cast<double>(asked.sets());
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const double light = pooled[b].light / sets;
            const bool is_dark = !sums->emitted_flux.empty() && sums->emitted_flux[bands[b]] == 0;
            const double error = std::sqrt(pooled[b].variance / sets) / light;
            has_light = has_light || light > 0;
            worst = std::max(worst, light > 0 ? error : is_dark ? 0 : kInfinity);
        }
    }
    return has_light ? worst : kInfinity;
}

}  // namespace quasimc
