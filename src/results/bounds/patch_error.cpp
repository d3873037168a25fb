#include "results/bounds/patch_error.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/checks.h"
#include "results/bounds/patch_error_pool.h"

namespace quasimc {
namespace {

/// Widens all estimates of a result by their differences from another result.
class Widening {
  public:
    explicit Widening(Estimate (*widened)(const Estimate& e, double difference))
        : widened_(widened) {}

    void widen(const Estimate& other, Estimate& e) const { e = widened_(e, e.mean - other.mean); }
    void widen(const std::vector<Estimate>& others, std::vector<Estimate>& estimates) const {
        EXPECT(others.size() == estimates.size());
        for (std::size_t i = 0; i < estimates.size(); ++i) {
            widen(others[i], estimates[i]);
        }
    }
    void widen(const Result& other, Result& result) const;

  private:
    void widen_escaped(
        const Result& other, const std::vector<Estimate>& escaped, DetectorResult& detector) const;

    Estimate (*widened_)(const Estimate& e, double difference);
};

/// Escaped light is not split into two levels: the error of each part may be that of the whole.
void Widening::widen_escaped(
    const Result& other, const std::vector<Estimate>& escaped, DetectorResult& detector) const {
    const std::size_t bands = other.budget.size();
    for (std::size_t i = 0; i < detector.values.size(); ++i) {
        const std::size_t b = i % bands;
        const double all = escaped[b].mean;
        const double part = all > 0 ? (all - other.budget[b].escaped.mean) / all : 0;
        Estimate& e = detector.values[i];
        e = widened_(e, part * e.mean);
    }
}

void Widening::widen(const Result& other, Result& result) const {
    widen(other.values, result.values);
    widen(other.ratio_values, result.ratio_values);
    widen(other.groups.values, result.groups.values);
    widen(other.groups.ratio_values, result.groups.ratio_values);
    std::vector<Estimate> escaped;
    for (std::size_t b = 0; b < result.budget.size(); ++b) {
        BandBudget& budget = result.budget[b];
        const BandBudget& its = other.budget[b];
        escaped.push_back(budget.escaped);
        widen(its.absorbed_by_organs, budget.absorbed_by_organs);
        widen(its.absorbed_by_ground, budget.absorbed_by_ground);
        widen(its.escaped, budget.escaped);
    }
    for (std::size_t b = 0; b < result.canopy.size(); ++b) {
        CanopyFractions& canopy = result.canopy[b];
        const CanopyFractions& its = other.canopy[b];
        widen(its.reflectance, canopy.reflectance);
        widen(its.transmittance, canopy.transmittance);
        widen(its.absorptance, canopy.absorptance);
        widen(its.ground_absorptance, canopy.ground_absorptance);
    }
    for (DetectorResult& detector : result.detectors) {
        widen_escaped(other, escaped, detector);
    }
}

/// Adds the bins of a block to those of another block with the same columns.
/// @param rows  row count of both
void copy_block(
    const ExactBins& from,
    const BlockBins& block,
    const BlockBins& target,
    std::size_t rows,
    ExactBins& to) {
    for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t column = 0; column < target.columns; ++column) {
            to.add(target.bin(row, column), from.quanta(block.bin(row, column)));
        }
    }
}

/// The layout without the blocks of the coarser level.
SumLayout coarser_layout(const SumLayout& layout) {
    SumBlocks blocks = layout.blocks();
    std::erase_if(blocks, [](const SumBlock& block) { return block.name.starts_with(kCoarse); });
    return {layout.regions(), std::move(blocks)};
}

}  // namespace

Sums coarser_sums(const Sums& sums) {
    const SumLayout& from = sums->layout;
    SumData coarse = meaning_of(*sums);
    coarse.layout = coarser_layout(from);
    coarse.paths = sums->paths;
    coarse.samples = sums->samples * sums->replicates.size();
    coarse.digest = sums->digest;
    ExactBins bins(coarse.layout.bins());
    for (const SumBlock& block : coarse.layout.blocks()) {
        const BlockBins own = from.find(kCoarse + block.name);
        const BlockBins source = own.exists() ? own : from.find(block.name);
        const std::size_t rows = block.rows == SumBlock::Rows::regions ? from.regions() : 1;
        for (const ExactBins& replicate : sums->replicates) {
            copy_block(replicate, source, coarse.layout.find(block.name), rows, bins);
        }
    }
    coarse.replicates.push_back(std::move(bins));
    return Sums(std::move(coarse));
}

Estimate with_patch_error(const Estimate& e, double difference) {
    const double d = std::abs(difference);
    if (!std::isfinite(d)) {
        return e;
    }
    const double low = e.ci95_low - d;
    return {
        e.mean, std::hypot(e.standard_error, d), e.ci95_low >= 0 ? std::max(low, 0.0) : low,
        e.ci95_high + d};
}

Estimate with_error(const Estimate& e, double error) {
    // 95 % of a normal distribution.
    constexpr double kReach = 1.96;
    if (!std::isfinite(error)) {
        return e;
    }
    const double reach = kReach * error;
    const double low = e.mean - std::hypot(e.mean - e.ci95_low, reach);
    return {
        e.mean, std::hypot(e.standard_error, error), e.ci95_low >= 0 ? std::max(low, 0.0) : low,
        e.mean + std::hypot(e.ci95_high - e.mean, reach)};
}

void add_patch_errors(
    Result coarse, const Scene& scene, const EvaluationSpec& spec, Result& result) {
    pool_patch_errors(scene, spec, result, coarse);
    Widening(with_patch_error).widen(coarse, result);
}

void add_errors(const Result& raised, Result& result) {
    Widening(with_error).widen(raised, result);
}

}  // namespace quasimc
