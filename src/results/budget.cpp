#include <algorithm>
#include <cmath>
#include <limits>

#include "results/evaluate.h"

namespace quasimc {
namespace {

/// Where the light of one band and replicate went.
struct Flows {
    double emitted = 0, organs = 0, ground = 0, escaped = 0, cut_off = 0, roulette = 0;
};

/// What falls on the elements, and what they absorb and may scatter of it.
void add_elements(
    const Evaluation& evaluation, std::uint32_t replicate, std::size_t band, Flows& flows) {
    const TallyLayout& layout = evaluation.replicates.layout();
    const std::span<const std::int64_t> cells = evaluation.replicates.cells(replicate);
    const auto& spectra = evaluation.prepared.spectra();
    for (std::uint32_t e = 0; e < layout.regions; ++e) {
        const Material& material = evaluation.prepared.material(e);
        const double unit = evaluation.estimator.flux_per_unit(e, band, evaluation.paths);
        const bool ground = e + evaluation.prepared.ground_regions() >= layout.regions;
        for (const bool lower : {false, true}) {
            double incident = from_fixed(cells[layout.scattered(e, lower) + band]);
            for (std::size_t s = 0; s < layout.spectra; ++s) {
                incident += from_fixed(cells[layout.direct(e, lower, s)]) * spectra[s][band];
            }
            const Side& side = material.side(!lower);
            (ground ? flows.ground : flows.organs) += incident * unit * side.absorptance()[band];
            if (!material.is_transparent()) {
                flows.roulette -= incident * unit * side.albedo()[band];
            }
        }
    }
}

Flows flows_of(const Evaluation& evaluation, std::uint32_t replicate, std::size_t band) {
    Flows flows;
    add_elements(evaluation, replicate, band, flows);
    if (!evaluation.estimator.counts_escapes()) {
        flows.emitted = evaluation.prepared.flux()[band];
        flows.roulette = 0;
        const std::vector<Organ>& all = evaluation.prepared.scene().organs();
        if (!std::all_of(all.begin(), all.end(), [&](const Organ& organ) {
                return evaluation.estimator.measures(organ);
            })) {
            flows.organs = flows.ground = std::numeric_limits<double>::quiet_NaN();
        }
        flows.escaped = flows.emitted - flows.organs - flows.ground;
        return flows;
    }
    const TallyLayout& layout = evaluation.replicates.layout();
    const std::span<const std::int64_t> cells = evaluation.replicates.cells(replicate);
    const double unit = evaluation.estimator.flux_per_unit(0, band, evaluation.paths);
    for (std::size_t s = 0; s < layout.spectra; ++s) {
        const double weight = evaluation.prepared.spectra()[s][band] * unit;
        flows.emitted += from_fixed(cells[layout.emitted() + s]) * weight;
        flows.escaped += from_fixed(cells[layout.escaped_direct() + s]) * weight;
    }
    flows.escaped += from_fixed(cells[layout.escaped_scattered() + band]) * unit;
    flows.cut_off = from_fixed(cells[layout.cut_off() + band]) * unit;
    flows.roulette += from_fixed(cells[layout.scattered_out() + band]) * unit;
    return flows;
}

Estimate estimate_of(const std::vector<Flows>& flows, double Flows::*part) {
    std::vector<double> values;
    values.reserve(flows.size());
    for (const Flows& one : flows) {
        values.push_back(one.*part);
    }
    return estimate_mean(values);
}

}  // namespace

std::vector<BandBudget> evaluate_budget(const Evaluation& evaluation) {
    std::vector<BandBudget> budget;
    for (std::size_t b = 0; b < evaluation.prepared.bands(); ++b) {
        std::vector<Flows> flows;
        double worst = 0;
        for (std::uint32_t r = 0; r < evaluation.replicates.count(); ++r) {
            flows.push_back(flows_of(evaluation, r, b));
            const Flows& f = flows.back();
            const double open =
                f.emitted + f.roulette - f.organs - f.ground - f.escaped - f.cut_off;
            worst = std::max(worst, f.emitted > 0 ? std::abs(open) / f.emitted : 0);
        }
        budget.push_back(
            {.emitted = estimate_of(flows, &Flows::emitted).mean,
             .absorbed_by_organs = estimate_of(flows, &Flows::organs),
             .absorbed_by_ground = estimate_of(flows, &Flows::ground),
             .escaped = estimate_of(flows, &Flows::escaped),
             .cut_off = estimate_of(flows, &Flows::cut_off),
             .roulette = estimate_of(flows, &Flows::roulette),
             .closure_error = worst});
    }
    return budget;
}

}  // namespace quasimc
