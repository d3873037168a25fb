#include "sources/solar_reference.h"

#include <utility>
#include <vector>

namespace quasimc {
namespace {

/// A line of data/astm_g173_03.csv.
struct ReferenceRow {
    double wavelength_nm, global, direct;
};
constexpr ReferenceRow kReferenceRows[] = {
#include "sources/astm_g173_03.inc"
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

}  // namespace quasimc
