#include <algorithm>
#include <cmath>
#include <limits>

#include "results/evaluate.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

/// Where the light of one band and replicate went.
struct Flows {
    double emitted = 0, organs = 0, ground = 0, escaped = 0, cut_off = 0, roulette = 0;
};

/// Reads the flows of one replicate from sums.
class FlowReader {
  public:
    FlowReader(const Sums& sums, const Scene& scene, std::size_t band)
        : sums_(sums), layout_(sums.layout), scene_(scene), band_(band) {}

    [[nodiscard]] Flows flows(const ExactBins& bins) const {
        Flows flows;
        for (std::size_t region = 0; region < layout_.regions; ++region) {
            add_region(bins, region, flows);
        }
        return sums_.escaped == EscapedLight::remainder ? with_remainder(flows)
                                                        : with_escaped(bins, flows);
    }

  private:
    [[nodiscard]] double unit(std::size_t region) const {
        return sums_.units.flux[band_] * sums_.units.scale(region) /
               static_cast<double>(sums_.samples);
    }

    /// What falls on a region, and what it absorbs and may scatter of it.
    void add_region(const ExactBins& bins, std::size_t index, Flows& flows) const {
        const Region& region = scene_.regions()[index];
        const Material& material = scene_.material(region);
        const bool is_ground = scene_.organs()[region.organ.value].is_ground;
        double& absorbed = is_ground ? flows.ground : flows.organs;
        const bool is_summed = layout_.absorbed_light == AbsorbedLight::summed;
        const double own = is_summed ? (bins.value(layout_.absorbed_direct(index) + band_) +
                                        bins.value(layout_.absorbed_scattered(index) + band_)) *
                                           unit(index)
                                     : 0;
        absorbed += own;
        flows.roulette += is_summed && !material.is_transparent() ? own : 0;
        for (const SurfaceSide which : kSurfaceSides) {
            double incident = bins.value(layout_.scattered(index, which) + band_);
            for (std::size_t s = 0; s < layout_.spectra; ++s) {
                incident += bins.value(layout_.direct(index, which, s)) * sums_.spectra[s][band_];
            }
            const Side& side = material.side(which);
            if (!is_summed) {
                absorbed += incident * unit(index) * side.absorptance()[band_];
            }
            if (!material.is_transparent()) {
                flows.roulette -= incident * unit(index) * (is_summed ? 1 : side.albedo()[band_]);
            }
        }
    }

    /// Where escaped light is what is left.
    [[nodiscard]] Flows with_remainder(Flows flows) const {
        flows.emitted = sums_.emitted_flux[band_];
        flows.roulette = 0;
        const std::vector<Organ>& all = scene_.organs();
        const bool is_all =
            sums_.measured == MeasuredOrgans::all ||
            std::all_of(all.begin(), all.end(), [](const Organ& organ) { return organ.measured; });
        if (!is_all) {
            flows.organs = flows.ground = std::numeric_limits<double>::quiet_NaN();
        }
        flows.escaped = flows.emitted - flows.organs - flows.ground;
        return flows;
    }

    [[nodiscard]] Flows with_escaped(const ExactBins& bins, Flows flows) const {
        const double unit = this->unit(0);
        for (std::size_t s = 0; s < layout_.spectra; ++s) {
            const double weight = sums_.spectra[s][band_] * unit;
            flows.emitted += bins.value(layout_.emitted() + s) * weight;
            flows.escaped += bins.value(layout_.escaped_direct() + s) * weight;
        }
        flows.escaped += bins.value(layout_.escaped_scattered() + band_) * unit;
        flows.cut_off = bins.value(layout_.cut_off() + band_) * unit;
        flows.roulette += bins.value(layout_.scattered_out() + band_) * unit;
        return flows;
    }

    const Sums& sums_;
    const SumLayout& layout_;
    const Scene& scene_;
    std::size_t band_;
};

Estimate estimate_of(const std::vector<Flows>& flows, double Flows::*part) {
    std::vector<double> values;
    values.reserve(flows.size());
    for (const Flows& one : flows) {
        values.push_back(one.*part);
    }
    return estimate_mean(values);
}

}  // namespace

std::vector<BandBudget> evaluate_budget(const Sums& sums, const Scene& scene) {
    std::vector<BandBudget> budget;
    for (std::size_t b = 0; b < sums.layout.bands; ++b) {
        const FlowReader reader(sums, scene, b);
        std::vector<Flows> flows;
        double worst = 0;
        for (const ExactBins& bins : sums.replicates) {
            flows.push_back(reader.flows(bins));
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
