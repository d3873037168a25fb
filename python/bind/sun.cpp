#include <optional>
#include <string>

#include <pybind11/stl.h>

#include "bind.h"
#include "quasimc/error.h"
#include "quasimc/source.h"
#include "weather/civil_time_text.h"

namespace quasimc::python {
namespace {

Site site_of(
    double latitude_deg,
    double longitude_deg,
    double elevation_m,
    std::optional<double> pressure_hpa,
    double temperature_c) {
    const double pressure = pressure_hpa ? *pressure_hpa : standard_pressure_hpa(elevation_m);
    const Site site{latitude_deg, longitude_deg, elevation_m, pressure, temperature_c};
    Faults faults;
    check_site(site, "site", faults);
    faults.throw_if_any();
    return site;
}

CivilTime time_of_text(const std::string& text) {
    Faults faults;
    const auto time = parse_civil_time(text, std::nullopt, "time", faults);
    if (time) {
        check_time(*time, "time", faults);
    }
    faults.throw_if_any();
    return *time;
}

py::object text_or_none(const std::optional<CivilTime>& time) {
    return time ? py::object(py::str(civil_time_text(*time))) : py::none();
}

py::dict day_of(const Site& site, const std::string& text) {
    const SunDay day = sun_day(site, time_of_text(text));
    py::dict result;
    result["kind"] = day.kind == DayKind::ordinary    ? "ordinary"
                     : day.kind == DayKind::polar_day ? "polar_day"
                                                      : "polar_night";
    result["transit"] = civil_time_text(day.transit);
    result["sunrise"] = text_or_none(day.sunrise);
    result["sunset"] = text_or_none(day.sunset);
    result["transit_elevation_deg"] = day.transit_elevation_deg;
    return result;
}

}  // namespace

void bind_sun(py::module_& module) {
    py::class_<Site>(module, "Site")
        .def(
            py::init(&site_of), py::arg("latitude_deg"), py::arg("longitude_deg"),
            py::arg("elevation_m"), py::arg("pressure_hpa"), py::arg("temperature_c"));
    py::class_<SunPosition>(module, "SunPosition")
        .def_readonly("azimuth_deg", &SunPosition::azimuth_deg)
        .def_readonly("elevation_deg", &SunPosition::elevation_deg)
        .def_readonly("true_elevation_deg", &SunPosition::true_elevation_deg)
        .def_readonly("distance_au", &SunPosition::distance_au)
        .def_readonly("declination_deg", &SunPosition::declination_deg)
        .def_readonly("equation_of_time_min", &SunPosition::equation_of_time_min)
        .def_property_readonly("zenith_deg", &SunPosition::zenith_deg);
    module.def(
        "sun_position",
        [](const Site& site, const std::string& time, std::optional<double> delta_t_s) {
            return sun_position(site, time_of_text(time), delta_t_s);
        },
        py::arg("site"), py::arg("time"), py::arg("delta_t_s"));
    module.def("sun_day", &day_of, py::arg("site"), py::arg("date"));
}

}  // namespace quasimc::python
