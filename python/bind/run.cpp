#include "run.h"

#include <memory>
#include <utility>

#include <pybind11/stl.h>

#include "bind.h"
#include "files/input_files.h"
#include "light/source_origins.h"
#include "options/options.h"
#include "quasimc/run.h"
#include "replicates.h"
#include "result.h"
#include "scene.h"
#include "watch.h"

namespace quasimc::python {
namespace {

LightHandle read_light(const Document& document, const SceneHandle& scene) {
    const py::gil_scoped_release release;
    InputFiles files(document.folder);
    return {read_light_document(
        document.node, document.name, files, *scene.scene, document.vocabulary)};
}

ResultWithSums run_light(
    Simulator& simulator,
    const SceneHandle& scene,
    const LightHandle& light,
    double max_bytes,
    const py::object& on_progress) {
    ResultWithSums kept;
    WatchedWork(on_progress).run([&](const RunControl& control) {
        SumsKeeper keeper(max_bytes);
        RunControl own = control;
        own.listeners.push_back(&keeper);
        kept.first = reported_result(
            simulator.run(*scene.scene, light.light.sources, light.light.spec, own));
        kept.second = keeper.take(scene.scene, light.light.sources, light.light.spec);
    });
    return kept;
}

/// The sums of a share of a run as bytes, and its method with the reason for it.
/// @param index  of the share, from 0
py::tuple run_part(
    Simulator& simulator,
    const SceneHandle& scene,
    const LightHandle& light,
    std::uint64_t index,
    std::uint64_t count,
    const py::object& on_progress) {
    std::string bytes;
    ChosenMethod chosen;
    WatchedWork(on_progress).run([&](const RunControl& control) {
        RunSpec spec = light.light.spec;
        chosen = plan_method(*scene.scene, light.light.sources, spec);
        spec.method = chosen.method;
        spec.origins = complete_origins(light.light.sources, spec.origins);
        bytes = save_sums(simulator.sums(
            *scene.scene, light.light.sources, spec, 0, share_of(index + 1, count), control));
    });
    return py::make_tuple(py::bytes(bytes), std::string(method_name(chosen.method)), chosen.reason);
}

/// Whether the paths of a run are known before it.
bool has_fixed_paths(const LightHandle& handle) {
    const RunSpec& spec = handle.light.spec;
    return !handle.light.series && spec.target_error == 0 && spec.max_seconds == 0 &&
           spec.max_paths == 0 && spec.audit == 0;
}

}  // namespace

void bind_run(py::module_& module) {
    py::class_<LightHandle>(module, "Light")
        .def(py::init(&read_light), py::arg("document"), py::arg("scene"))
        .def_property_readonly(
            "has_times", [](const LightHandle& h) { return h.light.series.has_value(); })
        .def_property_readonly("has_fixed_paths", &has_fixed_paths)
        .def_property_readonly(
            "source_notes", [](const LightHandle& h) { return h.light.source_notes; })
        .def_property_readonly(
            "ratio_names", [](const LightHandle& h) { return h.light.spec.ratios; })
        .def_property_readonly(
            "warnings", [](const LightHandle& h) { return warning_texts(h.light.warnings); });

    py::class_<Simulator>(module, "Simulator")
        .def(py::init<>())
        .def(
            "part", &run_part, py::arg("scene"), py::arg("light"), py::arg("index"),
            py::arg("count"), py::arg("on_progress") = py::none())
        .def_property_readonly("builds", &Simulator::builds)
        .def(
            "run", &run_light, py::arg("scene"), py::arg("light"), py::arg("max_bytes"),
            py::arg("on_progress") = py::none());
}

}  // namespace quasimc::python
