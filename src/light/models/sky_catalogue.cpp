#include <algorithm>
#include <array>

#include "light/models/source.h"

namespace quasimc {
namespace {

// To add a sky: a function that makes its shape, in a file of its own that cites its paper; a row
// here; a page in docs/theory. Tests of skies and of both directions of tracing cover all rows of
// this table.
constexpr std::array kSkies{
    SkyEntry{
        "uniform", "the same radiance from everywhere", SkyNeeds::nothing,
        [](const SkyState&) { return uniform_sky_shape(); }},
    SkyEntry{
        "cie_overcast",
        "CIE 110 standard overcast sky, three times as bright at the zenith as at the horizon",
        SkyNeeds::nothing, [](const SkyState&) { return cie_overcast_shape(); }},
    SkyEntry{
        "cie_clear", "CIE 110 standard clear sky", SkyNeeds::sun,
        [](const SkyState& state) { return cie_clear_shape(state.to_sun); }},
    SkyEntry{
        "cie_general",
        "one of the fifteen of CIE S 011 (ISO 15469): cie_type 1 (overcast) to 15 (hazy)",
        SkyNeeds::sun_and_type,
        [](const SkyState& state) { return cie_general_shape(state.cie_type, state.to_sun); }},
    SkyEntry{
        "perez", "all-weather sky of Perez et al. 1993, from direct_normal and diffuse_horizontal",
        SkyNeeds::sun_and_weather, perez_shape},
    SkyEntry{
        "preetham", "luminance of Preetham et al. 1999 for a turbidity",
        SkyNeeds::sun_and_turbidity,
        [](const SkyState& state) { return preetham_shape(state.turbidity, state.to_sun); }}};

}  // namespace

std::span<const SkyEntry> sky_catalogue() {
    return kSkies;
}

const SkyEntry* find_sky(std::string_view name) {
    const auto* found = std::find_if(
        kSkies.begin(), kSkies.end(), [&](const SkyEntry& entry) { return entry.name == name; });
    return found == kSkies.end() ? nullptr : found;
}

}  // namespace quasimc
