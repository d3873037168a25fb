#include "series/basis/light_sum.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/checks.h"
#include "base/parallel.h"
#include "samplers/balanced_numbers.h"
#include "samplers/hash.h"
#include "series/basis/add_responses.h"
#include "sums/statistics.h"
#include "sums/sum_data.h"

namespace quasimc {
namespace {

/// Units per emitted light of a band: sums of several times as much still fit.
constexpr double kUnits = 1 << 28;

/// Rounds to nearest, inline: the library's function costs more than all other work on a bin.
[[nodiscard]] std::int64_t rounded(double x) {
    return static_cast<std::int64_t>(x + std::copysign(0.5, x));
}

/// Number of bins that stay in the caches while they are added to several sums.
constexpr std::size_t kChunk = 256;

/// Adjacent bins of a replicate, and the amount of each response that applies to them.
struct BinRange {
    std::size_t replicate, first, count;
    std::size_t amount, amounts;  // index and number of amounts
};

[[nodiscard]] constexpr std::size_t padded(std::size_t count) {
    return (count + kAddedAtOnce - 1) / kAddedAtOnce * kAddedAtOnce;
}

/// The responses that have bins, padded with the first of them.
std::vector<std::size_t> used_responses(std::span<const LightResponse> responses) {
    std::vector<std::size_t> used;
    for (std::size_t k = 0; k < responses.size(); ++k) {
        if (!responses[k].bins.empty()) {
            used.push_back(k);
        }
    }
    used.resize(padded(used.size()), used.empty() ? 0 : used.front());
    return used;
}

/// Factors of responses, [response][sum]; 0 for padding.
std::vector<double> factors_of(
    std::span<const std::size_t> used,
    std::span<const std::vector<double>* const> amounts,
    const BinRange& bins) {
    const std::size_t sums = padded(amounts.size());
    std::vector<double> factors(used.size() * sums);
    for (std::size_t k = 0; k < used.size(); ++k) {
        const bool is_padding = k > 0 && used[k] == used.front();
        for (std::size_t i = 0; i < amounts.size() && !is_padding; ++i) {
            factors[k * sums + i] = (*amounts[i])[used[k] * bins.amounts + bins.amount];
        }
    }
    return factors;
}

/// Adds all responses to each of several sums.
/// @param to  the first bin of the range in each
void add_all(
    std::span<const LightResponse> responses,
    std::span<const std::vector<double>* const> amounts,
    const BinRange& bins,
    std::span<double* const> to) {
    static const AddResponses add = best_add_responses();
    const std::vector<std::size_t> used = used_responses(responses);
    const std::vector<double> factors = factors_of(used, amounts, bins);
    std::vector<double> nowhere(kChunk);
    std::vector<double*> at(padded(to.size()), nowhere.data());
    std::vector<const float*> from(used.size());
    for (std::size_t begin = 0; begin < bins.count; begin += kChunk) {
        for (std::size_t k = 0; k < used.size(); ++k) {
            from[k] = &responses[used[k]].bins[bins.replicate][bins.first + begin];
        }
        for (std::size_t i = 0; i < to.size(); ++i) {
            at[i] = to[i] + begin;
        }
        const std::size_t count = std::min(kChunk, bins.count - begin);
        add(from.data(), factors.data(), used.size(), count, at.size(), at.data());
    }
}

}  // namespace

LightSum::LightSum(const BasisLayout& layout, std::size_t replicates)
    : layout_(layout),
      bins_(replicates, std::vector<double>(layout.bins())),
      emitted_(layout.bands) {}

void LightSum::combine(
    std::span<const LightResponse> responses,
    std::span<const std::vector<double>> amounts,
    std::span<LightSum> sums,
    unsigned threads) {
    EXPECT(!sums.empty() && sums.size() == amounts.size());
    const LightSum& any = sums.front();
    const std::vector<BinPart> parts = bin_parts(any.layout_);
    const BinIndex index(any.layout_);
    const std::size_t bands = any.layout_.bands;
    std::vector<std::size_t> lit;  // most hours of a night have no light
    std::vector<const std::vector<double>*> amounts_of_lit;
    for (std::size_t i = 0; i < sums.size(); ++i) {
        const auto is_some = [](double amount) { return amount != 0; };
        if (std::any_of(amounts[i].begin(), amounts[i].end(), is_some)) {
            lit.push_back(i);
            amounts_of_lit.push_back(&amounts[i]);
        }
    }
    parallel_blocks(any.bins_.size() * parts.size(), threads, [&](std::uint64_t block, unsigned) {
        const std::size_t replicate = block / parts.size();
        const std::size_t p = block % parts.size();
        for (LightSum& sum : sums) {
            std::fill_n(&sum.bins_[replicate][index.first(p)], index.count(p), 0.0);
        }
        if (!parts[p].is_light() || lit.empty()) {
            return;
        }
        std::vector<double*> to;
        to.reserve(lit.size());
        for (const std::size_t i : lit) {
            to.push_back(&sums[i].bins_[replicate][index.first(p)]);
        }
        add_all(
            responses, amounts_of_lit,
            {replicate, index.first(p), index.count(p), parts[p].amount(bands), 2 * bands}, to);
    });
    for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].set_emitted(responses, amounts[i]);
    }
}

void LightSum::set_emitted(
    std::span<const LightResponse> responses, std::span<const double> amounts) {
    const std::size_t bands = layout_.bands;
    emitted_.assign(bands, 0);
    for (std::size_t k = 0; k < responses.size(); ++k) {
        for (std::size_t b = 0; b < bands && !responses[k].bins.empty(); ++b) {
            emitted_[b] += amounts[2 * k * bands + b] * responses[k].emitted[b];
        }
    }
}

void LightSum::add(const LightResponse& response, std::span<const double> amounts) {
    std::vector<double> factors;
    for (const BinPart& bin : bin_parts(layout_)) {
        factors.push_back(bin.is_light() ? amounts[bin.amount(layout_.bands)] : 0);
    }
    add_parts(response, factors);
    for (std::size_t b = 0; b < layout_.bands; ++b) {
        emitted_[b] += amounts[b] * response.emitted[b];
    }
}

void LightSum::add_suns(const LightResponse& response, double factor) {
    std::vector<double> factors;
    for (const BinPart& bin : bin_parts(layout_)) {
        const bool is_suns = bin.kind == BinPart::Kind::direct || bin.kind == BinPart::Kind::sunlit;
        factors.push_back(is_suns ? factor : 0);
    }
    add_parts(response, factors);
    for (std::size_t b = 0; b < layout_.bands; ++b) {
        emitted_[b] += factor * response.emitted[b];
    }
}

/// @param factors  for the bins of each region, then for those of the run
void LightSum::add_parts(const LightResponse& response, std::span<const double> factors) {
    EXPECT(response.bins.size() == bins_.size());
    const BinIndex index(layout_);
    for (std::size_t r = 0; r < response.bins.size(); ++r) {
        for (std::size_t part = 0; part < factors.size(); ++part) {
            const float* from = &response.bins[r][index.first(part)];
            double* to = &bins_[r][index.first(part)];
            const double factor = factors[part];
            for (std::size_t i = 0; factor != 0 && i < index.count(part); ++i) {
                to[i] += factor * static_cast<double>(from[i]);
            }
        }
    }
}

void LightSum::add(const LightSum& other, double factor) {
    for (std::size_t r = 0; r < bins_.size(); ++r) {
        for (std::size_t i = 0; i < bins_[r].size(); ++i) {
            bins_[r][i] += factor * other.bins_[r][i];
        }
    }
    for (std::size_t b = 0; b < emitted_.size(); ++b) {
        emitted_[b] += factor * other.emitted_[b];
    }
}

LightSum LightSum::deviations(
    std::span<const double> errors, const std::vector<bool>& is_opaque, std::uint64_t key) const {
    LightSum found(layout_, bins_.size());
    const BinIndex index(layout_);
    const std::vector<BinPart> parts = bin_parts(layout_);
    for (std::size_t i = 0; i < layout_.regions + 1; ++i) {  // all regions, and the run
        const std::vector<double> pattern = balanced_numbers(bins_.size(), mix64(key ^ mix64(i)));
        const bool is_region = i < layout_.regions;
        const std::size_t first = is_region ? 0 : layout_.sums.stride();
        const std::size_t end = is_region ? layout_.sums.stride() : parts.size();
        for (std::size_t part = first; part < end; ++part) {
            const std::size_t bin = index.first(part) + (is_region ? i : 0);
            found.deviate(bin, errors[bin] * mean_of(bin), pattern);
            if (parts[part].is_light() && (!is_region || is_opaque[i])) {
                found.scatter_too(bin, parts[part].band);
            }
        }
    }
    return found;
}

/// The mean of a bin over the replicates.
double LightSum::mean_of(std::size_t bin) const {
    double sum = 0;
    for (const std::vector<double>& bins : bins_) {
        sum += bins[bin];
    }
    return sum / static_cast<double>(bins_.size());
}

void LightSum::deviate(std::size_t bin, double error, const std::vector<double>& pattern) {
    const auto is_of = [&](std::size_t first) {
        return bin >= first && bin < first + layout_.bands;
    };
    const bool is_fixed = is_of(layout_.light.emitted()) || is_of(layout_.light.scattered_out());
    for (std::size_t r = 0; r < bins_.size() && !is_fixed; ++r) {
        bins_[r][bin] = error * pattern[r];
    }
}

/// Adds a bin to the light that surfaces scatter.
void LightSum::scatter_too(std::size_t bin, std::size_t band) {
    const std::size_t scattered = layout_.light.scattered_out() + band;
    for (std::size_t r = 0; r < bins_.size() && bin != scattered; ++r) {
        bins_[r][scattered] += bins_[r][bin];
    }
}

SumWithVariance LightSum::spread(std::span<const double> errors) const {
    const BinIndex index(layout_);
    const auto count = static_cast<double>(bins_.size());
    SumWithVariance spread{std::vector<double>(layout_.bands), std::vector<double>(layout_.bands)};
    std::vector<double> light(bins_.size());
    for (std::size_t i = 0; i < layout_.regions * layout_.bands; ++i) {
        const std::size_t region = i / layout_.bands;
        const std::size_t band = i % layout_.bands;
        std::vector<std::size_t> own;
        for (const SurfaceSide side : kSurfaceSides) {
            own.push_back(index.of(layout_.light.direct(region, side, band)));
            own.push_back(index.of(layout_.light.scattered(region, side) + band));
        }
        std::fill(light.begin(), light.end(), 0);
        double error = 0;
        for (std::size_t k = 0; k < own.size() * light.size(); ++k) {
            const std::size_t own_bin = own[k % own.size()];
            const double value = bins_[k / own.size()][own_bin];
            light[k / own.size()] += value;
            error += errors.empty() ? 0 : errors[own_bin] * value / count;
        }
        const Estimate found = estimate_mean(light);
        spread.light[band] += found.mean;
        spread.variance[band] += found.standard_error * found.standard_error + error * error;
    }
    return spread;
}

bool LightSum::is_dark() const {
    return std::all_of(emitted_.begin(), emitted_.end(), [](double x) { return x == 0; });
}

/// @param units  light per unit, by bin of a region and then of the run
ExactBins LightSum::exact_bins(std::size_t replicate, std::span<const double> units) const {
    const std::size_t stride = layout_.sums.stride();
    const BinIndex index(layout_);
    ExactBins bins(layout_.bins());
    const auto put = [&](std::size_t bin, double value, double unit) {
        if (value != 0 && unit > 0) {
            bins.add(bin, rounded(value / unit * ExactBins::kQuantaPerUnit));
        }
    };
    for (std::size_t part = 0; part < units.size(); ++part) {
        const double* values = &bins_[replicate][index.first(part)];
        for (std::size_t i = 0; i < index.count(part); ++i) {
            const std::size_t bin = part < stride ? i * stride + part : index.first(part);
            put(bin, values[i], units[part]);
        }
    }
    return bins;
}

Sums LightSum::sums(const Reading& reading) const {
    SumData sums;
    sums.layout = layout_.sums;
    sums.paths = reading.paths;
    sums.samples = 1;
    sums.emitted_flux = emitted_;
    const auto paths = static_cast<double>(reading.paths);
    ContributionBound light{"direct", {}};
    for (std::size_t b = 0; b < layout_.bands; ++b) {
        sums.units.flux.push_back(emitted_[b] / kUnits);
        light.largest.push_back(emitted_[b] / paths);
        sums.spectra.emplace_back(layout_.bands);
        sums.spectra.back()[b] = 1;
    }
    sums.units.sunlit_area = reading.sunlit_area / kUnits;
    sums.bounds = {light, {"scattered", light.largest}, {"sunlit", {reading.sunlit_area / paths}}};
    std::vector<double> units;
    for (const BinPart& bin : bin_parts(layout_)) {
        const bool is_area = bin.kind == BinPart::Kind::sunlit;
        units.push_back(is_area ? sums.units.sunlit_area : sums.units.flux[bin.band]);
    }
    for (std::size_t r = 0; r < bins_.size(); ++r) {
        sums.replicates.push_back(exact_bins(r, units));
    }
    return Sums(std::move(sums));
}

}  // namespace quasimc
