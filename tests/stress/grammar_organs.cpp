#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "stress/grammar.h"

namespace quasimc::stress {
namespace {

/// The pose of an organ: a position, two perpendicular directions, a size.
struct Pose {
    Vec3 position, along, across, normal;
    double size = 1;
};

Pose random_pose(Draft& draft) {
    Random& random = draft.random;
    Pose pose;
    pose.position = random.in_cube(0, 1);
    pose.normal = random.chance(.25) ? Vec3{0, 0, 1} : random.direction();
    const Vec3 other = random.direction();
    pose.along = normalized(cross(pose.normal, other));
    pose.across = cross(pose.normal, pose.along);
    pose.size = random.power_of_ten(-1.2, .1);
    if (!draft.anchors.empty() && random.chance(.15)) {  // in, on or near a surface
        const Anchor anchor = random.pick(draft.anchors);
        const double off = random.chance(.5) ? 0 : random.power_of_ten(-7, -1);
        pose.normal = anchor.normal;
        pose.along = normalized(cross(pose.normal, other));
        pose.across = cross(pose.normal, pose.along);
        pose.position = anchor.position + off * anchor.normal;
    }
    return pose;
}

void set_shape(Node& organ, const char* shape) {
    set(organ, "shape", node_of(std::string(shape)));
}

void triangle(Draft& draft, const Pose& p, Node& organ) {
    const double width = draft.random.chance(.25) ? draft.random.power_of_ten(-4, 0) : 1;
    const Vec3 a = p.position - p.size * .5 * p.along;
    const Vec3 b = p.position + p.size * .5 * p.along;
    const Vec3 c = p.position + p.size * width * p.across;
    set_shape(organ, "triangle");
    set(organ, "corners",
        node_of(std::vector<Vec3>{draft.placed(a), draft.placed(b), draft.placed(c)}));
}

void parallelogram(Draft& draft, const Pose& p, Node& organ) {
    const double width = draft.random.chance(.2) ? draft.random.power_of_ten(-4, 0) : 1;
    const Vec3 a = draft.scale * p.size * p.along;
    const Vec3 b = draft.scale * p.size * width * p.across;
    set_shape(organ, "parallelogram");
    set(organ, "corner", node_of(draft.placed(p.position) - .5 * (a + b)));
    set(organ, "edge_a", node_of(a));
    set(organ, "edge_b", node_of(b));
}

void rhombus(Draft& draft, const Pose& p, Node& organ) {
    set_shape(organ, "rhombus");
    set(organ, "base", node_of(draft.placed(p.position)));
    set(organ, "length", node_of(draft.scale * p.size * p.along));
    set(organ, "up", node_of(p.normal));
    set(organ, "width", node_of(draft.scale * p.size * draft.random.power_of_ten(-3, 0)));
}

void cylinder(Draft& draft, const Pose& p, Node& organ) {
    Random& random = draft.random;
    const double radius = draft.scale * p.size * random.power_of_ten(-2, -.3);
    set_shape(organ, "cylinder");
    set(organ, "base", node_of(draft.placed(p.position)));
    set(organ, "axis", node_of(draft.scale * p.size * p.normal));
    set(organ, "radius", node_of(radius));
    if (random.chance(.4)) {
        const double top = random.chance(.5) ? 0 : random.unit();
        set(organ, "radius_top", node_of(radius * top));
    }
    Node sides;
    sides.value = static_cast<std::int64_t>(3 + random.below(4));
    set(organ, "sides", std::move(sides));
    set(organ, "capped", boolean_node(random.chance(.5)));
}

void disk(Draft& draft, const Pose& p, Node& organ) {
    set_shape(organ, "disk");
    set(organ, "center", node_of(draft.placed(p.position)));
    set(organ, "normal", node_of(p.normal));
    set(organ, "radius", node_of(draft.scale * p.size * .5));
    Node sides;
    sides.value = static_cast<std::int64_t>(3 + draft.random.below(6));
    set(organ, "sides", std::move(sides));
}

void sphere(Draft& draft, const Pose& p, Node& organ) {
    set_shape(organ, "sphere");
    set(organ, "center", node_of(draft.placed(p.position)));
    set(organ, "radius", node_of(draft.scale * p.size * .5));
    Node levels;
    levels.value = static_cast<std::int64_t>(0);
    set(organ, "levels", std::move(levels));
}

/// A folded surface of a few triangles that share corners.
void mesh(Draft& draft, const Pose& p, Node& organ) {
    std::vector<Vec3> vertices{draft.placed(p.position)};
    Node faces = empty_list();
    const std::size_t corners = 3 + draft.random.below(4);
    const double bend = draft.random.chance(.4) ? 0 : draft.random.power_of_ten(-4, 0);
    for (std::size_t i = 0; i < corners; ++i) {
        const double angle = 1.1 * static_cast<double>(i);
        const double lift = bend * draft.random.between(-1, 1);
        vertices.push_back(draft.placed(
            p.position +
            p.size * .5 *
                (std::cos(angle) * p.along + std::sin(angle) * p.across + lift * p.normal)));
        if (i > 0) {
            Node face = empty_list();
            for (const std::size_t k : {std::size_t{0}, i, i + 1}) {
                Node number;
                number.value = static_cast<std::int64_t>(k);
                items(face).push_back(std::move(number));
            }
            items(faces).push_back(std::move(face));
        }
    }
    set_shape(organ, "mesh");
    set(organ, "vertices", node_of(vertices));
    set(organ, "faces", std::move(faces));
}

using Shape = void (*)(Draft&, const Pose&, Node&);

void add_organ(Draft& draft) {
    Random& random = draft.random;
    const std::array<Shape, 9> shapes{triangle, triangle, parallelogram, parallelogram, rhombus,
                                      cylinder, disk,     sphere,        mesh};
    const Pose pose = random_pose(draft);
    Node organ = empty_table();
    const bool is_sensor = !draft.sensors.empty() && random.chance(.3);
    set(organ, "material", node_of(is_sensor ? draft.sensors[0] : random.pick(draft.materials)));
    if (is_sensor && random.chance(.5)) {
        set(organ, "field_of_view_deg", node_of(random.between(5, 90)));
    }
    shapes[random.below(shapes.size())](draft, pose, organ);
    draft.anchors.push_back({pose.position, pose.normal});
    add_table(draft.document, "organ", std::move(organ));
}

/// Repeats the last organ with another material, so that surfaces coincide.
void repeat_organ(Draft& draft) {
    Node twin = items(*find(draft.document, "organ")).back();
    set(twin, "material", node_of(draft.random.pick(draft.materials)));
    if (Node* corners = find(twin, "corners"); corners != nullptr && draft.random.chance(.5)) {
        std::swap(items(*corners)[0], items(*corners)[1]);
    }
    std::erase_if(members(twin), [](const Member& m) { return m.key == "field_of_view_deg"; });
    add_table(draft.document, "organ", std::move(twin));
}

}  // namespace

void add_organs(Draft& draft) {
    const std::size_t count =
        draft.random.chance(.1) ? 8 + draft.random.below(8) : 1 + draft.random.below(5);
    for (std::size_t i = 0; i < count; ++i) {
        add_organ(draft);
        if (draft.random.chance(.03)) {
            repeat_organ(draft);
        }
    }
}

}  // namespace quasimc::stress
