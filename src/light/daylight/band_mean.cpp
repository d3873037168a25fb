#include "light/daylight/band_mean.h"

#include <algorithm>
#include <vector>

namespace quasimc {
namespace {

constexpr int kPhotopicLow = 380, kPhotopicHigh = 780, kPhotopicGrid = 10;

/// The wavelengths within a span where one of the factors has a kink, and its ends.
std::vector<double> bends_within(
    const Spectrum& property, const Spectrum& light, const SpectralSpan& span) {
    std::vector<double> nm{span.from_nm, span.to_nm};
    const auto add = [&](double x) {
        if (x > span.from_nm && x < span.to_nm) {
            nm.push_back(x);
        }
    };
    std::for_each(property.wavelengths().begin(), property.wavelengths().end(), add);
    std::for_each(light.wavelengths().begin(), light.wavelengths().end(), add);
    if (span.count == SpectralSpan::Count::lumens) {
        for (int x = kPhotopicLow; x <= kPhotopicHigh; x += kPhotopicGrid) {
            add(x);
        }
    }
    std::sort(nm.begin(), nm.end());
    return nm;
}

double counted_per_watt(SpectralSpan::Count count, double nm) {
    switch (count) {
        case SpectralSpan::Count::photons:
            return photons_per_joule(nm);
        case SpectralSpan::Count::lumens:
            return photopic_efficiency(nm);
        default:
            return 1;
    }
}

/// The integral over the span by Simpson's rule between bends, exact up to the third degree.
template <typename Function>
double integral_between(const std::vector<double>& nm, const Function& f) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < nm.size(); ++i) {
        const double middle = 0.5 * (nm[i] + nm[i + 1]);
        sum += (nm[i + 1] - nm[i]) / 6 * (f(nm[i]) + 4 * f(middle) + f(nm[i + 1]));
    }
    return sum;
}

}  // namespace

double band_mean(const Spectrum& property, const Spectrum& light, const SpectralSpan& span) {
    const std::vector<double> nm = bends_within(property, light, span);
    const auto weight = [&](double x) { return light.at(x) * counted_per_watt(span.count, x); };
    const double all = integral_between(nm, weight);
    if (all > 0) {
        return integral_between(nm, [&](double x) { return property.at(x) * weight(x); }) / all;
    }
    return integral_between(nm, [&](double x) { return property.at(x); }) /
           (span.to_nm - span.from_nm);
}

}  // namespace quasimc
