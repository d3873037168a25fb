#pragma once

#include <memory>
#include <span>
#include <string_view>

#include "optics/bsdf.h"

namespace quasimc {

/// The largest exponent that glossy models take: the lobe is then 0.1 degrees wide, less than the
/// sun. A sharper lobe is a mirror.
inline constexpr double kMaxExponent = 1e6;

/// One row of the table of lobe models.
struct BsdfEntry {
    std::string_view name;     ///< as in `reflection_model = "..."`
    std::string_view summary;  ///< one line for the manual
    bool has_exponent;         ///< whether the model takes an exponent, 0 ... kMaxExponent
    std::unique_ptr<Bsdf> (*make)(Hemisphere hemisphere, double exponent);
};

/// All lobe models, in the order of the manual: lambertian, phong, blinn_phong, mirror. A mirror's
/// transmitted lobe goes straight on.
[[nodiscard]] std::span<const BsdfEntry> bsdf_catalogue();

/// The row of that name, or null.
[[nodiscard]] const BsdfEntry* find_bsdf(std::string_view name);

}  // namespace quasimc
