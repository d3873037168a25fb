#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "stress/grammar.h"

// Scenes whose light comes through narrow gaps: boxes with a slit beside a wall or a lid of slats,
// panels that leave a chink, leaves that start at one point or axis.

namespace quasimc::stress {
namespace {

/// A box of three perpendicular edges, in the unit cube.
struct Box {
    Vec3 corner, along, across, up;

    [[nodiscard]] Vec3 at(double x, double y, double z) const {
        return corner + x * along + y * across + z * up;
    }
    [[nodiscard]] double shortest() const {
        return std::min({length(along), length(across), length(up)});
    }
};

Box random_box(Random& random) {
    const Vec3 up = random.chance(.85) ? Vec3{0, 0, 1} : random.direction();
    const double turn = random.chance(.5) ? 0 : random.between(0, 360);
    const double phi = turn * std::numbers::pi / 180;
    const Vec3 any = up.z == 1 ? Vec3{-std::sin(phi), std::cos(phi), 0} : random.direction();
    const Vec3 along = normalized(cross(any, up));
    const Vec3 across = cross(up, along);
    const std::vector<double> sides{
        random.between(.3, 1), random.between(.3, 1), random.between(.3, 1)};
    return {random.in_cube(0, .2), sides[0] * along, sides[1] * across, sides[2] * up};
}

void add_panel(Draft& draft, const Vec3& corner, const Vec3& a, const Vec3& b) {
    Node organ = empty_table();
    set(organ, "material", node_of(std::string("wall")));
    set(organ, "shape", node_of(std::string("parallelogram")));
    set(organ, "corner", node_of(draft.placed(corner)));
    set(organ, "edge_a", node_of(draft.scale * a));
    set(organ, "edge_b", node_of(draft.scale * b));
    add_table(draft.document, "organ", std::move(organ));
}

void add_walls(Draft& draft, const Box& box) {
    add_panel(draft, box.corner, box.along, box.across);
    add_panel(draft, box.corner, box.up, box.across);
    add_panel(draft, box.at(1, 0, 0), box.across, box.up);
    add_panel(draft, box.corner, box.along, box.up);
    add_panel(draft, box.at(0, 1, 0), box.up, box.along);
}

/// A lid of `count` slats of equal width, with a gap before each; the gaps as fractions of the lid.
void add_slats(Draft& draft, const Box& box, std::size_t count, double first, double other) {
    const double gaps = first + other * static_cast<double>(count - 1);
    const double width = (1 - gaps) / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double from = first + static_cast<double>(i) * (width + other);
        add_panel(draft, box.at(from, 0, 1), width * box.along, box.across);
    }
}

/// A rhombus or a triangle, pointed at its base.
void add_leaf(Draft& draft, const Vec3& base, const Vec3& to_tip, double width) {
    Random& random = draft.random;
    const Vec3 across = normalized(cross(to_tip, random.direction()));
    Node organ = empty_table();
    set(organ, "material", node_of(std::string("leaf")));
    if (random.chance(.5)) {
        set(organ, "shape", node_of(std::string("rhombus")));
        set(organ, "base", node_of(draft.placed(base)));
        set(organ, "length", node_of(draft.scale * to_tip));
        set(organ, "up", node_of(normalized(cross(across, to_tip))));
        set(organ, "width", node_of(draft.scale * width));
    } else {
        const Vec3 half = .5 * width * across;
        set(organ, "shape", node_of(std::string("triangle")));
        set(organ, "corners",
            node_of(std::vector<Vec3>{
                draft.placed(base), draft.placed(base + to_tip - half),
                draft.placed(base + to_tip + half)}));
    }
    add_table(draft.document, "organ", std::move(organ));
}

std::size_t count_leaves(Random& random) {
    return 5 + random.below(36);
}

/// Leaves within the box, whose base and tip keep clear of its sides.
void add_leaves(Draft& draft, const Box& box) {
    constexpr double kClear = .07;
    Random& random = draft.random;
    const double longest = random.between(.2, .8) * box.shortest();
    for (std::size_t i = count_leaves(random); i-- > 0;) {
        const Vec3 u = random.in_cube(kClear, 1 - kClear);
        const Vec3 v = random.in_cube(kClear, 1 - kClear);
        const Vec3 base = box.at(u.x, u.y, u.z);
        const Vec3 to_tip = box.at(v.x, v.y, v.z) - base;
        const double size = std::min(length(to_tip), longest);
        const double width = std::min(size * random.between(.1, .6), 2 * kClear * box.shortest());
        add_leaf(draft, base, size / length(to_tip) * to_tip, width);
    }
}

/// Leaves that start at one point of the box, or at points of an axis.
void add_whorl(Draft& draft, const Box& box) {
    constexpr double kClear = .07;
    Random& random = draft.random;
    const Vec3 u = random.in_cube(.3, .7);
    const Vec3 base = box.at(u.x, u.y, .1);
    const double height = random.chance(.5) ? 0 : random.between(.01, .6);
    // The program warns of ray bundles on thinner leaves, and they are not judged there.
    const double width = random.between(.15, .5);
    for (std::size_t i = count_leaves(random); i-- > 0;) {
        const Vec3 v = random.in_cube(kClear, 1 - kClear);
        const Vec3 start = base + height * random.unit() * box.up;
        const Vec3 to_tip = box.at(v.x, v.y, v.z) - start;
        add_leaf(draft, start, to_tip, width * length(to_tip));
    }
}

/// Panels whose common edge is an axis, as pages of a book.
void add_pages(Draft& draft, const Box& box) {
    Random& random = draft.random;
    const std::size_t count = 3 + random.below(10);
    const double radius =
        .45 * std::min(length(box.along), length(box.across)) * random.between(.4, 1);
    const Vec3 x = normalized(box.along), y = normalized(box.across);
    const double first = random.between(0, 7);
    const double step =
        random.chance(.5) ? random.power_of_ten(-1.5, -.5) : 6.28 / static_cast<double>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const double angle = first + step * static_cast<double>(i);
        const Vec3 out = radius * (std::cos(angle) * x + std::sin(angle) * y);
        add_panel(draft, box.at(.5, .5, .05), .9 * box.up, out);
    }
}

/// A lid with a slit beside a wall, of slats, or of two panels with a chink between them.
void add_lid(Draft& draft, const Box& box) {
    Random& random = draft.random;
    const double kind = random.unit();
    if (kind < .45) {
        add_slats(draft, box, 1, random.between(.003, .03), 0);
    } else if (kind < .8) {
        const double gap = random.between(.002, .01) / length(box.along);
        const double first = random.chance(.5) ? gap : 0;
        add_slats(draft, box, 3 + random.below(8), first, gap);
    } else {
        add_slats(draft, box, 2, 0, random.between(.003, .03));
    }
}

/// Walls are opaque; leaves scatter to both sides.
void add_gap_materials(Draft& draft) {
    Random& random = draft.random;
    Node wall = empty_table();
    set(wall, "name", node_of(std::string("wall")));
    set(wall, "reflectance", node_of(draft.spectrum(.3, .9)));
    add_table(draft.document, "material", std::move(wall));
    Node leaf = empty_table();
    set(leaf, "name", node_of(std::string("leaf")));
    set(leaf, "reflectance", node_of(draft.spectrum(.04, .5)));
    const double brightest = random.chance(.3) ? 0 : .48;
    set(leaf, "transmittance", node_of(draft.spectrum(0, brightest)));
    add_table(draft.document, "material", std::move(leaf));
}

}  // namespace

Node random_gap_run(Draft draft) {
    Random& random = draft.random;
    draft.is_periodic = false;
    add_gap_materials(draft);
    draft.materials = {"wall", "leaf"};
    const Box box = random_box(random);
    const double kind = random.unit();
    if (kind < .65) {  // a closed box
        add_walls(draft, box);
        add_lid(draft, box);
        random.chance(.75) ? add_leaves(draft, box) : add_whorl(draft, box);
    } else if (kind < .8) {  // panels above leaves and a floor
        add_panel(draft, box.corner, box.along, box.across);
        add_lid(draft, box);
        add_leaves(draft, box);
    } else if (kind < .93) {
        add_whorl(draft, box);
    } else {
        add_pages(draft, box);
        add_leaves(draft, box);
    }
    add_daylight(draft);
    return std::move(draft.document);
}

}  // namespace quasimc::stress
