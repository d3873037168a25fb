// Espenak and Meeus (2006), "Five millennium canon of solar eclipses", NASA/TP-2006-214141: one
// polynomial for each era.

#include <array>
#include <limits>
#include <span>

#include "quasimc/sun.h"
#include "sources/sun_ephemeris.h"

namespace quasimc {
namespace {

/// A polynomial in (year - origin) / unit, until a year.
struct Era {
    double until, origin, unit;
    std::span<const double> coefficients;
};

// clang-format off
constexpr std::array kAncient{-20.0, 0.0, 32.0};
constexpr std::array kTo500{
    10583.6, -1014.41, 33.78311, -5.952053, -0.1798452, 0.022174192, 0.0090316521};
constexpr std::array kTo1600{
    1574.2, -556.01, 71.23472, 0.319781, -0.8503463, -0.005050998, 0.0083572073};
constexpr std::array kTo1700{120.0, -0.9808, -0.01532, 1.0 / 7129};
constexpr std::array kTo1800{8.83, 0.1603, -0.0059285, 0.00013336, -1.0 / 1174000};
constexpr std::array kTo1860{
    13.72, -0.332447, 0.0068612, 0.0041116, -0.00037436, 0.0000121272, -0.0000001699,
    0.000000000875};
constexpr std::array kTo1900{
    7.62, 0.5737, -0.251754, 0.01680668, -0.0004473624, 1.0 / 233174};
constexpr std::array kTo1920{-2.79, 1.494119, -0.0598939, 0.0061966, -0.000197};
constexpr std::array kTo1941{21.20, 0.84493, -0.076100, 0.0020936};
constexpr std::array kTo1961{29.07, 0.407, -1.0 / 233, 1.0 / 2547};
constexpr std::array kTo1986{45.45, 1.067, -1.0 / 260, -1.0 / 718};
constexpr std::array kTo2005{
    63.86, 0.3345, -0.060374, 0.0017275, 0.000651814, 0.00002373599};
constexpr std::array kTo2050{62.92, 0.32217, 0.005589};

constexpr std::array kEras{
    Era{-500, 1820, 100, kAncient}, Era{500, 0, 100, kTo500},   Era{1600, 1000, 100, kTo1600},
    Era{1700, 1600, 1, kTo1700},    Era{1800, 1700, 1, kTo1800}, Era{1860, 1800, 1, kTo1860},
    Era{1900, 1860, 1, kTo1900},    Era{1920, 1900, 1, kTo1920}, Era{1941, 1920, 1, kTo1941},
    Era{1961, 1950, 1, kTo1961},    Era{1986, 1975, 1, kTo1986}, Era{2005, 2000, 1, kTo2005},
    Era{2050, 2000, 1, kTo2050},
    Era{std::numeric_limits<double>::infinity(), 1820, 100, kAncient}};
// clang-format on

}  // namespace

double delta_t_seconds(double decimal_year) {
    std::size_t era = 0;
    while (decimal_year >= kEras[era].until) {
        ++era;
    }
    const Era& e = kEras[era];
    const double value = polynomial((decimal_year - e.origin) / e.unit, e.coefficients);
    // From 2050 to 2150 the parabola is joined to what is extrapolated from today.
    const bool is_joined = decimal_year >= 2050 && decimal_year < 2150;
    return is_joined ? value - 0.5628 * (2150 - decimal_year) : value;
}

double delta_t_seconds(const CivilTime& time) {
    return delta_t_seconds(time.year + (time.month - 0.5) / 12);
}

}  // namespace quasimc
