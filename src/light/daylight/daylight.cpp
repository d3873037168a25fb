#include "light/daylight/daylight.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "base/text.h"
#include "light/daylight/solar_reference.h"

namespace quasimc {
namespace {

constexpr SpectralSpan kAll{280, 4000, SpectralSpan::Count::energy};

/// The sky of the standard: the light of the tilted plane except the beam. The plane is tilted by
/// 37 degrees towards a sun at zenith angle 48.19 degrees (air mass 1.5); some of the light came
/// from the ground.
Spectrum reference_sky() {
    const double incidence = (48.19 - 37) * std::numbers::pi / 180;
    const Spectrum& global = reference_global();
    std::vector<double> values;
    for (const double nm : global.wavelengths()) {
        values.push_back(global.at(nm) - std::cos(incidence) * reference_direct().at(nm));
    }
    return {global.wavelengths(), std::move(values)};
}

struct NamedSpan {
    std::string_view name;
    double from_nm, to_nm;
};
// Red and far red: the bands of Smith (1982) for the ratio R:FR.
constexpr std::array kNamed{
    NamedSpan{"par", 400, 700},     NamedSpan{"red", 655, 665}, NamedSpan{"r", 655, 665},
    NamedSpan{"far_red", 725, 735}, NamedSpan{"fr", 725, 735},  NamedSpan{"nir", 700, 2500},
    NamedSpan{"blue", 400, 500},    NamedSpan{"b", 400, 500},   NamedSpan{"green", 500, 600},
    NamedSpan{"g", 500, 600},       NamedSpan{"uv", 300, 400},  NamedSpan{"solar", 280, 4000}};

}  // namespace

SpectralSpan span_of(LightUnit unit) {
    switch (unit) {
        case LightUnit::par:
            return {400, 700, SpectralSpan::Count::energy};
        case LightUnit::ppfd:
            return {400, 700, SpectralSpan::Count::photons};
        case LightUnit::lux:
            return {380, 780, SpectralSpan::Count::lumens};
        default:
            return kAll;
    }
}

DaylightSpectra::DaylightSpectra()
    : direct_(reference_direct()), sky_(reference_sky()), whole_(reference_global()) {
    clearest_ = sky_.within(kAll) / whole_->within(kAll);
}

DaylightSpectra::DaylightSpectra(Spectrum direct, Spectrum diffuse)
    : direct_(std::move(direct)), sky_(std::move(diffuse)) {}

double DaylightSpectra::share(const Spectrum& spectrum, const SpectralSpan& span) const {
    return spectrum.within(span) / spectrum.within(kAll);
}

double DaylightSpectra::direct(const SpectralSpan& span) const {
    return share(direct_, span);
}

double DaylightSpectra::diffuse(const SpectralSpan& span, const Daylight& light) const {
    if (!whole_ || light.diffuse <= clearest_ * light.global()) {
        return light.diffuse * share(sky_, span);
    }
    return light.global() * share(*whole_, span) - light.direct * share(direct_, span);
}

Daylight DaylightSpectra::from_parts(double direct, double diffuse, LightUnit unit) const {
    const SpectralSpan span = span_of(unit);
    Daylight light{direct / share(direct_, span), 0};
    if (whole_) {
        light.diffuse = (direct + diffuse) / share(*whole_, span) - light.direct;
        if (light.diffuse > clearest_ * light.global()) {
            return light;
        }
    }
    light.diffuse = diffuse / share(sky_, span);
    return light;
}

double DaylightSpectra::from_global(double amount, LightUnit unit) const {
    const SpectralSpan span = span_of(unit);
    return amount /
           (whole_ ? share(*whole_, span) : 0.5 * (share(direct_, span) + share(sky_, span)));
}

Daylight DaylightSpectra::from_fraction(double amount, LightUnit unit, double fraction) const {
    const Daylight one{1 - fraction, fraction};
    const SpectralSpan span = span_of(unit);
    const double scale = amount / (one.direct * direct(span) + diffuse(span, one));
    return {scale * one.direct, scale * one.diffuse};
}

std::optional<SpectralSpan> span_of_band(std::string_view name, double from_nm, double to_nm) {
    if (to_nm > 0) {
        return SpectralSpan{from_nm, to_nm};
    }
    const std::string lower = lower_case(name);
    for (const NamedSpan& known : kNamed) {
        if (known.name == lower) {
            return SpectralSpan{known.from_nm, known.to_nm};
        }
    }
    return std::nullopt;
}

}  // namespace quasimc
