#include "quasimc/gap_fraction.h"

#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "bind.h"
#include "result.h"
#include "scene.h"

namespace quasimc::python {
namespace {

using Shape = std::vector<py::ssize_t>;

py::ssize_t size_of(std::size_t size) {
    return static_cast<py::ssize_t>(size);
}

/// An index of each position, and of all positions together.
py::dict index_array(
    const GapFractions& found, const char* name, Estimate GapIndices::*index, py::dict arrays) {
    std::vector<Estimate> values;
    for (const GapIndices& one : found.by_position) {
        values.push_back(one.*index);
    }
    values.push_back(found.all.*index);
    arrays[name] = copied_array(values, {size_of(values.size()), 4});
    return arrays;
}

/// Numbers of the rings of each position, and of all positions together.
py::array ring_array(const GapFractions& found, std::vector<Estimate> GapIndices::*rings) {
    std::vector<Estimate> values;
    for (const GapIndices& one : found.by_position) {
        values.insert(values.end(), (one.*rings).begin(), (one.*rings).end());
    }
    values.insert(values.end(), (found.all.*rings).begin(), (found.all.*rings).end());
    return copied_array(
        values, {size_of(found.by_position.size() + 1), size_of(found.spec.rings()), 4});
}

py::dict measured(const SceneHandle& scene, const GapFractionSpec& spec) {
    GapFractions found;
    {
        const py::gil_scoped_release release;
        found = gap_fractions(*scene.scene, spec);
    }
    py::dict arrays;
    arrays["gaps"] = copied_array(
        found.gaps, {size_of(spec.positions.size()), size_of(spec.rings()),
                     size_of(spec.azimuths), 4});
    arrays["ring_gaps"] = ring_array(found, &GapIndices::gap);
    arrays["ring_clumping"] = ring_array(found, &GapIndices::clumping);
    index_array(found, "sky_transmittance", &GapIndices::sky_transmittance, arrays);
    index_array(
        found, "effective_plant_area_index", &GapIndices::effective_plant_area_index, arrays);
    index_array(found, "plant_area_index", &GapIndices::plant_area_index, arrays);
    index_array(found, "clumping_index", &GapIndices::clumping_index, arrays);
    arrays["closed_bins"] = found.all.closed_bins;
    return arrays;
}

}  // namespace

void bind_gap_fraction(py::module_& module) {
    module.def(
        "gap_fractions",
        [](const SceneHandle& scene, const std::vector<std::array<double, 3>>& positions,
           const py::kwargs& keys) {
            GapFractionSpec spec;
            spec.positions.clear();
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
            return measured(scene, spec);
        });
}

}  // namespace quasimc::python
