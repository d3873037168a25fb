#include "results/patch_error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "base/checks.h"

namespace quasimc {
namespace {

/// A block of the coarser sums in those of both levels.
SumBlock coarse_block(const std::vector<SumBlock>& blocks, const std::string& name) {
    const auto find = [&](const std::string& wanted) {
        return std::find_if(blocks.begin(), blocks.end(), [&](const SumBlock& block) {
            return block.name == wanted;
        });
    };
    const auto coarse = find("coarse_" + name);
    const auto same = coarse == blocks.end() ? find(name) : coarse;
    EXPECT(same != blocks.end());
    return *same;
}

void add_error(const Estimate& coarse, Estimate& e) {
    e = with_patch_error(e, e.mean - coarse.mean);
}

void add_errors(const std::vector<Estimate>& coarse, std::vector<Estimate>& estimates) {
    EXPECT(coarse.size() == estimates.size());
    for (std::size_t i = 0; i < estimates.size(); ++i) {
        add_error(coarse[i], estimates[i]);
    }
}

/// Light that escapes is not sorted on two levels: each part may be as wrong as the whole.
void add_errors_of_escaped(
    const Result& coarse, const std::vector<Estimate>& escaped, DetectorResult& detector) {
    const std::size_t bands = coarse.budget.size();
    for (std::size_t i = 0; i < detector.values.size(); ++i) {
        const std::size_t b = i % bands;
        const double all = escaped[b].mean;
        const double part = all > 0 ? (all - coarse.budget[b].escaped.mean) / all : 0;
        Estimate& e = detector.values[i];
        e = with_patch_error(e, part * e.mean);
    }
}

/// Adds the bins of a block to those of another one of the same shape.
void copy_block(
    const ExactBins& from, const SumBlock& block, const SumBlock& target, ExactBins& to) {
    for (std::size_t row = 0; row < target.rows; ++row) {
        for (std::size_t column = 0; column < target.columns; ++column) {
            to.add(target.bin(row, column), from.steps(block.bin(row, column)));
        }
    }
}

}  // namespace

Sums coarser_sums(const Sums& sums) {
    Sums coarse = sums;
    coarse.layout.patch_levels = PatchLevels::none;
    const std::vector<SumBlock> from = sums.layout.blocks();
    for (std::size_t r = 0; r < sums.replicates.size(); ++r) {
        ExactBins bins(coarse.layout.bins());
        for (const SumBlock& block : coarse.layout.blocks()) {
            copy_block(sums.replicates[r], coarse_block(from, block.name), block, bins);
        }
        coarse.replicates[r] = std::move(bins);
    }
    return coarse;
}

Estimate with_patch_error(const Estimate& e, double difference) {
    const double d = std::abs(difference);
    if (!std::isfinite(d)) {
        return e;
    }
    const double low = e.low - d;
    return {
        e.mean, std::hypot(e.standard_error, d), e.low >= 0 ? std::max(low, 0.0) : low, e.high + d};
}

void add_patch_errors(const Result& coarse, Result& result) {
    add_errors(coarse.values, result.values);
    add_errors(coarse.ratio_values, result.ratio_values);
    add_errors(coarse.groups.values, result.groups.values);
    add_errors(coarse.groups.ratio_values, result.groups.ratio_values);
    std::vector<Estimate> escaped;
    for (std::size_t b = 0; b < result.budget.size(); ++b) {
        BandBudget& budget = result.budget[b];
        const BandBudget& other = coarse.budget[b];
        escaped.push_back(budget.escaped);
        add_error(other.absorbed_by_organs, budget.absorbed_by_organs);
        add_error(other.absorbed_by_ground, budget.absorbed_by_ground);
        add_error(other.escaped, budget.escaped);
    }
    for (std::size_t b = 0; b < result.canopy.size(); ++b) {
        CanopyFractions& canopy = result.canopy[b];
        const CanopyFractions& other = coarse.canopy[b];
        add_error(other.reflectance, canopy.reflectance);
        add_error(other.transmittance, canopy.transmittance);
        add_error(other.absorptance, canopy.absorptance);
        add_error(other.ground_absorptance, canopy.ground_absorptance);
    }
    for (DetectorResult& detector : result.detectors) {
        add_errors_of_escaped(coarse, escaped, detector);
    }
}

}  // namespace quasimc
