#include "light/daylight/solar_reference.h"

#include <utility>
#include <vector>

#include "base/checks.h"

namespace quasimc {
namespace {

/// One row of data/astm_g173_03.csv.
struct ReferenceRow {
    double wavelength_nm, global, direct;
};
constexpr ReferenceRow kReferenceRows[] = {
#include "light/astm_g173_03.inc"
};

Spectrum spectrum_of(double ReferenceRow::*column) {
    std::vector<double> nm, values;
    for (const ReferenceRow& row : kReferenceRows) {
        nm.push_back(row.wavelength_nm);
        values.push_back(row.*column);
    }
    return {std::move(nm), std::move(values)};
}

}  // namespace

const Spectrum& reference_global() {
    static const Spectrum spectrum = spectrum_of(&ReferenceRow::global);
    return spectrum;
}

const Spectrum& reference_direct() {
    static const Spectrum spectrum = spectrum_of(&ReferenceRow::direct);
    return spectrum;
}

Spectrum continued(const Spectrum& measured, const Spectrum& reference) {
    const double low = measured.low_nm();
    const double high = measured.high_nm();
    const double common = reference.within({low, high});
    EXPECT(common > 0);
    const double factor = measured.within({reference.low_nm(), reference.high_nm()}) / common;
    std::vector<double> nm, values;
    const auto add = [&](const Spectrum& spectrum, double scale, const auto& is_wanted) {
        for (const double each : spectrum.wavelengths()) {
            if (is_wanted(each)) {
                nm.push_back(each);
                values.push_back(scale * spectrum.at(each));
            }
        }
    };
    if (measured.at(low) > 0) {
        add(reference, factor, [&](double each) { return each < low; });
    }
    add(measured, 1, [](double) { return true; });
    if (measured.at(high) > 0) {
        add(reference, factor, [&](double each) { return each > high; });
    }
    return {std::move(nm), std::move(values)};
}

}  // namespace quasimc
