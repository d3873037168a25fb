#include "optics/prospect.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "base/checks.h"

namespace quasimc {
namespace {

constexpr LeafConstants kLeafConstants[] = {
#include "optics/prospect_d.inc"
};

/// Optics of one plate, or of a pile of plates, for diffuse light.
struct Plates {
    double reflectance, transmittance;
};

/// The mean of the transmissivities of light polarized along and across the plane of incidence
/// (Fresnel's equations).
double fresnel_transmissivity(double n, double cosine) {
    const double inner = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
    const double across = (cosine - n * inner) / (cosine + n * inner);
    const double along = (n * cosine - inner) / (n * cosine + inner);
    return 1 - (across * across + along * along) / 2;
}

/// A pile of `count` plates, any number of them from 0 on: Stokes (1862), Proceedings of the Royal
/// Society 11, 545-556. @param plate  with a sum below 1, or without absorption
Plates pile(const Plates& plate, double count) {
    const double r = plate.reflectance, t = plate.transmittance;
    const double product = (1 + r + t) * (1 + r - t) * (1 - r + t) * (1 - r - t);
    if (product <= 0) {  // nothing is absorbed
        const double transmittance = t / (t + (1 - t) * count);
        return {1 - transmittance, transmittance};
    }
    const double root = std::sqrt(product);
    const double a = (1 + r * r - t * t + root) / (2 * r);
    const double passed = std::pow(2 * t / (1 - r * r + t * t + root), count);
    const double denominator = a * a - passed * passed;
    return {a * (1 - passed * passed) / denominator, passed * (a * a - 1) / denominator};
}

}  // namespace

std::span<const LeafConstants> leaf_constants() {
    return kLeafConstants;
}

double surface_transmissivity(double refractive_index, double half_angle_cosine) {
    EXPECT(refractive_index > 1 && half_angle_cosine >= 0 && half_angle_cosine < 1);
    // The integrand 2 c T(c) is smooth on [cosine, 1], so twice ten points of Gauss do: 1e-12.
    static constexpr std::array<double, 5> kPoint{
        0.1488743389816312, 0.4333953941292472, 0.6794095682990244, 0.8650633666889845,
        0.9739065285171717};
    static constexpr std::array<double, 5> kWeight{
        0.2955242247147529, 0.2692667193099964, 0.2190863625159820, 0.1494513491505806,
        0.0666713443086881};
    const double quarter = (1 - half_angle_cosine) / 4;
    double sum = 0;
    for (std::size_t i = 0; i < kPoint.size(); ++i) {
        for (const double sign : {-1.0, 1.0}) {
            for (const double middle : {1.0, 3.0}) {
                const double c = half_angle_cosine + quarter * (middle + sign * kPoint[i]);
                sum += kWeight[i] * 2 * c * fresnel_transmissivity(refractive_index, c);
            }
        }
    }
    return sum * quarter / (1 - half_angle_cosine * half_angle_cosine);
}

double plate_transmissivity(double k) {
    EXPECT(k >= 0);
    return k == 0 ? 1 : (1 - k) * std::exp(-k) - k * k * std::expint(-k);
}

LeafOptics prospect(const LeafConstants& constants, const LeafConstituents& leaf) {
    EXPECT(leaf.structure >= 1);
    constexpr double kCosine40 = 0.766044443118978;
    const double n = constants.refractive_index;
    const double absorption =
        (leaf.chlorophyll * constants.chlorophyll + leaf.carotenoids * constants.carotenoids +
         leaf.anthocyanins * constants.anthocyanins +
         leaf.brown_pigments * constants.brown_pigments + leaf.water * constants.water +
         leaf.dry_matter * constants.dry_matter) /
        leaf.structure;
    const double inside = plate_transmissivity(absorption);
    const double in_40 = surface_transmissivity(n, kCosine40);  // into the plate
    const double in = surface_transmissivity(n, 0);
    const double out = in / (n * n);
    const double back = 1 - out;  // reflectivity from within

    // The first plate receives the incident light of the leaf, the others diffuse light.
    const double again = 1 - back * back * inside * inside;
    const double first_transmittance = in_40 * inside * out / again;
    const double first_reflectance = 1 - in_40 + back * inside * first_transmittance;
    const double transmittance = in * inside * out / again;
    const Plates plate{1 - in + back * inside * transmittance, transmittance};
    const Plates others = pile(plate, leaf.structure - 1);
    const double between = 1 - others.reflectance * plate.reflectance;
    return {
        first_reflectance +
            first_transmittance * others.reflectance * plate.transmittance / between,
        first_transmittance * others.transmittance / between};
}

}  // namespace quasimc
