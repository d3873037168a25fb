#include "run/light_response.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/checks.h"

namespace quasimc {
namespace {

/// Units of the light of a band that is emitted: sums of several times as much still fit.
constexpr double kUnits = 1 << 28;

enum class Part { direct, scattered, sunlit, none };

/// What a bin holds.
struct BinPart {
    Part part = Part::none;
    std::size_t band = 0;
};

/// Of the bins of a region, then of those of the run.
std::vector<BinPart> bin_parts(const SumLayout& layout) {
    SumLayout one = layout;
    one.regions = 1;
    std::vector<BinPart> parts(one.bins());
    const std::size_t bands = one.bands;
    for (std::size_t b = 0; b < bands; ++b) {
        for (const SurfaceSide side : kSurfaceSides) {
            parts[one.direct(0, side, b)] = {Part::direct, b};
            parts[one.scattered(0, side) + b] = {Part::scattered, b};
            parts[one.coarse_scattered(0, side) + b] = {Part::scattered, b};
        }
        parts[one.emitted() + b] = parts[one.escaped_direct() + b] = {Part::direct, b};
        for (const std::size_t first :
             {one.escaped_scattered(), one.scattered_out(), one.cut_off(), one.coarse_escaped(),
              one.coarse_escaped() + bands, one.coarse_escaped() + 2 * bands}) {
            parts[first + b] = {Part::scattered, b};
        }
    }
    parts[one.sunlit(0)] = {Part::sunlit, 0};
    return parts;
}

/// Reads one replicate of sums.
class ResponseReader {
  public:
    ResponseReader(const Sums& sums, std::size_t first_band, const SumLayout& layout)
        : sums_(sums), from_(sums.layout), to_(layout), first_(first_band) {
        const auto samples = static_cast<double>(sums.samples);
        for (std::size_t b = 0; b < to_.bands; ++b) {
            flux_.push_back(sums.units.flux[first_ + b] / samples);
            spectra_.emplace_back();
            for (std::size_t s = 0; s < from_.spectra; ++s) {
                if (sums.spectra[s][first_ + b] > 0) {
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
            put(flux, to_.emitted() + b, direct(bins, from_.emitted(), b));
            put(flux, to_.escaped_direct() + b, direct(bins, from_.escaped_direct(), b));
            for (std::size_t i = 0; i < 3; ++i) {  // escaped, scattered out, cut off
                const std::size_t fine = from_.escaped_scattered() + i * from_.bands;
                const std::size_t coarse = from_.coarse_escaped() + i * from_.bands;
                put(flux, to_.escaped_scattered() + i * to_.bands + b, band(bins, fine, b));
                put(flux, to_.coarse_escaped() + i * to_.bands + b, band(bins, coarse, b));
            }
        }
        settle(flux);
        return flux;
    }

  private:
    /// Of a sky a number of directions was drawn, which brought more or less than its light: in
    /// proportion to what they brought all of it is known better.
    void settle(std::vector<float>& flux) const {
        std::vector<float> factors(to_.bands, 1);
        for (std::size_t b = 0; b < to_.bands; ++b) {
            const float drawn = flux[to_.emitted() + b];
            if (drawn > 0) {
                factors[b] = static_cast<float>(sums_.emitted_flux[first_ + b]) / drawn;
            }
        }
        const std::vector<BinPart> parts = bin_parts(to_);
        for (std::size_t i = 0; i < flux.size(); ++i) {
            const std::size_t tail = to_.regions * to_.stride();
            const BinPart& bin = parts[i < tail ? i % to_.stride() : i - tail + to_.stride()];
            if (bin.part == Part::direct || bin.part == Part::scattered) {
                flux[i] *= factors[bin.band];
            }
        }
    }
    void read_region(const ExactBins& bins, std::size_t region, std::vector<float>& flux) const {
        for (const SurfaceSide side : kSurfaceSides) {
            for (std::size_t b = 0; b < to_.bands; ++b) {
                put(flux, to_.direct(region, side, b),
                    direct(bins, from_.direct(region, side, 0), b));
                put(flux, to_.scattered(region, side) + b,
                    band(bins, from_.scattered(region, side), b));
                put(flux, to_.coarse_scattered(region, side) + b,
                    band(bins, from_.coarse_scattered(region, side), b));
            }
        }
        put(flux, to_.sunlit(region), bins.value(from_.sunlit(region)) * sunlit_);
    }
    static void put(std::vector<float>& flux, std::size_t bin, double value) {
        flux[bin] = static_cast<float>(value);
    }
    /// Of bins by band that begin at `first`.
    [[nodiscard]] double band(const ExactBins& bins, std::size_t first, std::size_t b) const {
        return bins.value(first + first_ + b) * flux_[b];
    }
    /// Of bins by spectrum that begin at `first`.
    [[nodiscard]] double direct(const ExactBins& bins, std::size_t first, std::size_t b) const {
        double sum = 0;
        for (const std::size_t s : spectra_[b]) {
            sum += bins.value(first + s) * sums_.spectra[s][first_ + b];
        }
        return sum * flux_[b];
    }

    const Sums& sums_;
    const SumLayout &from_, &to_;
    std::size_t first_;
    std::vector<double> flux_;                       // per band, of a unit
    std::vector<std::vector<std::size_t>> spectra_;  // per band, those with light in it
    double sunlit_;
};

}  // namespace

SumLayout common_layout(const Scene& scene) {
    return {
        .regions = scene.regions().size(),
        .spectra = scene.bands().size(),
        .bands = scene.bands().size(),
        .patch_levels = PatchLevels::two};
}

LightResponse read_response(const Sums& sums, std::size_t first_band, const SumLayout& layout) {
    EXPECT(sums.layout.patch_levels == PatchLevels::two && sums.units.region_scale.empty());
    const ResponseReader reader(sums, first_band, layout);
    LightResponse response;
    for (const ExactBins& bins : sums.replicates) {
        response.bins.push_back(reader.read(bins));
    }
    const auto first = sums.emitted_flux.begin() + static_cast<std::ptrdiff_t>(first_band);
    response.emitted.assign(first, first + static_cast<std::ptrdiff_t>(layout.bands));
    return response;
}

LightSum::LightSum(const SumLayout& layout, std::size_t replicates)
    : layout_(layout),
      bins_(replicates, std::vector<double>(layout.bins())),
      emitted_(layout.bands) {}

void LightSum::add(const LightResponse& response, std::span<const double> amounts) {
    std::vector<double> factors;
    for (const BinPart& bin : bin_parts(layout_)) {
        const bool is_light = bin.part == Part::direct || bin.part == Part::scattered;
        const std::size_t first = bin.part == Part::scattered ? layout_.bands : 0;
        factors.push_back(is_light ? amounts[first + bin.band] : 0);
    }
    add_parts(response, factors);
    for (std::size_t b = 0; b < layout_.bands; ++b) {
        emitted_[b] += amounts[b] * response.emitted[b];
    }
}

void LightSum::add_suns(const LightResponse& response, double factor) {
    std::vector<double> factors;
    for (const BinPart& bin : bin_parts(layout_)) {
        const bool is_suns = bin.part == Part::direct || bin.part == Part::sunlit;
        factors.push_back(is_suns ? factor : 0);
    }
    add_parts(response, factors);
    for (std::size_t b = 0; b < layout_.bands; ++b) {
        emitted_[b] += factor * response.emitted[b];
    }
}

/// @param factors  of the bins of each region, then of those of the run
void LightSum::add_parts(const LightResponse& response, std::span<const double> factors) {
    EXPECT(response.bins.size() == bins_.size());
    const std::size_t stride = layout_.stride();
    const std::size_t tail = layout_.regions * stride;
    for (std::size_t r = 0; r < bins_.size(); ++r) {
        const float* from = response.bins[r].data();
        double* to = bins_[r].data();
        for (std::size_t first = 0; first < tail; first += stride) {
            for (std::size_t i = 0; i < stride; ++i) {
                to[first + i] += factors[i] * static_cast<double>(from[first + i]);
            }
        }
        for (std::size_t i = stride; i < factors.size(); ++i) {
            const std::size_t bin = tail + i - stride;
            to[bin] += factors[i] * static_cast<double>(from[bin]);
        }
    }
}

LightSum& LightSum::operator+=(const LightSum& other) {
    for (std::size_t r = 0; r < bins_.size(); ++r) {
        for (std::size_t i = 0; i < bins_[r].size(); ++i) {
            bins_[r][i] += other.bins_[r][i];
        }
    }
    for (std::size_t b = 0; b < emitted_.size(); ++b) {
        emitted_[b] += other.emitted_[b];
    }
    return *this;
}

void LightSum::raise(std::span<const double> parts) {
    for (std::vector<double>& bins : bins_) {
        for (std::size_t i = 0; i < bins.size(); ++i) {
            bins[i] += parts[i] * bins[i];
        }
        const auto copy = [&](std::size_t from, std::size_t to, std::size_t count) {
            std::copy_n(&bins[from], count, &bins[to]);
        };
        for (std::size_t region = 0; region < layout_.regions; ++region) {
            copy(
                layout_.scattered(region, SurfaceSide::upper),
                layout_.coarse_scattered(region, SurfaceSide::upper), 2 * layout_.bands);
        }
        copy(layout_.escaped_scattered(), layout_.coarse_escaped(), 3 * layout_.bands);
    }
}

std::vector<double> LightSum::mean() const {
    std::vector<double> mean(layout_.bins());
    const auto count = static_cast<double>(bins_.size());
    for (const std::vector<double>& bins : bins_) {
        for (std::size_t i = 0; i < mean.size(); ++i) {
            mean[i] += bins[i] / count;
        }
    }
    return mean;
}

bool LightSum::is_dark() const {
    return std::all_of(emitted_.begin(), emitted_.end(), [](double x) { return x == 0; });
}

/// @param units  light of a unit, by bin of a region and then of the run
ExactBins LightSum::exact_bins(std::size_t replicate, std::span<const double> units) const {
    const std::size_t stride = layout_.stride();
    const std::size_t tail = layout_.regions * stride;
    ExactBins bins(layout_.bins());
    for (std::size_t i = 0; i < bins.size(); ++i) {
        const double unit = units[i < tail ? i % stride : i - tail + stride];
        const double value = bins_[replicate][i];
        if (value != 0 && unit > 0) {
            bins.add(i, std::llround(value / unit * ExactBins::kStepsPerUnit));
        }
    }
    return bins;
}

Sums LightSum::sums(const Reading& reading) const {
    Sums sums;
    sums.layout = layout_;
    sums.paths = reading.paths;
    sums.samples = 1;
    sums.emitted_flux = emitted_;
    const auto paths = static_cast<double>(reading.paths);
    for (std::size_t b = 0; b < layout_.bands; ++b) {
        sums.units.flux.push_back(emitted_[b] / kUnits);
        sums.units.flux_per_find.push_back(emitted_[b] / paths);
        sums.spectra.emplace_back(layout_.bands);
        sums.spectra.back()[b] = 1;
    }
    sums.units.sunlit_area = reading.sunlit_area / kUnits;
    sums.units.sunlit_area_per_find = reading.sunlit_area / paths;
    std::vector<double> units;
    for (const BinPart& bin : bin_parts(layout_)) {
        const bool is_area = bin.part == Part::sunlit;
        units.push_back(is_area ? sums.units.sunlit_area : sums.units.flux[bin.band]);
    }
    for (std::size_t r = 0; r < bins_.size(); ++r) {
        sums.replicates.push_back(exact_bins(r, units));
    }
    return sums;
}

}  // namespace quasimc
