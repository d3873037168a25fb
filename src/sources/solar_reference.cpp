#include "sources/solar_reference.h"

#include <utility>
#include <vector>

namespace quasimc {
namespace {

/// A line of data/astm_g173_03.csv.
struct Row {
    double wavelength_nm, global, direct;
};
constexpr Row kRows[] = {
#include "sources/astm_g173_03.inc"
};

Spectrum spectrum_of(double Row::*column) {
    std::vector<double> nm, values;
    for (const Row& row : kRows) {
        nm.push_back(row.wavelength_nm);
        values.push_back(row.*column);
    }
    return {std::move(nm), std::move(values)};
}

}  // namespace

const Spectrum& reference_global() {
    static const Spectrum spectrum = spectrum_of(&Row::global);
    return spectrum;
}

const Spectrum& reference_direct() {
    static const Spectrum spectrum = spectrum_of(&Row::direct);
    return spectrum;
}

}  // namespace quasimc
