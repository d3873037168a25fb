#pragma once

#include <string>
#include <string_view>

namespace quasimc {

/// A unit of irradiance in the spelling of headers: "umol m-2 s-1" for "umol/m2/s", "µmol m⁻² s⁻¹",
/// "umol.m^-2.s^-1" and "s-1 m-2 umol"; "lx" for "lux". Texts that are not products of powers of
/// symbols stay as they are: "umol/m2 s" (a blank after a quotient can be read in two ways), "%".
[[nodiscard]] std::string standard_unit(std::string_view given);

/// The unit of daylight and lamps with the same letters, in any case: "umol m-2 s-1" for "umol m-2
/// s"; "" if there is none.
[[nodiscard]] std::string_view unit_of_same_letters(std::string_view unit);

}  // namespace quasimc
