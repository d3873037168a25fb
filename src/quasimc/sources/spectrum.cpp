#include "quasimc/sources/spectrum.h"

#include <algorithm>
#include <array>
#include <utility>

#include "quasimc/base/checks.h"

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

/// The factor on the irradiance at a wavelength.
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

/// The integral over [a, b] of a product that is at most of third degree there (Simpson's rule).
template <typename Function>
double simpson(const Function& f, double a, double b) {
    return (b - a) / 6 * (f(a) + 4 * f(0.5 * (a + b)) + f(b));
}

}  // namespace

Spectrum::Spectrum(std::vector<double> nm, std::vector<double> values)
    : nm_(std::move(nm)), values_(std::move(values)) {
    EXPECT(nm_.size() == values_.size() && nm_.size() >= 2);
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

double Spectrum::within(const SpectralSpan& span) const {
    // Pieces on which spectrum and weight are both smooth.
    std::vector<double> borders{std::max(span.from_nm, low_nm()), std::min(span.to_nm, high_nm())};
    if (borders[0] >= borders[1]) {
        return 0;
    }
    const auto add = [&](double nm) {
        if (nm > borders[0] && nm < borders[1]) {
            borders.push_back(nm);
        }
    };
    std::for_each(nm_.begin(), nm_.end(), add);
    for (std::size_t i = 0; span.count == SpectralSpan::Count::lumens && i < kPhotopic.size();
         ++i) {
        add(kPhotopicStart + kPhotopicStep * static_cast<double>(i));
    }
    std::sort(borders.begin(), borders.end());
    const auto product = [&](double nm) { return at(nm) * weight(span.count, nm); };
    double sum = 0;
    for (std::size_t i = 0; i + 1 < borders.size(); ++i) {
        sum += simpson(product, borders[i], borders[i + 1]);
    }
    return sum;
}

double photons_per_joule(double nm) {
    return 1e6 * 1e-9 * nm / (kPlanck * kLight * kAvogadro);
}

double photopic_efficiency(double nm) {
    const double place = (nm - kPhotopicStart) / kPhotopicStep;
    if (place < 0 || place > static_cast<double>(kPhotopic.size() - 1)) {
        return 0;
    }
    const std::size_t i = std::min(static_cast<std::size_t>(place), kPhotopic.size() - 2);
    return kPhotopic[i] + (place - static_cast<double>(i)) * (kPhotopic[i + 1] - kPhotopic[i]);
}

}  // namespace quasimc
