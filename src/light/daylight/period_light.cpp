#include "light/daylight/period_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "base/checks.h"

namespace quasimc {
namespace {

using BandValues = std::vector<double>;  // by band

constexpr double kRounding = 1e-9;

double sum_of(const BandValues& spectrum) {
    return std::accumulate(spectrum.begin(), spectrum.end(), 0.0);
}

bool has_light(std::span<const double> spectrum) {
    return std::any_of(spectrum.begin(), spectrum.end(), [](double value) { return value > 0; });
}

/// Distance between the normalized band values: 0 to 2.
double distance(const BandValues& a, const BandValues& b) {
    const double sum_a = sum_of(a);
    const double sum_b = sum_of(b);
    double apart = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        apart += std::abs(a[i] / sum_a - b[i] / sum_b);
    }
    return apart;
}

/// The spectrum with the largest distance from `other`.
const BandValues& farthest(const std::vector<BandValues>& spectra, const BandValues& other) {
    return *std::max_element(spectra.begin(), spectra.end(), [&](const auto& a, const auto& b) {
        return distance(a, other) < distance(b, other);
    });
}

/// The parts of two spectra that add up to a third; nothing if it is no mixture of them.
std::optional<std::array<double, 2>> parts_of(
    const BandValues& mixture, const BandValues& one, const BandValues& other) {
    // Least squares.
    double oo = 0, ot = 0, tt = 0, mo = 0, mt = 0;
    for (std::size_t b = 0; b < mixture.size(); ++b) {
        oo += one[b] * one[b];
        ot += one[b] * other[b];
        tt += other[b] * other[b];
        mo += mixture[b] * one[b];
        mt += mixture[b] * other[b];
    }
    const double determinant = oo * tt - ot * ot;
    const std::array<double, 2> parts{
        (mo * tt - mt * ot) / determinant, (mt * oo - mo * ot) / determinant};
    double missing = 0;
    for (std::size_t b = 0; b < mixture.size(); ++b) {
        missing += std::abs(parts[0] * one[b] + parts[1] * other[b] - mixture[b]);
    }
    const bool fits = missing <= kRounding * sum_of(mixture) &&
                      parts[0] * sum_of(one) >= -kRounding * sum_of(mixture) &&
                      parts[1] * sum_of(other) >= -kRounding * sum_of(mixture);
    if (!fits) {
        return std::nullopt;
    }
    return std::array{std::max(0.0, parts[0]), std::max(0.0, parts[1])};
}

/// Basis spectra, and their amounts in each spectrum: parts[i][k] of the k-th.
struct Mixing {
    std::vector<BandValues> pure;
    std::vector<std::vector<double>> parts;
};

/// A basis of one spectrum, of two, or of one for each band.
Mixing unmix(const std::vector<BandValues>& spectra) {
    Mixing mixing;
    const BandValues& one = farthest(spectra, spectra.front());
    const BandValues& other = farthest(spectra, one);
    const bool is_single = distance(one, other) <= kRounding;
    if (is_single) {
        mixing.pure = {one};
        for (const BandValues& spectrum : spectra) {
            mixing.parts.push_back({sum_of(spectrum) / sum_of(one)});
        }
        return mixing;
    }
    mixing.pure = {one, other};
    for (const BandValues& spectrum : spectra) {
        const auto parts = parts_of(spectrum, one, other);
        if (!parts) {
            break;
        }
        mixing.parts.push_back({parts->begin(), parts->end()});
    }
    if (mixing.parts.size() == spectra.size()) {
        return mixing;
    }
    mixing.pure.clear();
    for (std::size_t b = 0; b < one.size(); ++b) {
        BandValues band(one.size());
        band[b] = 1;
        mixing.pure.push_back(std::move(band));
    }
    mixing.parts = spectra;
    return mixing;
}

BandValues times(BandValues spectrum, double factor) {
    for (double& value : spectrum) {
        value *= factor;
    }
    return spectrum;
}

}  // namespace

PeriodLight::PeriodLight(std::size_t bands, std::size_t azimuths, std::size_t elevations)
    : bands_(bands), azimuths_(azimuths), elevations_(elevations) {
    EXPECT(bands > 0);
}

void PeriodLight::add_sky(const SkyShape& shape, std::span<const double> horizontal_irradiance) {
    EXPECT(horizontal_irradiance.size() == bands_);
    if (has_light(horizontal_irradiance)) {
        skies_.push_back({shape, {horizontal_irradiance.begin(), horizontal_irradiance.end()}});
    }
}

void PeriodLight::add_sun(const Vec3& to_sun, std::span<const double> facing_irradiance) {
    EXPECT(facing_irradiance.size() == bands_);
    if (to_sun.z > 0 && has_light(facing_irradiance)) {
        suns_.push_back({to_sun, {facing_irradiance.begin(), facing_irradiance.end()}});
    }
}

std::vector<std::shared_ptr<const Source>> PeriodLight::sources(
    const std::string& name, double factor) const {
    std::vector<std::shared_ptr<const Source>> all;
    if (!skies_.empty()) {
        std::vector<BandValues> spectra;
        for (const AddedSky& sky : skies_) {
            spectra.push_back(sky.spectrum);
        }
        const Mixing mixing = unmix(spectra);
        std::vector<SkySum> sums(mixing.pure.size(), SkySum(azimuths_, elevations_));
        for (std::size_t i = 0; i < skies_.size(); ++i) {
            SkySum own(azimuths_, elevations_);
            own.add_sky(skies_[i].shape, 1);
            for (std::size_t k = 0; k < sums.size(); ++k) {
                sums[k].add(own, mixing.parts[i][k]);
            }
        }
        for (std::size_t k = 0; k < sums.size(); ++k) {
            const double amount = sums[k].horizontal_irradiance();
            if (amount > 0) {
                all.push_back(make_sky(
                    name, table_shape(sums[k].table()), times(mixing.pure[k], factor * amount)));
            }
        }
    }
    for (const AddedSun& sun : suns_) {
        all.push_back(make_directional_source("sun", -sun.to_sun, times(sun.spectrum, factor)));
    }
    return all;
}

}  // namespace quasimc
