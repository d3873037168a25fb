// Plants from models in cpfg's language.

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/stl.h>

#include "base/notices.h"
#include "bind.h"
#include "coupling/plants/environment_program.h"
#include "coupling/plants/light_in_process.h"
#include "coupling/plants/light_on_stand.h"
#include "coupling/plants/plant_organs.h"
#include "document.h"
#include "files/input_files.h"
#include "growth/plant.h"
#include "growth/turtle/mesh_drawing.h"
#include "quasimc/run.h"
#include "result.h"
#include "runfile/run_file.h"
#include "scene.h"
#include "watch.h"

namespace quasimc::python {
namespace {

/// The light of a step.
struct StepLightHandle {
    std::optional<SceneHandle> scene;
    std::vector<std::shared_ptr<Result>> results;  ///< one for all bands, or one per band
    std::vector<Band> bands;                       ///< with one result per band
    std::vector<std::string> source_notes, ratio_names;
    std::size_t plant_organs = 0;  ///< on a stand: the number of organs before the ground
};

/// A plant after a derivation step.
struct StepHandle {
    std::int64_t step = 0;
    std::string string;
    std::optional<std::string> image;
    std::unique_ptr<MeshDrawing> drawing;
    StepLightHandle light;
};

/// A stand in which a plant grows.
struct StandHandle {
    FrameOfRun frame;
    Document light;
    LightOnStand::Options options;
};

/// Reads a specification; the files that it names are relative to its folder.
Specification read_specification_file(const std::string& path, Notices& notices) {
    InputFiles files(absolute_path(path).parent_path());
    return read_specification_text(
        read_file(path), path, SpecificationKind::quasimc, files, notices);
}

/// The sources and options of a document.
LightOfRun read_step_light(const Document& document, const Scene& scene) {
    InputFiles files(document.folder);
    LightOfRun light =
        read_light_document(document.node, document.name, files, scene, document.vocabulary);
    if (light.series) {
        throw InputError(
            {{document.name, "a growth step has no time steps", "", "pass sources to grow()"}});
    }
    return light;
}

/// A model, and the environment of its plant, at most one.
struct PlantChoice {
    std::string model, view;
    std::int64_t steps = -1;  ///< negative: those of the model
    bool has_image = false;
    std::string specification, program;  ///< files
    const StandHandle* stand = nullptr;
};

/// A plant that grows, and its environment.
class GrowingPlant {
  public:
    explicit GrowingPlant(const PlantChoice& choice)
        : has_image_(choice.has_image),
          model_(PlantModel::read(choice.model, choice.view, notices_)),
          steps_(choice.steps) {
        if (!choice.specification.empty()) {
            set_specification(choice.specification);
        } else if (!choice.program.empty()) {
            set_program(choice.program);
        } else if (choice.stand != nullptr) {
            set_stand(*choice.stand);
        }
    }
    GrowingPlant(const GrowingPlant&) = delete;
    GrowingPlant& operator=(const GrowingPlant&) = delete;
    ~GrowingPlant() {
        try {
            close();
        } catch (...) {  // NOLINT(bugprone-empty-catch): the step can not report it any more
        }
    }

    /// The next step, with its light; null after the last one.
    std::unique_ptr<StepHandle> next(const py::object& on_progress) {
        std::unique_ptr<StepHandle> step;
        if (is_closed_) {
            return step;
        }
        WatchedWork(on_progress).run([&](const RunControl& control) {
            control_ = control;
            step = std::make_unique<StepHandle>(advance());
            if (control.stop.stop_requested()) {
                throw Stopped(StopReason::interrupted, "The growth was stopped.");
            }
        });
        return step;
    }

    /// Ends the growth, and the environment program.
    void close() {
        std::optional<py::gil_scoped_release> release;
        if (PyGILState_Check() != 0) {
            release.emplace();
        }
        is_closed_ = true;
        plant_.reset();
        environment_.reset();
    }

    [[nodiscard]] std::vector<std::string> take_notices() { return std::exchange(texts_, {}); }
    [[nodiscard]] py::str take_printed() {
        const std::string text = std::exchange(printed_, {});
        return py::reinterpret_steal<py::str>(
            PyUnicode_DecodeUTF8(text.data(), static_cast<py::ssize_t>(text.size()), "replace"));
    }

  private:
    void set_specification(const std::string& file) {
        const auto check = [this] {
            if (control_.stop.stop_requested()) {
                throw Stopped(StopReason::interrupted, "The light was stopped.");
            }
        };
        auto light = std::make_unique<LightInProcess>(
            read_specification_file(file, notices_), notices_,
            [this](const std::string& text) { texts_.push_back(text); },
            LightInProcess::Options{{}, check});
        specification_ = light.get();
        environment_ = std::move(light);
    }

    void set_program(const std::string& file) {
        environment_ = std::make_unique<EnvironmentProgram>(
            read_comm_text(read_file(file), file, notices_), file, notices_);
    }

    void set_stand(const StandHandle& given) {
        LightOnStand::Options options = given.options;
        options.sides = model_->view().contour_sides;
        options.control = [this] { return control_; };
        stand_warnings_ = given.frame.warnings;
        auto light = std::make_unique<LightOnStand>(
            given.frame.builder,
            [this, document = given.light](const Scene& scene) {
                return light_on(document, scene);
            },
            std::move(options));
        stand_ = light.get();
        environment_ = std::move(light);
    }

    StandLight light_on(const Document& document, const Scene& scene) {
        LightOfRun light = read_step_light(document, scene);
        light_.source_notes = std::move(light.source_notes);
        light_.ratio_names = light.spec.ratios;
        stand_warnings_.insert(stand_warnings_.end(), light.warnings.begin(), light.warnings.end());
        return {std::move(light.sources), std::move(light.spec)};
    }

    void start() {
        const auto print = [this](std::string_view text) { printed_ += text; };
        plant_ = std::make_unique<Plant>(
            model_, environment_.get(), notices_,
            GrowthOptions{.steps = steps_, .limits = {}, .print = print});
    }

    /// The plant as it is, with the light of the pass over its string.
    StepHandle advance() {
        if (!plant_) {
            start();
        }
        const bool is_last = plant_->is_grown();
        if (is_last) {
            plant_->finish();
        }
        StepHandle step = current();
        const bool has_passes = model_->asks_environment() && !is_last;
        if (!has_passes && pass_step() != step.step && (stand_ || specification_)) {
            plant_->observe(*environment_);
        }
        if (!is_last) {
            plant_->grow();
        }
        is_closed_ = is_last;
        if (pass_step() == step.step) {
            step.light = light();
        }
        return step;
    }

    StepHandle current() {
        StepHandle step;
        step.step = plant_->step();
        step.string = plant_->string().text();
        if (has_image_) {
            step.image = plant_->homomorphic_image().text();
        }
        step.drawing = std::make_unique<MeshDrawing>(model_->view().contour_sides);
        plant_->draw(*step.drawing);
        return step;
    }

    /// Steps before the last pass of light in this process; negative without one.
    [[nodiscard]] std::int64_t pass_step() const {
        if (stand_ != nullptr) {
            return stand_->pass_step();
        }
        const bool has_pass =
            specification_ != nullptr && !specification_->snapshot().light->organs.empty();
        return has_pass ? specification_->snapshot().step : -1;
    }

    StepLightHandle light() {
        StepLightHandle light = light_;
        if (stand_ != nullptr) {
            if (stand_->result()) {
                std::vector<Warning> warnings = stand_warnings_;
                const std::vector<Warning> of_scene = stand_->warnings();
                warnings.insert(warnings.end(), of_scene.begin(), of_scene.end());
                light.scene = {stand_->scene(), std::move(warnings)};
                light.results.push_back(reported_result(*stand_->result()));
                light.plant_organs = stand_->organs_of_plant();
            }
            return light;
        }
        const auto computed = specification_->snapshot().light;
        if (computed->scene && computed != last_) {
            last_ = computed;
            light.bands = specification_->specification().bands;
            light.scene = {std::make_shared<const Scene>(*computed->scene), {}};
            for (const Result& result : computed->results) {
                light.results.push_back(result.values.empty() ? nullptr : reported_result(result));
            }
        }
        return light;
    }

    std::vector<std::string> texts_;
    std::string printed_;
    Notices notices_{[this](const std::string& text) { texts_.push_back(text); }};
    bool has_image_;
    std::shared_ptr<const PlantModel> model_;
    std::int64_t steps_;
    RunControl control_;
    StepLightHandle light_;  // without scene and results
    std::vector<Warning> stand_warnings_;
    std::unique_ptr<PlantEnvironment> environment_;
    std::shared_ptr<const StepLight> last_;    // of the last step with light by a specification
    LightOnStand* stand_ = nullptr;            // environment_, if it is of this kind
    LightInProcess* specification_ = nullptr;  // the same
    std::unique_ptr<Plant> plant_;
    bool is_closed_ = false;
};

/// @param light  keys: specification or program (a file), or stand (a StandHandle); or none
std::unique_ptr<GrowingPlant> make_plant(
    const std::string& model,
    const std::string& view,
    std::int64_t steps,
    bool has_image,
    const py::dict& light) {
    PlantChoice choice{model, view, steps, has_image, {}, {}, nullptr};
    if (light.contains("specification")) {
        choice.specification = text_of(light["specification"]);
    } else if (light.contains("program")) {
        choice.program = text_of(light["program"]);
    } else if (light.contains("stand")) {
        choice.stand = light["stand"].cast<const StandHandle*>();
    }
    const py::gil_scoped_release release;
    return std::make_unique<GrowingPlant>(choice);
}

Quantity quantity_named(const std::string& name) {
    for (const QuantityEntry& entry : quantity_table()) {
        if (entry.name == name) {
            return entry.quantity;
        }
    }
    throw InputError(
        {{"grow", "there is no quantity '" + name + "'", "", "use quasimc.quantities()"}});
}

std::unique_ptr<StandHandle> make_stand(
    FrameOfRun frame,
    const Document& light,
    const std::map<std::string, std::string>& materials,
    const std::string& material,
    const std::string& quantity) {
    auto stand = std::make_unique<StandHandle>(StandHandle{std::move(frame), light, {}});
    for (const auto& [module, name] : materials) {
        stand->options.materials[module.at(0)] = name;
    }
    stand->options.default_material = material;
    stand->options.quantity = quantity_named(quantity);
    return stand;
}

py::list bands_of_results(const StepHandle& step) {
    py::list bands;
    for (const Band& band : step.light.bands) {
        bands.append(py::make_tuple(band.name, band.unit));
    }
    return bands;
}

std::optional<SceneHandle> drawn_scene(const StepHandle& step) {
    const py::gil_scoped_release release;
    std::optional<Scene> drawn = drawn_plant_scene(*step.drawing, step.step);
    if (!drawn) {
        return std::nullopt;
    }
    return SceneHandle{std::make_shared<const Scene>(std::move(*drawn)), {}};
}

}  // namespace

void bind_grow(py::module_& module) {
    py::class_<StepHandle>(module, "GrownStep")
        .def_readonly("step", &StepHandle::step)
        .def_readonly("string", &StepHandle::string)
        .def_readonly("image", &StepHandle::image)
        .def("organs", &drawn_scene)
        .def_property_readonly("scene", [](const StepHandle& h) { return h.light.scene; })
        .def_property_readonly("bands", &bands_of_results)
        .def_property_readonly("results", [](const StepHandle& h) { return h.light.results; })
        .def_property_readonly(
            "plant_organs", [](const StepHandle& h) { return h.light.plant_organs; })
        .def_property_readonly(
            "source_notes", [](const StepHandle& h) { return h.light.source_notes; })
        .def_property_readonly(
            "ratio_names", [](const StepHandle& h) { return h.light.ratio_names; });

    py::class_<StandHandle>(module, "PlantStand")
        .def(
            py::init([](const Document& document, const std::vector<py::dict>& meshes,
                        const Document& light, const std::map<std::string, std::string>& materials,
                        const std::string& material, const std::string& quantity) {
                return make_stand(frame_of(document, meshes), light, materials, material, quantity);
            }),
            py::arg("document"), py::arg("meshes"), py::arg("light"), py::arg("materials"),
            py::arg("material"), py::arg("quantity"));

    py::class_<GrowingPlant>(module, "GrowingPlant")
        .def(
            py::init(&make_plant), py::arg("model"), py::arg("view"), py::arg("steps"),
            py::arg("image"), py::arg("light"))
        .def("next", &GrowingPlant::next, py::arg("on_progress") = py::none())
        .def("close", &GrowingPlant::close)
        .def("take_notices", &GrowingPlant::take_notices)
        .def("take_printed", &GrowingPlant::take_printed);
}

}  // namespace quasimc::python
