#include "results/combine.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "sums/statistics.h"

namespace quasimc {

CombinedLight LightCombiner::empty() const {
    return {std::vector<Incident>(replicates() * bands()), std::vector<double>(replicates())};
}

void CombinedLight::add(const CombinedLight& other) {
    for (std::size_t i = 0; i < light.size(); ++i) {
        light[i] += other.light[i];
    }
    for (std::size_t r = 0; r < sunlit.size(); ++r) {
        sunlit[r] += other.sunlit[r];
    }
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
    const LightCombiner& combiner;
};

/// All that a weighted sum needs of its organs.
struct OrganSum {
    CombinedLight light;
    std::vector<OrganContributions> contributions;  ///< by band
    bool is_known = true;                           ///< whether all organs are measured

    void add(const OrganSum& part) {
        light.add(part.light);
        for (std::size_t i = 0; i < contributions.size(); ++i) {
            contributions[i].include(part.contributions[i]);
        }
        is_known = is_known && part.is_known;
    }
};

OrganSum empty_sum(const LightCombiner& combiner) {
    return {combiner.empty(), std::vector<OrganContributions>(combiner.bands())};
}

OrganSum sum_of(const Combination& in, const OrganWeights& of) {
    OrganSum sum = empty_sum(in.combiner);
    sum.is_known = std::ranges::all_of(of.organs, [&](std::uint32_t organ) {
        return is_measured(in.sums, in.scene.organs()[organ]);
    });
    if (!sum.is_known) {
        return sum;
    }
    for (std::uint32_t r = 0; r < in.combiner.replicates(); ++r) {
        in.combiner.add_up(of, r, sum.light);
    }
    sum.contributions = in.combiner.contributions(of);
    return sum;
}

/// Calls use(index, sum) for each weighted sum that is known, on all threads. Long sums are formed
/// in parts of equal size, so that one sum occupies all threads and has the same bits on any
/// number.
template <typename Use>
void for_each_sum(const Combination& in, std::span<const OrganWeights> of, const Use& use) {
    constexpr std::size_t kSumsPerBatch = 4096, kOrgansPerPart = 1024;
    for (std::size_t first = 0; first < of.size(); first += kSumsPerBatch) {
        const std::span batch = of.subspan(first, std::min(kSumsPerBatch, of.size() - first));
        std::vector<OrganWeights> parts;
        std::vector<std::size_t> starts;  // of each sum, among the parts
        for (const OrganWeights& sum : batch) {
            starts.push_back(parts.size());
            for (std::size_t i = 0; i < sum.organs.size(); i += kOrgansPerPart) {
                parts.push_back(sum.part(i, kOrgansPerPart));
            }
        }
        starts.push_back(parts.size());
        std::vector<std::optional<OrganSum>> sums(parts.size());
        parallel_blocks(parts.size(), in.spec.threads, [&](std::uint64_t i, unsigned) {
            sums[i] = sum_of(in, parts[i]);
        });
        parallel_blocks(batch.size(), in.spec.threads, [&](std::uint64_t i, unsigned) {
            OrganSum all =
                starts[i] == starts[i + 1] ? empty_sum(in.combiner) : std::move(*sums[starts[i]]);
            for (std::size_t part = starts[i] + 1; part < starts[i + 1]; ++part) {
                all.add(*sums[part]);
            }
            if (all.is_known) {
                use(first + i, all);
            }
        });
    }
}

/// Puts the values of all replicates in a column of a matrix. @param columns  their number
void put_column(
    const std::vector<double>& own,
    std::size_t column,
    std::size_t columns,
    std::vector<double>& values) {
    for (std::size_t r = 0; r < own.size(); ++r) {
        values[r * columns + column] = own[r];
    }
}

}  // namespace

CombinedReplicates combine_replicates(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    std::span<const OrganWeights> of,
    std::span<const Quantity> quantities) {
    const LightCombiner combiner(sums, scene, spec);
    const Combination in{sums, scene, spec, combiner};
    const std::size_t bands = combiner.bands(), row = quantities.size() * bands;
    CombinedReplicates all;
    all.values.resize(combiner.replicates() * of.size() * row, kUnknownEstimate.mean);
    all.sizes.resize(of.size() * row);
    for_each_sum(in, of, [&](std::size_t index, const OrganSum& sum) {
        for (std::size_t b = 0; b < bands; ++b) {
            const QuantitySamples samples = combiner.samples(sum.light, b, 1);
            for (std::size_t q = 0; q < quantities.size(); ++q) {
                const auto& own = samples[static_cast<std::size_t>(quantities[q])];
                const std::size_t at = index * row + q * bands + b;
                all.sizes[at] = sum.contributions[b].size(quantities[q], own);
                put_column(own, at, of.size() * row, all.values);
            }
        }
    });
    return all;
}

}  // namespace quasimc
