#include "series/basis/light_response.h"

#include <algorithm>
#include <span>

#include "base/checks.h"
#include "scene/repeat_bands.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// Reads one replicate of sums.
class ResponseReader {
  public:
    ResponseReader(const SumData& sums, std::size_t copy, const BasisLayout& layout)
        : sums_(sums), from_(sums.layout), to_(layout), index_(layout), copy_(copy) {
        const auto samples = static_cast<double>(sums.samples);
        for (std::size_t b = 0; b < to_.bands; ++b) {
            flux_.push_back(sums.units.flux[own(b)] / samples);
            spectra_.emplace_back();
            for (std::size_t s = 0; s < sums.spectra.size(); ++s) {
                if (sums.spectra[s][own(b)] > 0) {
                    spectra_[b].push_back(s);
                }
            }
        }
        sunlit_ = sums.units.sunlit_area / samples;
    }

    [[nodiscard]] std::vector<float> read(const ExactBins& bins) const {
        std::vector<float> flux(to_.bins());
        for (std::size_t region = 0; region < to_.regions; ++region) {
            read_region(bins, region, flux);
        }
        for (std::size_t b = 0; b < to_.bands; ++b) {
            put(flux, to_.light.emitted() + b, direct(bins, from_.emitted(), b));
            put(flux, to_.light.escaped_direct() + b, direct(bins, from_.escaped_direct(), b));
            read_flows(bins, b, flux);
        }
        settle(flux);
        return flux;
    }

    /// The first of the bands reserved for this light.
    [[nodiscard]] std::size_t own(std::size_t band) const {
        return repeated_band(band, copy_, sums_.bands() / to_.bands);
    }

  private:
    /// Scales the response of a sky, represented by a number of random directions, to its emitted
    /// flux: their sum varies, and the ratio is more accurate.
    void settle(std::vector<float>& flux) const {
        std::vector<float> factors(to_.bands, 1);
        for (std::size_t b = 0; b < to_.bands; ++b) {
            const float drawn = flux[to_.light.emitted() + b];
            if (drawn > 0) {
                factors[b] = static_cast<float>(sums_.emitted_flux[own(b)]) / drawn;
            }
        }
        const std::vector<BinPart> parts = bin_parts(to_);
        for (std::size_t p = 0; p < parts.size(); ++p) {
            if (parts[p].is_light()) {
                for (float& x : std::span(flux).subspan(index_.first(p), index_.count(p))) {
                    x *= factors[parts[p].band];
                }
            }
        }
    }
    /// Reads where the scattered light of a band went.
    void read_flows(const ExactBins& bins, std::size_t b, std::vector<float>& flux) const {
        const ScatteredBlocks &from = from_.scattered_blocks(), &to = to_.light.scattered_blocks();
        for (BlockBins ScatteredBlocks::*flow :
             {&ScatteredBlocks::escaped, &ScatteredBlocks::scattered_out,
              &ScatteredBlocks::cut_off}) {
            put(flux, (to.*flow).bin(0, b), band(bins, (from.*flow).first, b));
        }
    }
    void read_region(const ExactBins& bins, std::size_t region, std::vector<float>& flux) const {
        for (const SurfaceSide side : kSurfaceSides) {
            for (std::size_t b = 0; b < to_.bands; ++b) {
                put(flux, to_.light.direct(region, side, b),
                    direct(bins, from_.direct(region, side, 0), b));
                put(flux, to_.light.scattered(region, side) + b,
                    band(bins, from_.scattered(region, side), b));
            }
        }
        put(flux, to_.light.sunlit(region), bins.value(from_.sunlit(region)) * sunlit_);
    }
    void put(std::vector<float>& flux, std::size_t bin, double value) const {
        flux[index_.of(bin)] = static_cast<float>(value);
    }
    /// Flux of one band, for bins by band that begin at `first`.
    [[nodiscard]] double band(const ExactBins& bins, std::size_t first, std::size_t b) const {
        return bins.value(first + own(b)) * flux_[b];
    }
    /// Flux of direct light in a band, for bins by spectrum that begin at `first`.
    [[nodiscard]] double direct(const ExactBins& bins, std::size_t first, std::size_t b) const {
        double sum = 0;
        for (const std::size_t s : spectra_[b]) {
            sum += bins.value(first + s) * sums_.spectra[s][own(b)];
        }
        return sum * flux_[b];
    }

    const SumData& sums_;
    LightBlocks from_;
    const BasisLayout& to_;
    BinIndex index_;
    std::size_t copy_;
    std::vector<double> flux_;                       // per band, for one unit
    std::vector<std::vector<std::size_t>> spectra_;  // per band, spectra with light in it
    double sunlit_;
};

/// The bins of suns in one replicate.
std::vector<float> bins_of_suns(const SunLight& light, const BasisLayout& layout) {
    const BinIndex index(layout);
    std::vector<float> bins(layout.bins());
    const auto put = [&](std::size_t bin, double value) {
        bins[index.of(bin)] = static_cast<float>(value);
    };
    for (std::size_t i = 0; i < light.flux.size(); ++i) {
        const std::size_t region = i / (2 * layout.bands);
        const SurfaceSide side = kSurfaceSides[i / layout.bands % 2];
        put(layout.light.direct(region, side, i % layout.bands), light.flux[i]);
    }
    for (std::size_t region = 0; region < layout.regions; ++region) {
        put(layout.light.sunlit(region), light.sunlit_area[region]);
    }
    for (std::size_t b = 0; b < layout.bands; ++b) {
        put(layout.light.emitted() + b, light.emitted[b]);
        put(layout.light.escaped_direct() + b, light.escaped[b]);
    }
    return bins;
}

}  // namespace

LightResponse read_response(const Sums& sums, std::size_t copy, const BasisLayout& layout) {
    EXPECT(sums->units.region_scale.empty());
    const ResponseReader reader(*sums, copy, layout);
    LightResponse response;
    for (const ExactBins& bins : sums->replicates) {
        response.bins.push_back(reader.read(bins));
    }
    for (std::size_t b = 0; b < layout.bands; ++b) {
        response.emitted.push_back(sums->emitted_flux[reader.own(b)]);
    }
    return response;
}

LightResponse response_of_suns(const std::vector<SunLight>& replicates, const BasisLayout& layout) {
    LightResponse response;
    for (const SunLight& light : replicates) {
        response.bins.push_back(bins_of_suns(light, layout));
    }
    response.emitted = replicates.front().emitted;
    return response;
}

}  // namespace quasimc
