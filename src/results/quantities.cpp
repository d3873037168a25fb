#include "results/quantities.h"

namespace quasimc {

const std::array<QuantityEntry, kQuantities>& quantity_table() {
    static constexpr std::array kTable = [] {
        std::array<QuantityEntry, kQuantities> entries{};
        for (std::size_t i = 0; i < kQuantities; ++i) {
            entries[i] = kQuantityRows[i].entry;
        }
        return entries;
    }();
    return kTable;
}

const std::array<SunShadeEntry, kSunShadeQuantities>& sun_shade_table() {
    using Q = SunShadeQuantity;
    using Part = SunShadePart;
    using Surface = SunShadeSurface;
    static constexpr std::array<SunShadeEntry, kSunShadeQuantities> kTable{{
        {Q::incident_upper_direct, "incident_upper_direct", "incident_upper_direct",
         "light on the upper side straight from sun, sky and lamps, per area", Part::direct,
         Surface::upper},
        {Q::incident_lower_direct, "incident_lower_direct", "incident_lower_direct",
         "light on the lower side straight from sun, sky and lamps, per area", Part::direct,
         Surface::lower},
        {Q::sunlit_fraction_upper, "sunlit_fraction_upper", "sunlit_hours_upper",
         "fraction of the area whose upper side the sun lights", Part::fraction, Surface::upper},
        {Q::sunlit_fraction_lower, "sunlit_fraction_lower", "sunlit_hours_lower",
         "fraction of the area whose lower side the sun lights", Part::fraction, Surface::lower},
        {Q::incident_upper_sunlit, "incident_upper_sunlit", "incident_upper_sunlit",
         "light on the upper side where the sun lights it, per sunlit area", Part::sunlit,
         Surface::upper},
        {Q::incident_upper_shaded, "incident_upper_shaded", "incident_upper_shaded",
         "light on the upper side where the sun does not light it, per shaded area", Part::shaded,
         Surface::upper},
        {Q::incident_lower_sunlit, "incident_lower_sunlit", "incident_lower_sunlit",
         "light on the lower side where the sun lights it, per sunlit area", Part::sunlit,
         Surface::lower},
        {Q::incident_lower_shaded, "incident_lower_shaded", "incident_lower_shaded",
         "light on the lower side where the sun does not light it, per shaded area", Part::shaded,
         Surface::lower},
        {Q::absorbed_flux_density_sunlit, "absorbed_flux_density_sunlit",
         "absorbed_flux_density_sunlit",
         "light absorbed where the sun lights either side, per sunlit area", Part::sunlit,
         Surface::absorbed_by_both},
        {Q::absorbed_flux_density_shaded, "absorbed_flux_density_shaded",
         "absorbed_flux_density_shaded",
         "light absorbed where the sun lights neither side, per shaded area", Part::shaded,
         Surface::absorbed_by_both},
    }};
    return kTable;
}

}  // namespace quasimc
