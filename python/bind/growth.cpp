#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "bind.h"
#include "io/input_files.h"
#include "io/runfile/run_file.h"
#include "quasimc/growth_session.h"
#include "run.h"
#include "scene.h"
#include "watch.h"

namespace quasimc::python {
namespace {

SceneBuilder frame_of(const Document& document, const std::vector<py::dict>& meshes) {
    std::vector<MeshArrays> arrays;
    arrays.reserve(meshes.size());
    for (const py::dict& mesh : meshes) {
        arrays.push_back(arrays_of(mesh));
    }
    const py::gil_scoped_release release;
    InputFiles files(document.folder);
    return read_frame_document(
               document.node, document.name, files,
               [&](SceneBuilder& builder) {
                   for (const MeshArrays& mesh : arrays) {
                       add_organs(mesh, builder);
                   }
               })
        .builder;
}

std::vector<std::int64_t> add_to(GrowthSession& session, const py::dict& mesh) {
    std::vector<std::int64_t> ids;
    for (OrganSpec& organ : make_organs(arrays_of(mesh))) {
        ids.push_back(session.add(std::move(organ)));
    }
    return ids;
}

void change_in(GrowthSession& session, const py::dict& mesh) {
    for (OrganSpec& organ : make_organs(arrays_of(mesh))) {
        session.change(std::move(organ));
    }
}

SceneHandle scene_of(GrowthSession& session) {
    const py::gil_scoped_release release;
    return {session.scene(), {}};
}

std::shared_ptr<Result> run_step(
    GrowthSession& session, const LightHandle& light, const py::object& on_progress) {
    auto result = std::make_shared<Result>();
    WatchedWork(on_progress).run([&](const auto& tell, const std::stop_token& stop) {
        *result =
            session.run(light.light.sources, light.light.spec, {.on_progress = tell, .stop = stop});
    });
    return result;
}

}  // namespace

void bind_growth(py::module_& module) {
    py::class_<GrowthSession>(module, "GrowthSession")
        .def(
            py::init([](const Document& document, const std::vector<py::dict>& meshes) {
                return GrowthSession(frame_of(document, meshes));
            }),
            py::arg("document"), py::arg("meshes"))
        .def(
            "set_frame",
            [](GrowthSession& session, const Document& document,
               const std::vector<py::dict>& meshes) {
                session.set_frame(frame_of(document, meshes));
            },
            py::arg("document"), py::arg("meshes"))
        .def("add", &add_to, py::arg("mesh"))
        .def("change", &change_in, py::arg("mesh"))
        .def("remove", &GrowthSession::remove, py::arg("id"))
        .def("has", &GrowthSession::has, py::arg("id"))
        .def("scene", &scene_of)
        .def("run", &run_step, py::arg("light"), py::arg("on_progress") = py::none())
        .def_property_readonly("size", &GrowthSession::size)
        .def_property_readonly("scene_builds", &GrowthSession::scene_builds)
        .def_property_readonly("tree_builds", &GrowthSession::tree_builds);
}

}  // namespace quasimc::python
