#include "scene.h"

#include <array>
#include <filesystem>
#include <utility>

#if __has_include(<malloc.h>)
#include <malloc.h>
#endif

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include "base/text.h"
#include "bind.h"
#include "document.h"
#include "draft.h"
#include "files/input_files.h"
#include "results/groups.h"
#include "results/organ_height.h"
#include "results/organ_values.h"
#include "results/sensor_transmittance.h"
#include "results/where_expression.h"
#include "runfile/run_file.h"
#include "runfile/table_rows.h"
#include "scene/mesh_arrays.h"
#include "scene/overlap/known_overlaps.h"
#include "scene/sensors.h"

namespace quasimc::python {
namespace {

using Doubles = py::array_t<double, py::array::c_style>;

template <typename T>
std::span<const T> span_of(const py::object& array) {
    if (array.is_none()) {
        return {};
    }
    const auto exact = py::cast<py::array_t<T, py::array::c_style>>(array);
    if (exact.ptr() != array.ptr()) {
        throw py::type_error("an array of another type or layout was given to _core");
    }
    return {exact.data(), static_cast<std::size_t>(exact.size())};
}

std::variant<std::span<const std::int32_t>, std::span<const std::int64_t>> faces_of(
    const py::object& faces) {
    if (faces.is_none() || py::isinstance<py::array_t<std::int64_t>>(faces)) {
        return span_of<std::int64_t>(faces);
    }
    return span_of<std::int32_t>(faces);
}

std::vector<std::string> texts_of(const py::object& list) {
    std::vector<std::string> texts;
    for (const py::handle text : list) {
        texts.push_back(text_of(text));
    }
    return texts;
}

}  // namespace

MeshArrays arrays_of(const py::dict& mesh) {
    MeshArrays arrays;
    arrays.where = mesh["where"].cast<std::string>();
    arrays.vertices = span_of<double>(mesh["vertices"]);
    arrays.faces = faces_of(mesh["faces"]);
    arrays.order = span_of<std::int64_t>(mesh["order"]);
    arrays.starts = span_of<std::int64_t>(mesh["starts"]);
    arrays.ids = span_of<std::int64_t>(mesh["ids"]);
    arrays.materials = texts_of(mesh["materials"]);
    arrays.material_of_face = span_of<std::uint32_t>(mesh["material_of_face"]);
    arrays.names = texts_of(mesh["names"]);
    for (const py::handle label : mesh["labels"]) {
        const auto [key, values] = label.cast<std::pair<py::object, py::object>>();
        arrays.labels.emplace_back(text_of(key), texts_of(values));
    }
    arrays.measured = mesh["measured"].cast<bool>();
    arrays.field_of_view_deg = mesh["field_of_view_deg"].cast<double>();
    return arrays;
}

namespace {

/// The tables of scenes that Python made.
constexpr std::array kTableNames{
    TableName{"run", "run options"},
    TableName{"site", "Scene.site"},
    TableName{"time", "Scene.time"},
};

/// Returns freed memory to the system: the threads of runs allocate from other arenas.
void give_memory_back() {
#ifdef __GLIBC__
    malloc_trim(0);
#endif
}

/// Adds the organs of dicts, which the caller keeps.
AddOrgans adder_of(const std::vector<py::dict>& meshes) {
    std::vector<MeshArrays> arrays;
    arrays.reserve(meshes.size());
    for (const py::dict& mesh : meshes) {
        arrays.push_back(arrays_of(mesh));
    }
    return [arrays = std::move(arrays)](SceneBuilder& builder) {
        for (const MeshArrays& mesh : arrays) {
            add_organs(mesh, builder);
        }
    };
}

/// @param meshes  dicts, which the caller keeps
/// @param overlaps  of the previous scene; or null
SceneHandle build(
    const Document& document, const std::vector<py::dict>& meshes, KnownOverlaps* overlaps) {
    const AddOrgans add_organs = adder_of(meshes);
    const py::gil_scoped_release release;
    InputFiles files(document.folder);
    SceneOfRun read = read_scene_document(
        document.node, document.name, files, add_organs, overlaps, document.vocabulary);
    give_memory_back();
    return {std::make_shared<const Scene>(std::move(read.scene)), std::move(read.warnings)};
}

Document read_document(const std::string& path) {
    const py::gil_scoped_release release;
    const std::string text = read_file(path);
    return {read_toml(text, path), path, std::filesystem::absolute(path).parent_path().string()};
}

/// Bands, materials and axes, for checks of meshes. Invalid materials are refused.
FrameOfRun read_frame(const Document& document) {
    FrameOfRun frame = frame_of(document, {});
    frame.builder.check_organs({});
    return frame;
}

void check_mesh(const FrameOfRun& frame, const py::dict& mesh) {
    const MeshArrays arrays = arrays_of(mesh);
    const py::gil_scoped_release release;
    frame.builder.check_organs(make_organs(arrays));
}

/// One number for each organ.
template <typename T, typename Get>
py::array_t<T> of_organs(const Scene& scene, Get get) {
    py::array_t<T> array(static_cast<py::ssize_t>(scene.organs().size()));
    T* out = array.mutable_data();
    for (const Organ& organ : scene.organs()) {
        *out++ = get(organ);
    }
    return array;
}

/// Whether a condition holds for each organ. @throws InputError
py::array_t<bool> organs_where(const SceneHandle& handle, const std::string& condition) {
    const WhereExpression where(condition);
    const OrganValues values(*handle.scene, {});
    where.check_names(values.names(), "label");
    return of_organs<bool>(
        *handle.scene, [&](const Organ& organ) { return values.holds(where, organ); });
}

py::list names_of(const Scene& scene) {
    py::list names(scene.organs().size());
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        names[i] = py::str(scene.organs()[i].name);
    }
    return names;
}

py::list empty_texts(std::size_t count) {
    py::list texts(count);
    for (std::size_t i = 0; i < count; ++i) {
        texts[i] = py::str("");
    }
    return texts;
}

/// Each key with the values of all organs; "" where an organ has none.
py::dict labels_of(const Scene& scene) {
    py::dict labels;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        for (const auto& [key, value] : scene.organs()[i].labels) {
            const py::str name(key);
            if (!labels.contains(name)) {
                labels[name] = empty_texts(scene.organs().size());
            }
            labels[name].cast<py::list>()[i] = py::str(value);
        }
    }
    return labels;
}

/// The sets of sensors: name, shape, names and positions of its results, in the file's axes, and
/// whether they are spheres; and the horizontal area, if they receive the light on it.
py::list sensors_of(const SceneHandle& handle) {
    const Scene& scene = *handle.scene;
    const std::vector<Vec3> positions = sensor_positions(scene);
    const SensorTransmittance fraction(scene);
    py::list sets;
    std::size_t first = 0;
    for (const SensorSet& set : scene.sensors()) {
        py::dict own;
        own["name"] = set.name;
        own["shape"] = py::tuple(py::cast(sensor_shape(set)));
        own["is_sphere"] = set.receiver == Receiver::sphere;
        own["horizontal_area"] =
            fraction.has(first) ? py::object(py::float_(horizontal_area(scene))) : py::none();
        py::list names;
        Doubles array({static_cast<py::ssize_t>(set.rows()), py::ssize_t{3}});
        double* out = array.mutable_data();
        for (std::size_t i = 0; i < set.rows(); ++i) {
            names.append(set.is_averaged ? set.name : set.points[i].name);
            const Vec3 p = scene.orientation().outward(positions[first + i]);
            *out++ = p.x;
            *out++ = p.y;
            *out++ = p.z;
        }
        own["names"] = names;
        own["positions"] = array;
        sets.append(own);
        first += set.rows();
    }
    return sets;
}

/// The triangles of an organ in the file's axes: shape (n, 3, 3).
Doubles triangles_of(const SceneHandle& handle, std::size_t organ) {
    const Scene& scene = *handle.scene;
    const std::vector<Triangle> triangles = scene.triangles_of(scene.organs().at(organ));
    Doubles array({static_cast<py::ssize_t>(triangles.size()), py::ssize_t{3}, py::ssize_t{3}});
    double* out = array.mutable_data();
    for (const Triangle& triangle : triangles) {
        for (const Vec3& corner : triangle) {
            const Vec3 p = scene.orientation().outward(corner);
            *out++ = p.x;
            *out++ = p.y;
            *out++ = p.z;
        }
    }
    return array;
}

py::list bands_of(const Scene& scene) {
    py::list bands;
    for (const Band& band : scene.bands()) {
        bands.append(py::make_tuple(band.name, band.unit));
    }
    return bands;
}

/// The material of each organ: that of its first triangles.
std::vector<std::string> materials_of(const SceneHandle& handle) {
    std::vector<std::string> materials(handle.scene->organs().size());
    for (const Region& region : handle.scene->regions()) {
        std::string& material = materials.at(region.organ.value);
        if (material.empty()) {
            material = handle.scene->material_name(region);
        }
    }
    return materials;
}

}  // namespace

FrameOfRun frame_of(const Document& document, const std::vector<py::dict>& meshes) {
    const AddOrgans add_organs = adder_of(meshes);
    const py::gil_scoped_release release;
    InputFiles files(document.folder);
    return read_frame_document(
        document.node, document.name, files, add_organs, document.vocabulary);
}

py::list warning_texts(const std::vector<Warning>& warnings) {
    py::list texts;
    for (const Warning& warning : warnings) {
        texts.append(py::str(
            printable(warning.where.empty() ? warning.text : warning.where + ": " + warning.text)));
    }
    return texts;
}

namespace {

void bind_document(py::module_& module) {
    py::class_<Document>(module, "Document")
        .def(
            py::init([](const py::dict& table, std::string name, std::string folder) {
                const Vocabulary python(kTableNames);
                return Document{to_node(table), std::move(name), std::move(folder), python, {}};
            }),
            py::arg("table"), py::arg("name"), py::arg("folder"))
        .def_static("read", &read_document, py::arg("path"))
        .def_readonly("name", &Document::name)
        .def_readonly("folder", &Document::folder)
        .def("table", [](const Document& document) { return to_python(document.node); })
        .def("draft", &draft_of)
        .def("build", &build, py::arg("meshes"), py::arg("overlaps") = nullptr);
}

}  // namespace

void bind_scene(py::module_& module) {
    bind_document(module);
    py::class_<KnownOverlaps>(module, "KnownOverlaps").def(py::init<>());

    py::class_<FrameOfRun>(module, "Frame")
        .def(py::init(&read_frame), py::arg("document"))
        .def("check", &check_mesh, py::arg("mesh"));

    py::class_<SceneHandle>(module, "Scene")
        .def_property_readonly(
            "warnings", [](const SceneHandle& h) { return warning_texts(h.warnings); })
        .def_property_readonly("bands", [](const SceneHandle& h) { return bands_of(*h.scene); })
        .def_property_readonly(
            "length_unit", [](const SceneHandle& h) { return h.scene->length_unit(); })
        .def_property_readonly(
            "triangle_count", [](const SceneHandle& h) { return h.scene->triangle_count(); })
        .def_property_readonly(
            "organ_count", [](const SceneHandle& h) { return h.scene->organs().size(); })
        .def_property_readonly(
            "up",
            [](const SceneHandle& h) {
                return h.scene->orientation().up() == UpAxis::z ? "z" : "y";
            })
        .def_property_readonly(
            "has_ground", [](const SceneHandle& h) { return h.scene->organs().back().is_ground; })
        .def_property_readonly(
            "ids",
            [](const SceneHandle& h) {
                return of_organs<std::int64_t>(*h.scene, [](const Organ& o) { return o.id; });
            })
        .def_property_readonly(
            "areas",
            [](const SceneHandle& h) {
                return of_organs<double>(*h.scene, [](const Organ& o) { return o.area; });
            })
        .def_property_readonly(
            "heights",
            [](const SceneHandle& h) {
                return of_organs<double>(*h.scene, [&](const Organ& organ) {
                    return height_of(*h.scene, organ).centroid;
                });
            })
        .def_property_readonly("materials", &materials_of)
        .def_property_readonly("names", [](const SceneHandle& h) { return names_of(*h.scene); })
        .def_property_readonly("labels", [](const SceneHandle& h) { return labels_of(*h.scene); })
        .def_property_readonly("sensors", &sensors_of)
        .def("where", &organs_where, py::arg("condition"))
        .def("triangles_of", &triangles_of, py::arg("organ"));
}

}  // namespace quasimc::python
