#include "runfile/run_file_sections.h"

namespace quasimc {

std::optional<Place> read_place(TableReader& top) {
    const Node* node = top.any("place");
    if (node == nullptr) {
        return std::nullopt;
    }
    TableReader table(*node, "[place]", top.reporter());
    Place place;
    const auto latitude = table.required("latitude_deg", table.real("latitude_deg", {-90, 90}));
    const auto longitude =
        table.required("longitude_deg", table.real("longitude_deg", {-180, 180}));
    place.latitude_deg = latitude.value_or(0);
    place.longitude_deg = longitude.value_or(0);
    place.elevation_m = table.real("elevation_m", {-2000, 11000}).value_or(0);
    place.pressure_hpa =
        table.real("pressure_hpa", {0, 2000}).value_or(standard_pressure_hpa(place.elevation_m));
    place.temperature_c = table.real("temperature_c", {-100, 100}).value_or(Place{}.temperature_c);
    table.finish();
    return table.failed() ? std::nullopt : std::optional(place);
}

}  // namespace quasimc
