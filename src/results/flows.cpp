#include "results/flows.h"

#include <algorithm>
#include <limits>

namespace quasimc {
namespace {

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
            if (is_ground) {
                flows.on_ground += incident * unit(index);
            }
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
        flows.escaped_scattered = std::numeric_limits<double>::quiet_NaN();
        return flows;
    }

    [[nodiscard]] Flows with_escaped(const ExactBins& bins, Flows flows) const {
        const double unit = this->unit(0);
        for (std::size_t s = 0; s < layout_.spectra; ++s) {
            const double weight = sums_.spectra[s][band_] * unit;
            flows.emitted += bins.value(layout_.emitted() + s) * weight;
            flows.escaped += bins.value(layout_.escaped_direct() + s) * weight;
        }
        flows.escaped_scattered = bins.value(layout_.escaped_scattered() + band_) * unit;
        flows.escaped += flows.escaped_scattered;
        flows.cut_off = bins.value(layout_.cut_off() + band_) * unit;
        flows.roulette += bins.value(layout_.scattered_out() + band_) * unit;
        return flows;
    }

    const Sums& sums_;
    const SumLayout& layout_;
    const Scene& scene_;
    std::size_t band_;
};

}  // namespace

BandFlows read_flows(const Sums& sums, const Scene& scene) {
    BandFlows flows(sums.layout.bands);
    for (std::size_t b = 0; b < flows.size(); ++b) {
        const FlowReader reader(sums, scene, b);
        for (const ExactBins& bins : sums.replicates) {
            flows[b].push_back(reader.flows(bins));
        }
    }
    return flows;
}

}  // namespace quasimc
