#include "quasimc/gap_fraction.h"

#include <array>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bind.h"
#include "scene.h"

namespace quasimc::python {
namespace {

/// A copy of estimates: the given shape and (mean, standard error, low, high).
py::array_t<double> copy_of(const std::vector<Estimate>& values, std::vector<std::size_t> shape) {
    static_assert(sizeof(Estimate) == 4 * sizeof(double));
    shape.push_back(4);
    return py::array_t<double>(shape, &values.front().mean);
}

/// The indices of each of several sets of positions, by name.
py::dict indices_of(const std::vector<GapIndices>& sets) {
    py::dict arrays;
    const auto add = [&](const char* name, std::vector<Estimate> GapIndices::*rings) {
        std::vector<Estimate> values;
        for (const GapIndices& one : sets) {
            values.insert(values.end(), (one.*rings).begin(), (one.*rings).end());
        }
        arrays[name] = copy_of(values, {sets.size(), values.size() / sets.size()});
    };
    const auto add_one = [&](const char* name, Estimate GapIndices::*index) {
        std::vector<Estimate> values;
        for (const GapIndices& one : sets) {
            values.push_back(one.*index);
        }
        arrays[name] = copy_of(values, {sets.size()});
    };
    add("gap", &GapIndices::gap);
    add("clumping", &GapIndices::clumping);
    add_one("sky_transmittance", &GapIndices::sky_transmittance);
    add_one("effective_plant_area_index", &GapIndices::effective_plant_area_index);
    add_one("plant_area_index", &GapIndices::plant_area_index);
    add_one("clumping_index", &GapIndices::clumping_index);
    return arrays;
}

py::dict measured(
    const SceneHandle& scene,
    const std::vector<std::array<double, 3>>& positions,
    const py::dict& keys) {
    GapFractionSpec spec;
    for (const auto& [x, y, z] : positions) {
        spec.positions.push_back({x, y, z});
    }
    spec.rings_deg = keys["rings_deg"].cast<std::vector<double>>();
    spec.azimuths = keys["azimuths"].cast<std::uint32_t>();
    spec.where = keys["where"].cast<std::string>();
    spec.rays = keys["rays"].cast<std::uint32_t>();
    spec.replicates = keys["replicates"].cast<std::uint32_t>();
    spec.seed = keys["seed"].cast<std::uint64_t>();
    spec.threads = keys["threads"].cast<unsigned>();
    GapFractions found;
    {
        const py::gil_scoped_release release;
        found = gap_fractions(*scene.scene, spec);
    }
    py::dict arrays;
    arrays["gaps"] =
        copy_of(found.gaps, {spec.positions.size(), spec.rings(), std::size_t{spec.azimuths}});
    arrays["by_position"] = indices_of(found.by_position);
    arrays["all"] = indices_of({found.all});
    arrays["closed_bins"] = found.all.closed_bins;
    return arrays;
}

}  // namespace

void bind_gap_fraction(py::module_& module) {
    module.def("gap_fractions", &measured);
}

}  // namespace quasimc::python
