#include <array>
#include <functional>
#include <utility>

#include "capi/guard.h"
#include "capi/handles.h"

namespace quasimc::capi {
namespace {

/// Changes the light or the options of a scene, which need not be built again.
int change_light(quasimc_scene* scene, const std::function<void(SceneDescription&)>& change) {
    return guarded([&] {
        quasimc_scene& all = deref(scene, "scene");
        const InUse use(all.in_use);
        change(all.description);
    });
}

/// Adds a source. @param amount  "irradiance_facing", "power", ...
int add_source(
    quasimc_scene* scene,
    const char* type,
    const char* amount,
    const double* numbers,
    const std::function<Node::Table()>& keys) {
    return change_light(scene, [&](SceneDescription& description) {
        Node::Table source = keys();
        source.push_back({"type", 0, {std::string(type)}});
        source.push_back(
            {amount, 0, numbers_node(of_bands(numbers, description.band_count(), amount))});
        description.add_table("source", std::move(source));
    });
}

}  // namespace
}  // namespace quasimc::capi

using namespace quasimc::capi;  // NOLINT(google-build-using-namespace): this file defines its own
using quasimc::Node;

int quasimc_scene_set_site(
    quasimc_scene* scene, double latitude_deg, double longitude_deg, double elevation_m) {
    return change_light(scene, [&](SceneDescription& description) {
        description.set_table(
            "site", {{"latitude_deg", 0, {latitude_deg}},
                     {"longitude_deg", 0, {longitude_deg}},
                     {"elevation_m", 0, {elevation_m}}});
    });
}

int quasimc_scene_add_directional(
    quasimc_scene* scene, double x, double y, double z, const double* irradiance_facing) {
    return add_source(scene, "directional", "irradiance_facing", irradiance_facing, [&] {
        return Node::Table{{"direction", 0, numbers_node(std::array{x, y, z})}};
    });
}

int quasimc_scene_add_sun(
    quasimc_scene* scene,
    double azimuth_deg,
    double elevation_deg,
    const double* irradiance_facing) {
    return add_source(scene, "sun", "irradiance_facing", irradiance_facing, [&] {
        return Node::Table{
            {"azimuth_deg", 0, {azimuth_deg}}, {"elevation_deg", 0, {elevation_deg}}};
    });
}

int quasimc_scene_add_sun_at(
    quasimc_scene* scene, const char* time, const double* irradiance_facing) {
    return add_source(scene, "sun", "irradiance_facing", irradiance_facing, [&] {
        return Node::Table{{"time", 0, {text_of(time, "time")}}};
    });
}

int quasimc_scene_add_sky(
    quasimc_scene* scene, const char* model, const double* irradiance_horizontal) {
    return add_source(scene, "sky", "irradiance_horizontal", irradiance_horizontal, [&] {
        return Node::Table{{"model", 0, {text_of(model, "model")}}};
    });
}

int quasimc_scene_add_point_lamp(
    quasimc_scene* scene, double x, double y, double z, const double* power) {
    return add_source(scene, "point", "power", power, [&] {
        return Node::Table{{"position", 0, numbers_node(std::array{x, y, z})}};
    });
}

int quasimc_scene_set_option(quasimc_scene* scene, const char* key, const char* value) {
    return change_light(scene, [&](SceneDescription& description) {
        description.set_option(text_of(key, "key"), text_of(value, "value"));
    });
}
