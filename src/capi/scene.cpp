#include <cstdint>
#include <functional>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "capi/guard.h"
#include "capi/handles.h"
#include "capi/meshes.h"

namespace quasimc::capi {

int change_scene(quasimc_scene* scene, const std::function<void(SceneDescription&)>& change) {
    return guarded([&] {
        quasimc_scene& all = deref(scene, "scene");
        const InUse use(all.in_use);
        change(all.description);
        all.built.reset();
    });
}

namespace {

template <typename... Arguments>
int make_scene(quasimc_scene** scene, const Arguments&... arguments) {
    quasimc_scene*& out = deref(scene, "scene");
    out = nullptr;
    out = new quasimc_scene{SceneDescription(arguments...)};  // NOLINT: a handle
    return QUASIMC_DONE;
}

/// Whether the built scene does not depend on a part of the description.
bool is_of_light(quasimc_part part) {
    return part == QUASIMC_SITE || part == QUASIMC_SOURCES || part == QUASIMC_OPTIONS;
}

Member text_member(std::string key, std::string text) {
    return {std::move(key), 0, {std::move(text)}};
}

}  // namespace
}  // namespace quasimc::capi

using namespace quasimc::capi;  // NOLINT(google-build-using-namespace): this file defines its own
using quasimc::Node;

int quasimc_scene_new(quasimc_scene** scene) {
    return guarded([&] { make_scene(scene); });
}

int quasimc_scene_load(const char* run_file, quasimc_scene** scene) {
    return guarded([&] { make_scene(scene, std::string(&deref(run_file, "run_file"))); });
}

void quasimc_scene_free(quasimc_scene* scene) {
    delete scene;  // NOLINT: a handle
}

int quasimc_scene_state(quasimc_scene* scene, const char* toml) {
    return change_scene(
        scene, [&](SceneDescription& description) { description.add(text_of(toml, "toml")); });
}

int quasimc_scene_add_band(quasimc_scene* scene, const char* name, const char* unit) {
    return change_scene(scene, [&](SceneDescription& description) {
        Node::Table band{text_member("name", text_of(name, "name"))};
        if (const std::string of_band = optional_text(unit); !of_band.empty()) {
            band.push_back(text_member("unit", of_band));
        }
        description.add_table("band", std::move(band));
    });
}

int quasimc_scene_clear(quasimc_scene* scene, int part) {
    return guarded([&] {
        quasimc_scene& all = deref(scene, "scene");
        const InUse use(all.in_use);
        if (part < QUASIMC_BANDS || part > QUASIMC_SENSORS) {
            throw Misuse(fmt::format("there is no part {} of a scene", part));
        }
        const auto cleared = static_cast<quasimc_part>(part);
        all.description.clear(cleared);
        if (!is_of_light(cleared)) {
            all.built.reset();
        }
    });
}

int quasimc_scene_add_material(
    quasimc_scene* scene,
    const char* name,
    const double* reflectance,
    const double* transmittance) {
    return change_scene(scene, [&](SceneDescription& description) {
        const std::string of_material = text_of(name, "name");
        if (reflectance == nullptr && transmittance == nullptr) {
            throw Misuse("reflectance and transmittance are NULL");
        }
        Node::Table material{text_member("name", of_material)};
        if (reflectance != nullptr) {
            material.push_back(
                {"reflectance", 0,
                 numbers_node(of_bands(reflectance, description.band_count(), "reflectance"))});
        }
        if (transmittance != nullptr) {
            material.push_back(
                {"transmittance", 0,
                 numbers_node(of_bands(transmittance, description.band_count(), "transmittance"))});
        }
        description.put_table("material", of_material, std::move(material));
    });
}

// NOLINTNEXTLINE(readability-function-size): the arrays of the C interface
int quasimc_scene_add_mesh(
    quasimc_scene* scene,
    const double* vertices,
    int64_t vertex_count,
    const int32_t* faces,
    int64_t face_count,
    const int64_t* organ_of_face,
    const char* materials,
    const int32_t* material_of_face) {
    return change_scene(scene, [&](SceneDescription& description) {
        description.add_organs(organs_of(
            {vertices, vertex_count, faces, face_count, organ_of_face, materials, material_of_face,
             fmt::format("{}: mesh {}", description.name(), scene->meshes + 1)}));
        ++scene->meshes;
    });
}

int quasimc_scene_set_name(quasimc_scene* scene, int64_t organ, const char* name) {
    return change_scene(scene, [&](SceneDescription& description) {
        description.organ(organ).name = text_of(name, "name");
    });
}

int quasimc_scene_set_label(
    quasimc_scene* scene, int64_t organ, const char* key, const char* value) {
    return change_scene(scene, [&](SceneDescription& description) {
        quasimc::Labels& labels = description.organ(organ).labels;
        const std::string name = text_of(key, "key"), text = text_of(value, "value");
        std::erase_if(labels, [&](const auto& label) { return label.first == name; });
        labels.emplace_back(name, text);
    });
}

int quasimc_scene_set_ground(quasimc_scene* scene, const char* material, double height) {
    return change_scene(scene, [&](SceneDescription& description) {
        description.set_table(
            "ground",
            {text_member("material", text_of(material, "material")), {"height", 0, {height}}});
    });
}

int quasimc_scene_set_cell(
    quasimc_scene* scene, double x_low, double x_high, double y_low, double y_high) {
    return change_scene(scene, [&](SceneDescription& description) {
        description.set_table(
            "cell", {{"x", 0, numbers_node(std::array{x_low, x_high})},
                     {"y", 0, numbers_node(std::array{y_low, y_high})}});
    });
}
