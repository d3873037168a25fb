#include "choice_cases.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "crops.h"
#include "quasimc/source.h"
#include "scenes.h"
#include "stands.h"
#include "width_scenes.h"

namespace quasimc::bench {
namespace {

/// Suns along the arc of a day, as bright together as one.
Sources suns_of_day(std::uint32_t count, std::size_t bands) {
    Sources suns;
    for (std::uint32_t i = 0; i < count; ++i) {
        const double angle = std::numbers::pi * (i + 0.5) / count;
        const double height = std::sin(angle);
        const Vec3 direction{-std::cos(angle), 0.5 * height, -std::sqrt(0.75) * height};
        suns.push_back(make_directional_source(
            "sun" + std::to_string(i), direction, std::vector<double>(bands, height / count)));
    }
    return suns;
}

Sources lamp(const Vec3& position, bool is_panel, std::size_t bands) {
    LampSpec lamp;
    lamp.name = "lamp";
    lamp.position = position;
    if (is_panel) {
        lamp.opening = {.kind = Opening::Kind::rectangle, .length = 6, .width = 4};
        lamp.pattern = cosine_pattern();
    }
    lamp.flux.assign(bands, 100);
    return {make_lamp(std::move(lamp))};
}

Sources both(Sources a, const Sources& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Dark and bright leaves under a sun, a sky, and both.
void add_lights(std::vector<ChoiceCase>& cases, const std::string& name, const Canopy& canopy) {
    for (const double albedo : {0.2, 0.9}) {
        Canopy one = canopy;
        one.albedos = {albedo};
        const std::string words = name + (albedo < 0.5 ? ", PAR" : ", NIR");
        const auto add = [&](const char* light, auto make) {
            cases.push_back({words + light, [one, make] {
                                 return ChoiceScene{make_canopy(one), make()};
                             }});
        };
        add(", sun", [] { return make_light(Light::sun, 1); });
        add(", sky", [] { return make_light(Light::overcast, 1); });
        add(", sun and sky",
            [] { return both(make_light(Light::sun, 1), make_light(Light::sky, 1)); });
        if (!canopy.is_repeated) {
            add(", panel", [] { return lamp({5, 5, 15}, true, 1); });
            add(", point inside", [] { return lamp({5, 5, 5}, false, 1); });
        }
    }
}

void add_suns(std::vector<ChoiceCase>& cases) {
    for (const std::uint32_t suns : {10U, 100U, 1000U, 10000U}) {
        for (const double albedo : {0.2, 0.9}) {
            cases.push_back(
                {std::to_string(suns) + " suns" + (albedo < 0.5 ? ", PAR" : ", NIR"),
                 [suns, albedo] {
                     return ChoiceScene{
                         make_canopy({.leaves = 500, .albedos = {albedo}}), suns_of_day(suns, 1)};
                 }});
        }
    }
}

void add_glossy(std::vector<ChoiceCase>& cases) {
    for (const double exponent : {10.0, 1000.0, std::numeric_limits<double>::infinity()}) {
        const std::string words = std::isinf(exponent)
                                      ? "mirrors"
                                      : "Phong " + std::to_string(static_cast<int>(exponent));
        add_lights(
            cases, "500, 10 measured, " + words,
            {.leaves = 500, .measured = 10, .phong_exponent = exponent});
        add_lights(
            cases, "500, 10 sensors, " + words,
            {.leaves = 500, .sensors = 10, .phong_exponent = exponent});
    }
}

void add_crops(std::vector<ChoiceCase>& cases) {
    constexpr std::uint32_t kTriangles = 3000;
    for (const Crop crop : kCrops) {
        for (const CropLight& light : lights_of(crop)) {
            cases.push_back({name_of(crop) + ", " + light.name, [crop, light] {
                                 return ChoiceScene{make_crop(crop, kTriangles), light.sources};
                             }});
        }
    }
}

void add_stands(std::vector<ChoiceCase>& cases) {
    for (const StandKind kind : kStandKinds) {
        cases.push_back({name_of(kind), [kind] {
                             return ChoiceScene{make_stand(kind, 500), light_of_stands()};
                         }});
    }
    for (const WidthCase& one : width_cases()) {
        if (std::string(one.name) != "season") {
            cases.push_back({one.name, [one] {
                                 WidthScene scene = one.make();
                                 return ChoiceScene{std::move(scene.scene), scene.sources};
                             }});
        }
    }
}

}  // namespace

std::vector<ChoiceCase> choice_cases() {
    std::vector<ChoiceCase> cases;
    for (const std::uint32_t leaves : {20U, 100U, 500U, 3000U, 10000U}) {
        add_lights(cases, std::to_string(leaves), {.leaves = leaves});
        add_lights(
            cases, std::to_string(leaves) + " in a cell", {.leaves = leaves, .is_repeated = true});
    }
    add_lights(cases, "500, 25 measured", {.leaves = 500, .measured = 25});
    add_lights(cases, "500, 10 sensors", {.leaves = 500, .sensors = 10});
    add_lights(cases, "10000, 100 measured", {.leaves = 10000, .measured = 100});
    add_lights(cases, "160000 in a cell", {.leaves = 160000, .is_repeated = true});
    add_suns(cases);
    add_glossy(cases);
    add_crops(cases);
    add_stands(cases);
    return cases;
}

}  // namespace quasimc::bench
