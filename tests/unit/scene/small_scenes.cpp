#include "small_scenes.h"

#include <utility>

namespace quasimc::test {

MaterialSpec lambertian(std::string name, double reflectance, double transmittance) {
    SideOptics side;
    side.reflectance = reflectance;
    side.transmittance = transmittance;
    return {std::move(name), {side}, {side}};
}

SceneBuilder one_band_builder(const Orientation& orientation) {
    SceneBuilder builder({{"PAR", "W m-2"}}, orientation);
    builder.add_material(lambertian("leaf"));
    builder.add_material(lambertian("soil", 0.2, 0));
    return builder;
}

Triangle flat_triangle(const Vec3& p, double leg) {
    return {p, p + Vec3{leg, 0, 0}, p + Vec3{0, leg, 0}};
}

OrganSpec one_triangle(std::string name, const Triangle& triangle) {
    OrganSpec organ;
    organ.name = std::move(name);
    organ.parts.push_back({"leaf", {triangle}});
    return organ;
}

OrganSpec with_id(std::int64_t id, std::string where) {
    OrganSpec organ = one_triangle("", flat_triangle({0, 0, static_cast<double>(id)}));
    organ.id = id;
    organ.where = std::move(where);
    return organ;
}

std::vector<std::string> faults_of(SceneBuilder builder) {
    std::vector<std::string> texts;
    try {
        static_cast<void>(std::move(builder).build());
    } catch (const InputError& error) {
        for (const Fault& fault : error.faults()) {
            texts.push_back(fault.text());
        }
    }
    return texts;
}

std::vector<std::string> warnings_of(SceneBuilder builder) {
    std::vector<std::string> texts;
    for (const Warning& warning : lint(std::move(builder).build())) {
        texts.push_back(warning.where + ": " + warning.text);
    }
    return texts;
}

}  // namespace quasimc::test
