#pragma once

#include <span>

namespace quasimc {

/// Structure and constituents of a leaf, for PROSPECT-D. See docs/theory/leaf-and-soil-models.md.
struct LeafConstituents {
    double structure = 1;       ///< N: number of plates in the leaf, a real number of at least 1
    double chlorophyll = 0;     ///< a and b [ug cm-2]
    double carotenoids = 0;     ///< [ug cm-2]
    double anthocyanins = 0;    ///< [ug cm-2]
    double brown_pigments = 0;  ///< arbitrary units: 0 in green leaves, about 1 in dead ones
    double water = 0;           ///< thickness of all water in one layer [cm]
    double dry_matter = 0;      ///< mass per area of leaf [g cm-2]
};

/// A row of data/prospect_d.csv: refractive index and specific absorption coefficients.
struct LeafConstants {
    double nm;
    double refractive_index;
    double chlorophyll, carotenoids, anthocyanins;  ///< [cm2 ug-1]
    double brown_pigments;                          ///< per arbitrary unit
    double water;                                   ///< [cm-1]
    double dry_matter;                              ///< [cm2 g-1]
};

/// Constants of PROSPECT-D, every 5 nm from 400 to 2500 nm: Féret et al. (2017), Remote Sensing of
/// Environment 193, 204-215.
[[nodiscard]] std::span<const LeafConstants> leaf_constants();

struct LeafOptics {
    double reflectance = 0, transmittance = 0;
};

/// Reflectance and transmittance of a leaf for light from its upper side, at one wavelength: the
/// pile of plates of Allen et al. (1969) and Jacquemoud & Baret (1990), whose surface takes light
/// from within 40 degrees of the normal.
[[nodiscard]] LeafOptics prospect(
    const LeafConstants& constants, const LeafConstituents& constituents);

/// The mean transmissivity of a smooth surface for isotropic light within an angle of the normal,
/// by quadrature; Stern (1964), Applied Optics 3(1), 111-113, has a closed form. @param
/// half_angle_cosine  cosine of the angle, 0 to below 1
[[nodiscard]] double surface_transmissivity(double refractive_index, double half_angle_cosine);

/// The transmissivity of a plate for diffuse light: (1 - k) exp(-k) + k^2 E1(k) (Allen et al. 1969,
/// Journal of the Optical Society of America 59(10), equation 15).
/// @param k  absorption coefficient x thickness, 0 or more
[[nodiscard]] double plate_transmissivity(double k);

}  // namespace quasimc
