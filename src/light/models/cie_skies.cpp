// Skies of the CIE: of CIE 110 (1994) and the fifteen of CIE S 011 / ISO 15469. All are a gradation
// from zenith to horizon times an indicatrix around the sun.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/checks.h"
#include "light/models/source.h"

namespace quasimc {
namespace {

/// Angle between two unit vectors, accurate for small angles too.
double angle_between(const Vec3& a, const Vec3& b) {
    return 2 * std::asin(std::min(1.0, 0.5 * length(a - b)));
}

/// Parameters of a general sky, table 1 of the standard.
struct GeneralSky {
    double a, b, c, d, e;
};
constexpr std::array<GeneralSky, 15> kGeneral{
    {{4.0, -0.70, 0, -1.0, 0.00},
     {4.0, -0.70, 2, -1.5, 0.15},
     {1.1, -0.80, 0, -1.0, 0.00},
     {1.1, -0.80, 2, -1.5, 0.15},
     {0.0, -1.00, 0, -1.0, 0.00},
     {0.0, -1.00, 2, -1.5, 0.15},
     {0.0, -1.00, 5, -2.5, 0.30},
     {0.0, -1.00, 10, -3.0, 0.45},
     {-1.0, -0.55, 2, -1.5, 0.15},
     {-1.0, -0.55, 5, -2.5, 0.30},
     {-1.0, -0.55, 10, -3.0, 0.45},
     {-1.0, -0.32, 10, -3.0, 0.45},
     {-1.0, -0.32, 16, -3.0, 0.30},
     {-1.0, -0.15, 16, -3.0, 0.30},
     {-1.0, -0.15, 24, -2.8, 0.15}}};

}  // namespace

SkyShape uniform_sky_shape() {
    return {[](const Vec3&) { return 1.0; }, {}, {}, InsideCells::constant};
}

SkyShape cie_overcast_shape() {
    return {[](const Vec3& d) { return (1 + 2 * d.z) / 3; }, {}, {}};
}

SkyShape cie_clear_shape(const Vec3& to_sun) {
    return {
        [to_sun](const Vec3& d) {
            const double gamma = angle_between(d, to_sun);
            const double cosine = dot(d, to_sun);
            return (0.91 + 10 * std::exp(-3 * gamma) + 0.45 * cosine * cosine) *
                   -std::expm1(-0.32 / d.z);
        },
        {},
        {}};
}

SkyShape cie_general_shape(int type, const Vec3& to_sun) {
    EXPECT(type >= 1 && type <= 15);
    const GeneralSky sky = kGeneral[static_cast<std::size_t>(type - 1)];
    const double across = std::exp(sky.d * std::numbers::pi / 2);
    return {
        [sky, across, to_sun](const Vec3& d) {
            const double chi = angle_between(d, to_sun);
            const double cosine = dot(d, to_sun);
            const double gradation = 1 + sky.a * std::exp(sky.b / d.z);
            const double indicatrix =
                1 + sky.c * (std::exp(sky.d * chi) - across) + sky.e * cosine * cosine;
            return gradation * indicatrix;
        },
        {},
        {}};
}

}  // namespace quasimc
