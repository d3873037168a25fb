#include "io/runfile/units.h"

#include "base/text.h"

namespace quasimc {

std::string flux_unit(const std::string& irradiance_unit, const std::string& length_unit) {
    if (length_unit.empty()) {
        return "";  // of a plant whose lengths have no unit
    }
    const std::string per_area = " " + length_unit + "-2";
    const std::string padded = " " + irradiance_unit + " ";
    const std::size_t found = padded.find(per_area + " ");
    if (found == std::string::npos) {
        return irradiance_unit + " " + length_unit + "2";
    }
    const std::string rest = padded.substr(0, found) + padded.substr(found + per_area.size());
    const std::string_view unit = trimmed(rest);
    return unit.empty() ? "1" : std::string(unit);
}

std::string unit_of(
    const QuantityEntry& quantity, const Band& band, const std::string& length_unit) {
    return quantity.is_flux ? flux_unit(band.unit, length_unit) : band.unit;
}

}  // namespace quasimc
