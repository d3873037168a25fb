// Organs of shapes and files as they are before a scene is built from them.

#include "draft.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "scene.h"
#include "scene/build_scene.h"

namespace quasimc::python {
namespace {

template <typename T>
using Array = py::array_t<T, py::array::c_style>;

/// Puts the corners of a part at `out`. @returns the end of what was put
double* put_part(const SceneDraft& draft, const DraftPart& part, double* out) {
    for (std::size_t i = 0; i < draft.size_of(part); ++i) {
        for (const Vec3& p : draft.triangle(part, i)) {
            out = std::copy_n(std::array{p.x, p.y, p.z}.data(), 3, out);
        }
    }
    return out;
}

/// The triangles of all organs in the file's axes, (n, 3, 3), the material of each, and the first
/// of each organ.
void put_triangles(const SceneDraft& draft, py::dict& all) {
    const auto count = static_cast<py::ssize_t>(draft.triangle_count());
    Array<double> corners({count, py::ssize_t{3}, py::ssize_t{3}});
    Array<std::uint32_t> materials(count);
    std::vector<std::int64_t> starts{0};
    double* corner = corners.mutable_data();
    std::uint32_t* material = materials.mutable_data();
    for (std::size_t organ = 0; organ < draft.organs.size(); ++organ) {
        std::size_t size = 0;
        for (const DraftPart& part : draft.parts_of(organ)) {
            corner = put_part(draft, part, corner);
            material = std::fill_n(material, draft.size_of(part), part.material);
            size += draft.size_of(part);
        }
        starts.push_back(starts.back() + static_cast<std::int64_t>(size));
    }
    all["triangles"] = corners;
    all["material_of_triangle"] = materials;
    all["starts"] = Array<std::int64_t>(static_cast<py::ssize_t>(starts.size()), starts.data());
    all["material_names"] = draft.material_names;
}

/// Reflectance and transmittance of all materials by band; of the upper side.
py::dict optics_of(const BuilderData& data) {
    py::dict all;
    for (const auto& [material, where] : data.materials) {
        py::list reflectance, transmittance;
        for (const SideOptics& side : material.upper) {
            reflectance.append(side.reflectance);
            transmittance.append(side.transmittance);
        }
        all[py::str(material.name)] = py::make_tuple(reflectance, transmittance);
    }
    return all;
}

}  // namespace

py::dict draft_of(const Document& document) {
    const FrameOfRun frame = frame_of(document, {});
    const BuilderData& data = SceneAccess::data(frame.builder);
    py::dict all;
    put_triangles(data.draft, all);
    all["optics"] = optics_of(data);
    py::list measured, fields_of_view, labels;
    for (std::size_t i = 0; i < data.draft.organs.size(); ++i) {
        const Organ& organ = data.draft.organs[i];
        measured.append(organ.measured);
        fields_of_view.append(data.draft.given[i].field_of_view_deg);
        labels.append(py::cast(static_cast<const Labels&>(organ.labels)));
    }
    all["measured"] = measured;
    all["field_of_view_deg"] = fields_of_view;
    all["labels"] = labels;
    return all;
}

}  // namespace quasimc::python
