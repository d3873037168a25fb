#include "results/combine.h"

#include <algorithm>

#include "base/parallel.h"
#include "results/bounds/physical_bounds.h"
#include "sums/statistics.h"

namespace quasimc {

CombinedLight LightCombiner::empty() const {
    return {std::vector<Incident>(replicates() * bands()), std::vector<double>(replicates())};
}

void LightCombiner::add_up(
    const OrganWeights& of, std::uint32_t replicate, CombinedLight& sum) const {
    for (std::size_t i = 0; i < of.organs.size(); ++i) {
        const OrganReader reader = reader_of(of.organs[i]);
        const double weight = of.weight(i);
        for (std::size_t b = 0; b < bands(); ++b) {
            sum.light[b * replicates() + replicate] += weight * reader.incident(replicate, b);
        }
        sum.sunlit[replicate] += has_sun() ? weight * reader.sunlit_area(replicate) : 0;
    }
}

std::vector<OrganContributions> LightCombiner::contributions(const OrganWeights& of) const {
    std::vector<OrganContributions> all(bands());
    for (std::size_t i = 0; i < of.organs.size(); ++i) {
        const OrganReader reader = reader_of(of.organs[i]);
        for (std::size_t b = 0; b < bands(); ++b) {
            all[b].include(OrganContributions(reader, b), of.weight(i));
        }
    }
    return all;
}

OrganContributions LightCombiner::sunlit_contributions(const OrganWeights& of) const {
    OrganContributions all;
    for (std::size_t i = 0; i < of.organs.size(); ++i) {
        all.include(OrganContributions::sunlit(reader_of(of.organs[i])), of.weight(i));
    }
    return all;
}

QuantitySamples LightCombiner::samples(
    const CombinedLight& sum, std::size_t band, double per_area) const {
    QuantitySamples samples;
    samples.fill(std::vector<double>(replicates()));
    for (std::uint32_t r = 0; r < replicates(); ++r) {
        put_sample(r, sum.light[band * replicates() + r], per_area, samples);
    }
    return samples;
}

namespace {

/// The light that is combined.
struct Combination {
    const Sums& sums;
    const Scene& scene;
    const EvaluationSpec& spec;
    std::span<const OrganWeights> of;

    [[nodiscard]] bool is_known(const OrganWeights& one) const {
        return std::ranges::all_of(one.organs, [&](std::uint32_t organ) {
            return is_measured(sums, scene.organs()[organ]);
        });
    }
};

/// Calls use(index, light) for each weighted sum that is known, on all threads.
template <typename Use>
void for_each_sum(const Combination& in, const LightCombiner& combiner, const Use& use) {
    constexpr std::size_t kSumsPerBatch = 4096;
    for (std::size_t first = 0; first < in.of.size(); first += kSumsPerBatch) {
        const std::size_t batch = std::min(kSumsPerBatch, in.of.size() - first);
        std::vector<CombinedLight> light(batch, combiner.empty());
        const std::size_t replicates = combiner.replicates();
        parallel_blocks(batch * replicates, in.spec.threads, [&](std::uint64_t block, unsigned) {
            const std::size_t i = block / replicates;
            combiner.add_up(
                in.of[first + i], static_cast<std::uint32_t>(block % replicates), light[i]);
        });
        parallel_blocks(batch, in.spec.threads, [&](std::uint64_t i, unsigned) {
            if (in.is_known(in.of[first + i])) {
                use(first + i, light[i]);
            }
        });
    }
}

/// All emitted light may fall on the organ of the largest weight.
OrganLimits limits_of(
    const Combination& in, const PhysicalBounds& bounds, const OrganWeights& one) {
    OrganLimits sum = bounds.none(), own = sum;
    double largest = one.weights.empty() ? 1 : 0;
    for (std::size_t i = 0; i < one.organs.size(); ++i) {
        bounds.find(in.scene.organs()[one.organs[i]], own);
        sum.add(own, one.weight(i));
        largest = std::max(largest, one.weight(i));
    }
    for (double& emitted : sum.emitted) {
        emitted *= largest;
    }
    return sum;
}

double area_of(const Combination& in, const OrganWeights& one) {
    double area = 0;
    for (std::size_t i = 0; i < one.organs.size(); ++i) {
        area += in.scene.organs()[one.organs[i]].area * one.weight(i);
    }
    return area;
}

}  // namespace

std::vector<Estimate> combine(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    std::span<const OrganWeights> of) {
    const Combination in{sums, scene, spec, of};
    const LightCombiner combiner(sums, scene, spec);
    const PhysicalBounds bounds(scene, spec, sums->emitted_flux);
    const std::size_t bands = combiner.bands(), row = kQuantities * bands;
    std::vector<Estimate> values(of.size() * row, kUnknownEstimate);
    for_each_sum(in, combiner, [&](std::size_t index, const CombinedLight& light) {
        const std::vector<OrganContributions> contributions = combiner.contributions(of[index]);
        const OrganLimits limits = limits_of(in, bounds, of[index]);
        for (std::size_t b = 0; b < bands; ++b) {
            const QuantitySamples samples = combiner.samples(light, b, 1);
            for (const QuantityEntry& entry : quantity_table()) {
                const auto q = static_cast<std::size_t>(entry.quantity);
                values[index * row + q * bands + b] = not_above(
                    contributions[b].estimate(entry, 1, samples[q]), limits.of(entry.quantity, b));
            }
        }
    });
    return values;
}

std::vector<Estimate> combine_sunlit(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    std::span<const OrganWeights> of) {
    const Combination in{sums, scene, spec, of};
    const LightCombiner combiner(sums, scene, spec);
    const PhysicalBounds bounds(scene, spec, sums->emitted_flux);
    if (!combiner.has_sun()) {
        return {};
    }
    std::vector<Estimate> values(of.size(), kUnknownEstimate);
    for_each_sum(in, combiner, [&](std::size_t index, const CombinedLight& light) {
        const double area = area_of(in, of[index]);
        std::vector<double> fractions = light.sunlit;
        for (double& each : fractions) {
            each *= area > 0 ? 1 / area : 0;
        }
        const Estimate fraction =
            combiner.sunlit_contributions(of[index]).estimate_sunlit(area, fractions);
        values[index] =
            not_above(scaled(fraction, area), limits_of(in, bounds, of[index]).sunlit_area);
    });
    return values;
}

CombinedReplicates combine_replicates(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    std::span<const OrganWeights> of,
    Quantity quantity) {
    const Combination in{sums, scene, spec, of};
    const LightCombiner combiner(sums, scene, spec);
    const std::size_t bands = combiner.bands();
    CombinedReplicates all;
    all.values.resize(combiner.replicates() * of.size() * bands, kUnknownEstimate.mean);
    all.sizes.resize(of.size() * bands);
    for_each_sum(in, combiner, [&](std::size_t index, const CombinedLight& light) {
        const std::vector<OrganContributions> contributions = combiner.contributions(of[index]);
        for (std::size_t b = 0; b < bands; ++b) {
            const auto samples = combiner.samples(light, b, 1)[static_cast<std::size_t>(quantity)];
            for (std::size_t r = 0; r < samples.size(); ++r) {
                all.values[(r * of.size() + index) * bands + b] = samples[r];
            }
            all.sizes[index * bands + b] = contributions[b].size(quantity, samples);
        }
    });
    return all;
}

CombinedReplicates combine_sunlit_replicates(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    std::span<const OrganWeights> of) {
    const Combination in{sums, scene, spec, of};
    const LightCombiner combiner(sums, scene, spec);
    CombinedReplicates all;
    if (!combiner.has_sun()) {
        return all;
    }
    all.values.resize(combiner.replicates() * of.size(), kUnknownEstimate.mean);
    all.sizes.resize(of.size());
    for_each_sum(in, combiner, [&](std::size_t index, const CombinedLight& light) {
        for (std::size_t r = 0; r < light.sunlit.size(); ++r) {
            all.values[r * of.size() + index] = light.sunlit[r];
        }
        all.sizes[index] = combiner.sunlit_contributions(of[index]).size();
    });
    return all;
}

}  // namespace quasimc
