#include "light/daylight/spectrum.h"

#include <algorithm>
#include <array>
#include <utility>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr double kPlanck = 6.62607015e-34;   // J s
constexpr double kLight = 299792458;         // m s-1
constexpr double kAvogadro = 6.02214076e23;  // mol-1
constexpr double kLumensPerWatt = 683;

constexpr double kPhotopicStart = 380;
constexpr double kPhotopicStep = 10;
constexpr std::array<double, 41> kPhotopic{
    3.9e-5,  1.2e-4,  3.96e-4, .00121,   .004,   .0116,  .023,   .038,   .06,  .09098, .13902,
    .20802,  .323,    .503,    .71,      .862,   .954,   .99495, .995,   .952, .87,    .757,
    .631,    .503,    .381,    .265,     .175,   .107,   .061,   .032,   .017, .00821, .004102,
    .002091, .001047, .00052,  .0002492, .00012, .00006, .00003, .000015};

constexpr std::array kCounts{
    SpectralSpan::Count::energy, SpectralSpan::Count::photons, SpectralSpan::Count::lumens};

/// The weight of irradiance at a wavelength.
double weight(SpectralSpan::Count count, double nm) {
    switch (count) {
        case SpectralSpan::Count::photons:
            return photons_per_joule(nm);
        case SpectralSpan::Count::lumens:
            return kLumensPerWatt * photopic_efficiency(nm);
        default:
            return 1;
    }
}

/// The integral over [a, b] of a product of at most third degree (Simpson's rule).
template <typename Function>
double simpson(const Function& f, double a, double b) {
    return (b - a) / 6 * (f(a) + 4 * f(0.5 * (a + b)) + f(b));
}

}  // namespace

Spectrum::Spectrum(std::vector<double> nm, std::vector<double> values)
    : nm_(std::move(nm)), values_(std::move(values)) {
    EXPECT(nm_.size() == values_.size() && nm_.size() >= 2);
    for (const SpectralSpan::Count count : kCounts) {
        integrals_[static_cast<std::size_t>(count)] = make_integral(count);
    }
}

double Spectrum::at(double nm) const {
    if (nm < nm_.front() || nm > nm_.back()) {
        return 0;
    }
    const auto after = std::upper_bound(nm_.begin(), nm_.end() - 1, nm);
    const auto i = static_cast<std::size_t>(after - nm_.begin());
    const double part = (nm - nm_[i - 1]) / (nm_[i] - nm_[i - 1]);
    return values_[i - 1] + part * (values_[i] - values_[i - 1]);
}

double Spectrum::piece(SpectralSpan::Count count, double from_nm, double to_nm) const {
    return simpson([&](double nm) { return at(nm) * weight(count, nm); }, from_nm, to_nm);
}

/// Between consecutive bounds spectrum and weight are both smooth.
Spectrum::Integral Spectrum::make_integral(SpectralSpan::Count count) const {
    Integral integral{nm_, {0}};
    for (std::size_t i = 0; count == SpectralSpan::Count::lumens && i < kPhotopic.size(); ++i) {
        const double nm = kPhotopicStart + kPhotopicStep * static_cast<double>(i);
        if (nm > low_nm() && nm < high_nm()) {
            integral.nm.push_back(nm);
        }
    }
    std::sort(integral.nm.begin(), integral.nm.end());
    for (std::size_t i = 0; i + 1 < integral.nm.size(); ++i) {
        integral.until.push_back(
            integral.until[i] + piece(count, integral.nm[i], integral.nm[i + 1]));
    }
    return integral;
}

double Spectrum::within(const SpectralSpan& span) const {
    const Integral& integral = integrals_[static_cast<std::size_t>(span.count)];
    const auto until = [&](double nm) {
        const auto after = std::upper_bound(integral.nm.begin() + 1, integral.nm.end() - 1, nm);
        const auto i = static_cast<std::size_t>(after - integral.nm.begin()) - 1;
        return integral.until[i] + piece(span.count, integral.nm[i], nm);
    };
    const double from = std::max(span.from_nm, low_nm());
    const double to = std::min(span.to_nm, high_nm());
    return from < to ? until(to) - until(from) : 0;
}

double photons_per_joule(double nm) {
    return 1e6 * 1e-9 * nm / (kPlanck * kLight * kAvogadro);
}

double photopic_efficiency(double nm) {
    const double position = (nm - kPhotopicStart) / kPhotopicStep;
    if (position < 0 || position > static_cast<double>(kPhotopic.size() - 1)) {
        return 0;
    }
    const std::size_t i = std::min(static_cast<std::size_t>(position), kPhotopic.size() - 2);
    return kPhotopic[i] + (position - static_cast<double>(i)) * (kPhotopic[i + 1] - kPhotopic[i]);
}

}  // namespace quasimc
