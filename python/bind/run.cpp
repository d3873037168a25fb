#include "run.h"

#include <memory>
#include <utility>

#include <pybind11/stl.h>

#include "bind.h"
#include "files/input_files.h"
#include "quasimc/run.h"
#include "result.h"
#include "scene.h"
#include "watch.h"

namespace quasimc::python {
namespace {

LightHandle read_light(const Document& document, const SceneHandle& scene) {
    const py::gil_scoped_release release;
    InputFiles files(document.folder);
    return {read_light_document(document.node, document.name, files, *scene.scene)};
}

std::shared_ptr<Result> run_light(
    Simulator& simulator,
    const SceneHandle& scene,
    const LightHandle& light,
    const py::object& on_progress) {
    std::shared_ptr<Result> result;
    WatchedWork(on_progress).run([&](const RunControl& control) {
        result = reported_result(
            simulator.run(*scene.scene, light.light.sources, light.light.spec, control));
    });
    return result;
}

}  // namespace

void bind_run(py::module_& module) {
    py::class_<LightHandle>(module, "Light")
        .def(py::init(&read_light), py::arg("document"), py::arg("scene"))
        .def_property_readonly(
            "has_times", [](const LightHandle& h) { return h.light.series.has_value(); })
        .def_property_readonly(
            "source_notes", [](const LightHandle& h) { return h.light.source_notes; })
        .def_property_readonly(
            "ratio_names", [](const LightHandle& h) { return h.light.spec.ratios; })
        .def_property_readonly(
            "warnings", [](const LightHandle& h) { return warning_texts(h.light.warnings); });

    py::class_<Simulator>(module, "Simulator")
        .def(py::init<>())
        .def_property_readonly("builds", &Simulator::builds)
        .def(
            "run", &run_light, py::arg("scene"), py::arg("light"),
            py::arg("on_progress") = py::none());
}

}  // namespace quasimc::python
