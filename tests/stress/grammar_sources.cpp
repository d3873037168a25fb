#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "stress/grammar.h"

namespace quasimc::stress {
namespace {

Node source_of(const char* type) {
    Node source = empty_table();
    set(source, "type", node_of(std::string(type)));
    return source;
}

void set_angles(Draft& draft, Node& source, bool is_above) {
    Random& random = draft.random;
    double elevation = is_above ? random.between(2, 90) : random.between(-30, 90);
    if (random.chance(.25)) {
        elevation = random.power_of_ten(draft.is_periodic ? 0 : -3, 1);  // grazing
    }
    if (random.chance(.1)) {
        elevation = 90;
    }
    if (draft.is_periodic && elevation < 1) {
        elevation += 31;
    }
    set(source, "azimuth_deg", node_of(random.chance(.2) ? 90 : random.between(0, 360)));
    set(source, "elevation_deg", node_of(elevation));
}

Node random_sun(Draft& draft) {
    const bool is_disk = draft.random.chance(.3);
    Node source = source_of(is_disk ? "sun" : "directional");
    set_angles(draft, source, is_disk);
    if (is_disk) {
        set(source, "disk", boolean_node(true));
    }
    set(source, "irradiance_facing", node_of(draft.spectrum(.1, 1)));
    return source;
}

Node random_sky(Draft& draft) {
    Random& random = draft.random;
    if (random.chance(.5)) {
        Node source = source_of("uniform_sky");
        set(source, "irradiance_horizontal", node_of(draft.spectrum(.1, 1)));
        return source;
    }
    Node source = source_of("sky");
    const std::vector<std::string> models{
        "cie_overcast", "cie_overcast", "cie_clear", "cie_general", "preetham"};
    const std::string model = random.pick(models);
    set(source, "model", node_of(model));
    if (model != "cie_overcast") {
        set(source, "azimuth_deg", node_of(random.between(0, 360)));
        set(source, "elevation_deg", node_of(random.between(5, 85)));
    }
    if (model == "cie_general") {
        Node type;
        type.value = static_cast<std::int64_t>(1 + random.below(15));
        set(source, "cie_type", std::move(type));
    }
    if (model == "preetham") {
        set(source, "turbidity", node_of(random.between(1.8, 9)));
    }
    set(source, "irradiance_horizontal", node_of(draft.spectrum(.1, 1)));
    return source;
}

/// A position above or within the scene, or next to a surface and then often in its plane.
Anchor lamp_anchor(Draft& draft) {
    Random& random = draft.random;
    const double kind = random.unit();
    if (kind < .4) {
        return {random.in_cube(0, 1) + Vec3{0, 0, 1.2}, {0, 0, -1}};
    }
    if (kind < .7 || draft.anchors.empty()) {
        return {random.in_cube(-.2, 1.2), random.direction()};
    }
    const Anchor anchor = random.pick(draft.anchors);
    const double off = random.power_of_ten(-5, -.5) * (random.chance(.5) ? 1 : -1);
    return {
        anchor.position + off * anchor.normal, random.chance(.5) ? anchor.normal : -anchor.normal};
}

Node random_lamp(Draft& draft) {
    Random& random = draft.random;
    const Anchor at = lamp_anchor(draft);
    const double size = draft.scale * random.power_of_ten(-2, 0);
    const std::vector<std::string> types{"point", "spot", "rectangle", "disk", "line", "sphere"};
    const std::string type = random.pick(types);
    Node source = source_of(type.c_str());
    if (type == "line") {
        const Vec3 along = .5 * size * normalized(cross(at.normal, random.direction()));
        set(source, "from", node_of(draft.placed(at.position) - along));
        set(source, "to", node_of(draft.placed(at.position) + along));
    } else {
        set(source, "position", node_of(draft.placed(at.position)));
    }
    if (type == "spot" || type == "rectangle" || type == "disk") {
        set(source, "aim", node_of(at.normal));
    }
    if (type == "rectangle") {
        set(source, "along", node_of(normalized(cross(at.normal, random.direction()))));
        set(source, "length", node_of(size));
        set(source, "width", node_of(size * random.power_of_ten(-1, 0)));
    }
    if (type == "disk" || type == "sphere") {
        set(source, "radius", node_of(.5 * size));
    }
    if (type == "spot") {
        set(source, "exponent", node_of(std::round(random.power_of_ten(0, 2))));
    }
    std::vector<double> power = draft.spectrum(.1, 1);
    for (double& p : power) {
        p *= draft.scale * draft.scale;
    }
    set(source, "power", node_of(power));
    return source;
}

}  // namespace

void add_daylight(Draft& draft) {
    const double kind = draft.random.unit();
    if (kind < .6) {
        add_table(draft.document, "source", random_sun(draft));
    }
    if (kind > .4) {
        add_table(draft.document, "source", random_sky(draft));
    }
}

void add_sources(Draft& draft) {
    constexpr double kMaxLight = 1e15;  // the largest value in run files
    const std::size_t count = draft.random.chance(.5) ? 1 : 1 + draft.random.below(3);
    const double brightness = draft.random.chance(.2) ? draft.random.power_of_ten(-6, 6) : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const double kind = draft.random.unit();
        Node source = kind < .35  ? random_sun(draft)
                      : kind < .7 ? random_sky(draft)
                                  : random_lamp(draft);
        // All sources have one brightness; occasionally one differs by orders of magnitude.
        const double factor =
            brightness * (draft.random.chance(.1) ? draft.random.power_of_ten(-3, 3) : 1);
        for (const char* key : {"irradiance_facing", "irradiance_horizontal", "power"}) {
            if (Node* values = find(source, key)) {
                for (Node& value : items(*values)) {
                    value = node_of(std::min(number_in(value) * factor, kMaxLight));
                }
            }
        }
        add_table(draft.document, "source", std::move(source));
    }
}

}  // namespace quasimc::stress
