#include "growth.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "files/input_files.h"
#include "quasimc/run.h"
#include "replicates.h"
#include "result.h"
#include "run.h"
#include "runfile/run_file.h"
#include "scene.h"
#include "watch.h"

namespace quasimc::python {

FrameOfRun frame_of(const Document& document, const std::vector<py::dict>& meshes) {
    std::vector<MeshArrays> arrays;
    arrays.reserve(meshes.size());
    for (const py::dict& mesh : meshes) {
        arrays.push_back(arrays_of(mesh));
    }
    const py::gil_scoped_release release;
    InputFiles files(document.folder);
    return read_frame_document(document.node, document.name, files, [&](SceneBuilder& builder) {
        for (const MeshArrays& mesh : arrays) {
            add_organs(mesh, builder);
        }
    });
}

namespace {

/// A session, and the warnings on its run settings.
struct GrowthHandle {
    GrowthSession session;
    std::vector<Warning> frame_warnings;
};

GrowthHandle make_session(const Document& document, const std::vector<py::dict>& meshes) {
    FrameOfRun frame = frame_of(document, meshes);
    return {GrowthSession(std::move(frame.builder)), std::move(frame.warnings)};
}

void set_frame(
    GrowthHandle& handle, const Document& document, const std::vector<py::dict>& meshes) {
    FrameOfRun frame = frame_of(document, meshes);
    handle.session.set_frame(std::move(frame.builder));
    handle.frame_warnings = std::move(frame.warnings);
}

std::vector<std::int64_t> add_to(GrowthHandle& handle, const py::dict& mesh) {
    return handle.session.add(make_organs(arrays_of(mesh)));
}

void change_in(GrowthHandle& handle, const py::dict& mesh) {
    handle.session.change(make_organs(arrays_of(mesh)));
}

void remove_from(GrowthHandle& handle, const std::vector<std::int64_t>& ids) {
    handle.session.remove(ids);
}

/// The scene of this step, with the warnings on it and on its run settings.
SceneHandle scene_of(GrowthHandle& handle) {
    const py::gil_scoped_release release;
    std::vector<Warning> warnings = handle.frame_warnings;
    const std::vector<Warning>& of_scene = handle.session.warnings();
    warnings.insert(warnings.end(), of_scene.begin(), of_scene.end());
    return {handle.session.scene(), std::move(warnings)};
}

ResultWithSums run_step(
    GrowthHandle& handle,
    const LightHandle& light,
    double max_bytes,
    const py::object& on_progress) {
    ResultWithSums kept;
    WatchedWork(on_progress).run([&](const RunControl& control) {
        SumsKeeper keeper(max_bytes);
        RunControl own = control;
        own.listeners.push_back(&keeper);
        kept.first =
            reported_result(handle.session.run(light.light.sources, light.light.spec, own));
        kept.second = keeper.take(handle.session.scene(), light.light.sources, light.light.spec);
    });
    return kept;
}

}  // namespace

void bind_growth(py::module_& module) {
    py::class_<GrowthHandle>(module, "GrowthSession")
        .def(py::init(&make_session), py::arg("document"), py::arg("meshes"))
        .def("set_frame", &set_frame, py::arg("document"), py::arg("meshes"))
        .def("add", &add_to, py::arg("mesh"))
        .def("change", &change_in, py::arg("mesh"))
        .def("remove", &remove_from, py::arg("ids"))
        .def(
            "has", [](const GrowthHandle& h, std::int64_t id) { return h.session.has(id); },
            py::arg("id"))
        .def("scene", &scene_of)
        .def(
            "run", &run_step, py::arg("light"), py::arg("max_bytes"),
            py::arg("on_progress") = py::none())
        .def_property_readonly("size", [](const GrowthHandle& h) { return h.session.size(); })
        .def_property_readonly(
            "scene_builds", [](const GrowthHandle& h) { return h.session.scene_builds(); })
        .def_property_readonly(
            "tree_builds", [](const GrowthHandle& h) { return h.session.tree_builds(); });
}

}  // namespace quasimc::python
