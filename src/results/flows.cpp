#include "results/flows.h"

#include <algorithm>
#include <limits>

#include "sums/light_blocks.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// Reads the flows of all bands from sums, region by region, as these are stored.
class FlowReader {
  public:
    FlowReader(const Sums& sums, const Scene& scene)
        : sums_(*sums), blocks_(sums_.layout), scene_(scene) {}

    [[nodiscard]] BandFlows flows() const {
        BandFlows all(sums_.bands(), std::vector<Flows>(sums_.replicates.size()));
        for (std::size_t region = 0; region < sums_.layout.regions(); ++region) {
            for (std::size_t b = 0; b < all.size(); ++b) {
                add_region(region, b, all[b]);
            }
        }
        for (std::size_t b = 0; b < all.size(); ++b) {
            for (std::size_t r = 0; r < all[b].size(); ++r) {
                all[b][r] = sums_.escaped == EscapedLight::remainder
                                ? with_remainder(b, all[b][r])
                                : with_escaped(sums_.replicates[r], b, all[b][r]);
            }
        }
        return all;
    }

  private:
    [[nodiscard]] double unit(std::size_t region, std::size_t band) const {
        return sums_.units.flux[band] * sums_.units.scale(region) /
               static_cast<double>(sums_.samples);
    }

    /// Adds the light that falls on a region and that it absorbs or may scatter.
    void add_region(std::size_t index, std::size_t band, std::vector<Flows>& flows) const {
        const Region& region = scene_.regions()[index];
        const Material& material = data_of(scene_).material(region);
        const bool is_ground = scene_.organs()[region.organ.value].is_ground;
        double Flows::*absorbed = is_ground ? &Flows::ground : &Flows::organs;
        const bool is_summed = blocks_.has_absorbed();
        const double unit = this->unit(index, band);
        for (std::size_t r = 0; is_summed && r < flows.size(); ++r) {
            const ExactBins& bins = sums_.replicates[r];
            const double own = (bins.value(blocks_.absorbed_direct(index) + band) +
                                bins.value(blocks_.absorbed_scattered(index) + band)) *
                               unit;
            flows[r].*absorbed += own;
            flows[r].imbalance += !material.is_transparent() ? own : 0;
        }
        for (const SurfaceSide which : kSurfaceSides) {
            const double absorptance = material.side(which).absorptance()[band];
            const double albedo = is_summed ? 1 : material.side(which).albedo()[band];
            for (std::size_t r = 0; r < flows.size(); ++r) {
                const double light = incident(sums_.replicates[r], index, which, band) * unit;
                flows[r].on_ground += is_ground ? light : 0;
                flows[r].*absorbed += is_summed ? 0 : light * absorptance;
                flows[r].imbalance -= material.is_transparent() ? 0 : light * albedo;
            }
        }
    }

    /// Units of light on a side.
    [[nodiscard]] double incident(
        const ExactBins& bins, std::size_t region, SurfaceSide side, std::size_t band) const {
        double sum = bins.value(blocks_.scattered(region, side) + band);
        const std::size_t direct = blocks_.direct(region, side, 0);
        for (std::size_t s = 0; s < sums_.spectra.size(); ++s) {
            sum += bins.value(direct + s) * sums_.spectra[s][band];
        }
        return sum;
    }

    /// Sets escaped light to the remainder of the budget.
    [[nodiscard]] Flows with_remainder(std::size_t band, Flows flows) const {
        flows.emitted = sums_.emitted_flux[band];
        flows.imbalance = 0;
        const std::vector<Organ>& all = scene_.organs();
        const bool is_all =
            sums_.measured == MeasuredOrgans::all ||
            std::all_of(all.begin(), all.end(), [](const Organ& organ) { return organ.measured; });
        if (!is_all) {
            flows.organs = flows.ground = std::numeric_limits<double>::quiet_NaN();
            flows.on_ground = is_ground_known() ? flows.on_ground : flows.ground;
        }
        flows.escaped = flows.emitted - flows.organs - flows.ground;
        flows.escaped_scattered = std::numeric_limits<double>::quiet_NaN();
        return flows;
    }

    /// Whether the light on the ground, if there is one, was computed.
    [[nodiscard]] bool is_ground_known() const {
        const Organ& last = scene_.organs().back();
        return !last.is_ground || last.measured;
    }

    [[nodiscard]] Flows with_escaped(const ExactBins& bins, std::size_t band, Flows flows) const {
        const double unit = this->unit(0, band);
        for (std::size_t s = 0; s < sums_.spectra.size(); ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            flows.emitted += bins.value(blocks_.emitted() + s) * weight;
            flows.escaped += bins.value(blocks_.escaped_direct() + s) * weight;
        }
        flows.escaped_scattered = bins.value(blocks_.escaped_scattered() + band) * unit;
        flows.escaped += flows.escaped_scattered;
        flows.cut_off = bins.value(blocks_.cut_off() + band) * unit;
        flows.imbalance += bins.value(blocks_.scattered_out() + band) * unit;
        return flows;
    }

    const SumData& sums_;
    LightBlocks blocks_;
    const Scene& scene_;
};

}  // namespace

BandFlows read_flows(const Sums& sums, const Scene& scene) {
    return FlowReader(sums, scene).flows();
}

std::vector<double> values_of(const std::vector<Flows>& flows, double Flows::*part) {
    std::vector<double> values;
    values.reserve(flows.size());
    for (const Flows& one : flows) {
        values.push_back(one.*part);
    }
    return values;
}

}  // namespace quasimc
