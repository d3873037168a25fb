#include "quasimc/sources/period_light.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "quasimc/base/checks.h"

namespace quasimc {
namespace {

bool has_light(std::span<const double> spectrum) {
    return std::any_of(spectrum.begin(), spectrum.end(), [](double value) { return value > 0; });
}

/// Whether a = factor * b to rounding.
bool are_proportional(std::span<const double> a, std::span<const double> b) {
    const double sum_a = std::accumulate(a.begin(), a.end(), 0.0);
    const double sum_b = std::accumulate(b.begin(), b.end(), 0.0);
    constexpr double kRounding = 1e-12;
    return std::equal(a.begin(), a.end(), b.begin(), [&](double x, double y) {
        return std::abs(x / sum_a - y / sum_b) <= kRounding;
    });
}

}  // namespace

PeriodLight::PeriodLight(std::size_t bands, std::size_t azimuths, std::size_t elevations)
    : skies_(bands, SkySum(azimuths, elevations)) {
    EXPECT(bands > 0);
}

void PeriodLight::add_sky(const SkyShape& shape, std::span<const double> horizontal_irradiance) {
    EXPECT(horizontal_irradiance.size() == skies_.size());
    if (!has_light(horizontal_irradiance)) {
        return;
    }
    if (spectrum_.empty()) {
        spectrum_.assign(horizontal_irradiance.begin(), horizontal_irradiance.end());
    }
    same_spectra_ = same_spectra_ && are_proportional(horizontal_irradiance, spectrum_);
    SkySum own(skies_[0].table().azimuths, skies_[0].table().elevations);
    own.add_sky(shape, 1);
    for (std::size_t b = 0; b < skies_.size(); ++b) {
        skies_[b].add(own, horizontal_irradiance[b]);
    }
}

void PeriodLight::add_sun(const Vec3& to_sun, std::span<const double> facing_irradiance) {
    EXPECT(facing_irradiance.size() == skies_.size());
    if (to_sun.z > 0 && has_light(facing_irradiance)) {
        suns_.push_back(make_directional_source(
            "sun " + std::to_string(suns_.size() + 1), -to_sun,
            {facing_irradiance.begin(), facing_irradiance.end()}));
    }
}

std::vector<std::shared_ptr<const Source>> PeriodLight::sources(const std::string& name) const {
    std::vector<std::shared_ptr<const Source>> all;
    std::vector<double> spectrum;
    for (const SkySum& sky : skies_) {
        spectrum.push_back(sky.horizontal_irradiance());
    }
    if (same_spectra_ && has_light(spectrum)) {
        const auto lit = static_cast<std::size_t>(
            std::max_element(spectrum.begin(), spectrum.end()) - spectrum.begin());
        all.push_back(make_sky(name, table_shape(skies_[lit].table()), spectrum));
    }
    for (std::size_t b = 0; !same_spectra_ && b < skies_.size(); ++b) {
        if (spectrum[b] > 0) {
            std::vector<double> own(spectrum.size());
            own[b] = spectrum[b];
            all.push_back(make_sky(name, table_shape(skies_[b].table()), own));
        }
    }
    all.insert(all.end(), suns_.begin(), suns_.end());
    return all;
}

}  // namespace quasimc
