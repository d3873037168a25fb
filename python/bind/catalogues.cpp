#include <map>

#include <pybind11/stl.h>

#include "bind.h"
#include "light/models/catalogue.h"
#include "meshio/formats.h"
#include "options/options.h"
#include "quasimc/result.h"
#include "resultio/describe_series.h"
#include "results/units.h"
#include "runfile/run_file_sections.h"
#include "text/document.h"

namespace quasimc::python {
namespace {

template <typename Rows>
py::dict summaries(const Rows& rows) {
    py::dict result;
    for (const auto& row : rows) {
        result[py::str(std::string(row.name))] = std::string(row.summary);
    }
    return result;
}

py::object value_of(const OptionValue& value) {
    return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
}

py::list option_rows() {
    const RunSpec usual;
    py::list rows;
    for (const Option& option : option_table()) {
        py::dict row;
        row["key"] = std::string(option.key);
        row["default"] = value_of(option.get(usual));
        row["unit"] = std::string(option.unit);
        row["takes"] = domain_text(option);
        row["summary"] = std::string(option.summary);
        rows.append(row);
    }
    return rows;
}

/// The unit of a quantity in a band of that unit.
std::string unit_of_quantity(
    const std::string& quantity, const std::string& unit, const std::string& length_unit) {
    for (const QuantityEntry& entry : quantity_table()) {
        if (entry.name == quantity) {
            return unit_of(entry, Band{"", unit}, length_unit);
        }
    }
    throw py::key_error(quantity);
}

py::dict quantity_rows() {
    py::dict rows;
    for (const QuantityEntry& entry : quantity_table()) {
        rows[py::str(std::string(entry.name))] =
            py::make_tuple(std::string(entry.summary), entry.is_flux);
    }
    return rows;
}

py::list sun_shade_rows() {
    py::list rows;
    for (const SunShadeEntry& entry : sun_shade_table()) {
        py::dict row;
        row["name"] = std::string(entry.name);
        row["of_sums"] = std::string(entry.of_sums);
        row["summary"] = std::string(entry.summary);
        row["has_bands"] = entry.has_bands();
        row["is_summed"] = entry.part == SunShadePart::direct;
        rows.append(row);
    }
    return rows;
}

}  // namespace

void bind_catalogues(py::module_& module) {
    module.def("options", &option_rows);
    module.def("quantities", &quantity_rows);
    module.def("sun_shade_quantities", &sun_shade_rows);
    module.def("sources", [] { return summaries(source_catalogue()); });
    module.def("skies", [] { return summaries(sky_catalogue()); });
    module.def("shapes", [] {
        py::list names;
        for (const std::string_view name : shape_names()) {
            names.append(std::string(name));
        }
        return names;
    });
    module.def(
        "unit_of", &unit_of_quantity, py::arg("quantity"), py::arg("unit"), py::arg("length_unit"));
    module.def(
        "summed_unit", [](const std::string& unit) { return summed_unit(unit).name; },
        py::arg("unit"));
}

}  // namespace quasimc::python
