#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "stress/grammar.h"

namespace quasimc::stress {
namespace {

/// A lobe's model with its parameter, for "reflection" or "transmission".
void add_model(Node& side, const std::string& which, Random& random) {
    const double kind = random.unit();
    const std::string model = which + "_model";
    if (kind < .35) {
        set(side, model, node_of(std::string("mirror")));
    } else if (kind < .85) {
        const std::vector<std::string> names{"phong", "blinn_phong", "clipped_blinn_phong"};
        set(side, model, node_of(random.pick(names)));
        const double exponent = random.power_of_ten(0, 3.5);
        set(side, which + "_exponent", node_of(std::round(exponent)));
    } else {
        set(side, model, node_of(std::string("coated_lambertian")));
    }
}

/// Reflectance and transmittance of one side.
Node random_side(Draft& draft, double brightest, bool is_diffuse) {
    Random& random = draft.random;
    const double share = random.chance(.3) ? 0 : random.unit();
    Node side = empty_table();
    std::vector<double> rho, tau;
    for (std::size_t b = 0; b < draft.bands; ++b) {
        const double albedo = brightest * random.between(.3, 1);
        rho.push_back(albedo * (1 - share));
        tau.push_back(albedo * share * .999);
    }
    set(side, "reflectance", node_of(rho));
    set(side, "transmittance", node_of(tau));
    if (!is_diffuse && random.chance(.7)) {
        add_model(side, "reflection", random);
    }
    if (!is_diffuse && share > 0 && random.chance(.5)) {
        add_model(side, "transmission", random);
    }
    return side;
}

Node random_material(Draft& draft, const std::string& name) {
    Random& random = draft.random;
    Node material = empty_table();
    set(material, "name", node_of(name));
    const std::vector<double> brightest{0, .15, .5, .5, .9, .97};
    const bool is_diffuse = random.chance(.7);
    if (random.chance(.7)) {
        Node both = random_side(draft, random.pick(brightest), is_diffuse);
        for (Member& member : members(both)) {
            set(material, member.key, std::move(member.node));
        }
        return material;
    }
    for (const char* side : {"upper", "lower"}) {
        set(material, side, random_side(draft, random.pick(brightest), is_diffuse));
    }
    return material;
}

}  // namespace

void add_materials(Draft& draft) {
    const std::size_t count = 1 + draft.random.below(3);
    for (std::size_t i = 0; i < count; ++i) {
        const std::string name = fmt::format("m{}", i);
        add_table(draft.document, "material", random_material(draft, name));
        draft.materials.push_back(name);
    }
    if (draft.random.chance(.15)) {
        Node sensor = empty_table();
        set(sensor, "name", node_of(std::string("sensor")));
        set(sensor, "transmittance", node_of(1.0));
        set(sensor, "transmission_model", node_of(std::string("mirror")));
        add_table(draft.document, "material", std::move(sensor));
        draft.sensors.emplace_back("sensor");
    }
}

}  // namespace quasimc::stress
