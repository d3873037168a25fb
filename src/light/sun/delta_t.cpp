// Espenak and Meeus (2006), "Five millennium canon of solar eclipses", NASA/TP-2006-214141: one
// polynomial for each era, here those from 1900 to 2150.

#include <array>
#include <span>

#include "light/sun/sun_ephemeris.h"
#include "quasimc/source.h"

namespace quasimc {
namespace {

/// A polynomial in (year - origin) / unit, until a year.
struct Era {
    double until, origin, unit;
    std::span<const double> coefficients;
};

// clang-format off
constexpr std::array kTo1920{-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197};
constexpr std::array kTo1941{21.20, 0.84493, -0.076100, 0.0020936};
constexpr std::array kTo1961{29.07, 0.407, -1.0 / 233, 1.0 / 2547};
constexpr std::array kTo1986{45.45, 1.067, -1.0 / 260, -1.0 / 718};
constexpr std::array kTo2005{
    63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599};
constexpr std::array kTo2050{62.92, 0.32217, 0.005589};
constexpr std::array kTo2150{-20.0, 0.0, 32.0};

constexpr std::array kEras{
    Era{1920, 1900, 1, kTo1920}, Era{1941, 1920, 1, kTo1941}, Era{1961, 1950, 1, kTo1961},
    Era{1986, 1975, 1, kTo1986}, Era{2005, 2000, 1, kTo2005}, Era{2050, 2000, 1, kTo2050},
    Era{2150, 1820, 100, kTo2150}};
// clang-format on

}  // namespace

double delta_t_seconds(const CivilTime& time) {
    const double year = time.year + (time.month - 0.5) / 12;
    std::size_t era = 0;
    while (era + 1 < kEras.size() && year >= kEras[era].until) {
        ++era;
    }
    const Era& e = kEras[era];
    const double value = polynomial((year - e.origin) / e.unit, e.coefficients);
    // From 2050 on the parabola is blended with the extrapolation of present values.
    return year >= 2050 ? value - 0.5628 * (2150 - year) : value;
}

}  // namespace quasimc
