#pragma once

namespace quasimc {

// The fraction of sky light in global light on the horizontal, where only the latter is known.
// @param clearness    global light over extraterrestrial light on the horizontal, 0 or more
// @param sine         of the sun's elevation, above 0

/// Erbs, Klein and Duffie 1982, Solar Energy 28: 293-302, eq. 1; hourly.
[[nodiscard]] double diffuse_fraction_erbs(double clearness);

/// Reindl, Beckman and Duffie 1990, Solar Energy 45: 1-7: the correlation on clearness and
/// elevation, with the paper's own bounds; hourly.
[[nodiscard]] double diffuse_fraction_reindl(double clearness, double sine);

/// Spitters, Toussaint and Goudriaan 1986, Agricultural and Forest Meteorology 38: 217-229, eq. 20;
/// hourly.
[[nodiscard]] double diffuse_fraction_spitters(double clearness, double sine);

enum class DiffuseModel { erbs, reindl, spitters };
/// The hourly equation of the given model.
[[nodiscard]] double diffuse_fraction(DiffuseModel model, double clearness, double sine);

}  // namespace quasimc
