#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

using Triangles = std::vector<Triangle>;

constexpr Range kSides{3, 10000};
constexpr Range kLevels{0, 7};
constexpr Range kFlatness{1e-5, 1};

std::optional<double> read_length(TableReader& table, std::string_view key) {
    const std::optional<double> value = table.real(key);
    if (value && *value <= 0) {
        table.fault_at(key, fmt::format("{} is {}", key, *value), "it must be more than 0");
        return std::nullopt;
    }
    return value;
}

/// Reads a vector that is not zero.
std::optional<Vec3> read_axis(TableReader& table, std::string_view key) {
    const std::optional<Vec3> value = table.required(key, table.vector(key));
    if (value && *value == Vec3{}) {
        table.fault_at(key, fmt::format("{} is [0, 0, 0]", key), "it must have a length");
        return std::nullopt;
    }
    return value;
}

Triangles read_triangle(TableReader& table) {
    const auto corners = table.required("corners", table.vectors("corners"));
    if (corners && corners->size() != 3) {
        table.fault_at("corners", fmt::format("{} corners", corners->size()), "a triangle has 3");
    }
    return table.failed() ? Triangles()
                          : make_triangle((*corners)[0], (*corners)[1], (*corners)[2]);
}

Triangles read_parallelogram(TableReader& table) {
    const auto corner = table.required("corner", table.vector("corner"));
    const auto a = table.required("edge_a", table.vector("edge_a"));
    const auto b = table.required("edge_b", table.vector("edge_b"));
    return table.failed() ? Triangles() : make_parallelogram(*corner, *a, *b);
}

Triangles read_rhombus(TableReader& table) {
    const auto base = table.required("base", table.vector("base"));
    const auto along = read_axis(table, "length");
    const auto up = read_axis(table, "up");
    const auto width = table.required("width", read_length(table, "width"));
    if (along && up && cross(*along, *up) == Vec3{}) {
        table.fault_at(
            "up", "up points along length", "the upper side of the leaf would be undefined");
    }
    return table.failed() ? Triangles() : make_rhombus(*base, *along, *up, *width);
}

Triangles read_polygon(TableReader& table) {
    const auto corners = table.required("corners", table.vectors("corners"));
    if (corners && (corners->size() < 3 || corners->size() > kMaxCorners)) {
        table.fault_at(
            "corners", fmt::format("{} corners", corners->size()),
            fmt::format("a polygon has 3 to {}", kMaxCorners));
    }
    return table.failed() ? Triangles() : make_polygon(*corners);
}

std::optional<BezierPatch> read_patch(TableReader& table, const Node& node, std::size_t index) {
    const std::string key = fmt::format("patches[{}]", index);
    const auto points = table.vectors_at(key, node);
    if (!points) {
        return std::nullopt;
    }
    BezierPatch patch;
    if (points->size() != patch.size()) {
        table.fault_at(
            node, fmt::format("{} has {} points", key, points->size()),
            "a bicubic patch has 16: four rows of four");
        return std::nullopt;
    }
    std::copy(points->begin(), points->end(), patch.begin());
    return patch;
}

Triangles read_bezier(TableReader& table) {
    const double flatness = table.real("flatness", kFlatness).value_or(Flatness{}.tolerance);
    const Node* node = table.any("patches");
    const auto* list = node ? node->as<Node::List>() : nullptr;
    if (list == nullptr || list->empty()) {
        table.fault_at(
            "patches", "patches is missing or not a list",
            "it must be a list of patches, each a list of 16 points");
        return {};
    }
    std::vector<BezierPatch> patches;
    for (std::size_t i = 0; i < list->size(); ++i) {
        if (const auto patch = read_patch(table, (*list)[i], i)) {
            patches.push_back(*patch);
        }
    }
    return table.failed() ? Triangles() : make_bezier_surface(patches, {flatness});
}

Triangles read_cylinder(TableReader& table) {
    const auto base = table.required("base", table.vector("base"));
    const auto axis = read_axis(table, "axis");
    const auto radius = table.required("radius", read_length(table, "radius"));
    const auto top = table.real("radius_top", TableReader::kNotNegative);
    const auto sides = static_cast<int>(table.integer("sides", kSides).value_or(12));
    const bool capped = table.boolean("capped").value_or(false);
    return table.failed()
               ? Triangles()
               : make_cylinder(*base, *axis, *radius, top.value_or(*radius), sides, capped);
}

Triangles read_disk(TableReader& table) {
    const auto center = table.required("center", table.vector("center"));
    const auto normal = read_axis(table, "normal");
    const auto radius = table.required("radius", read_length(table, "radius"));
    const auto sides = static_cast<int>(table.integer("sides", kSides).value_or(24));
    return table.failed() ? Triangles() : make_disk(*center, *normal, *radius, sides);
}

Triangles read_sphere(TableReader& table) {
    const auto center = table.required("center", table.vector("center"));
    const auto radius = table.required("radius", read_length(table, "radius"));
    const auto levels = static_cast<int>(table.integer("levels", kLevels).value_or(3));
    return table.failed() ? Triangles() : make_sphere(*center, *radius, levels);
}

/// The corners of a face of a mesh; empty after a fault.
std::optional<std::vector<Vec3>> read_face(
    TableReader& table, const Node& node, std::size_t index, const std::vector<Vec3>& vertices) {
    const auto* list = node.as<Node::List>();
    if (list == nullptr || list->size() < 3 || list->size() > kMaxCorners) {
        table.fault_at(
            node,
            fmt::format(
                "faces[{}] is not a list of 3 to {} indices of vertices", index, kMaxCorners));
        return std::nullopt;
    }
    std::vector<Vec3> corners;
    for (const Node& item : *list) {
        const auto* number = item.as<std::int64_t>();
        if (number == nullptr || *number < 0 ||
            static_cast<std::uint64_t>(*number) >= vertices.size()) {
            table.fault_at(
                item, fmt::format("faces[{}] refers to a vertex that does not exist", index),
                fmt::format(
                    "vertices are counted from 0 to {}",
                    static_cast<std::int64_t>(vertices.size()) - 1));
            return std::nullopt;
        }
        corners.push_back(vertices[static_cast<std::size_t>(*number)]);
    }
    return corners;
}

Triangles read_inline_mesh(TableReader& table) {
    const auto vertices = table.required("vertices", table.vectors("vertices"));
    const Node* faces = table.any("faces");
    const auto* list = faces ? faces->as<Node::List>() : nullptr;
    if (list == nullptr || list->empty()) {
        table.fault_at(
            "faces", "faces is missing or not a list",
            "it must be a list of faces, each a list of indices of vertices");
    }
    Triangles triangles;
    for (std::size_t i = 0; vertices && list && i < list->size() && !table.reporter().is_full();
         ++i) {
        if (const auto corners = read_face(table, (*list)[i], i, *vertices)) {
            const Triangles face = face_triangles(*corners);
            triangles.insert(triangles.end(), face.begin(), face.end());
        }
    }
    return table.failed() ? Triangles() : triangles;
}

/// One row of the table of shapes.
struct ShapeEntry {
    std::string_view name;
    Triangles (*read)(TableReader& table);
};

// To add a shape to the run file: a function as above that reads its keys, a row here, a row in
// docs/reference/run-file.md.
constexpr std::array kShapes{
    ShapeEntry{"triangle", read_triangle}, ShapeEntry{"parallelogram", read_parallelogram},
    ShapeEntry{"rhombus", read_rhombus},   ShapeEntry{"polygon", read_polygon},
    ShapeEntry{"bezier", read_bezier},     ShapeEntry{"cylinder", read_cylinder},
    ShapeEntry{"disk", read_disk},         ShapeEntry{"sphere", read_sphere},
    ShapeEntry{"mesh", read_inline_mesh},
};

}  // namespace

std::vector<std::string_view> shape_names() {
    return names_in(kShapes);
}

std::vector<Triangle> read_shape(TableReader& organ) {
    const auto name = organ.required("shape", organ.choice("shape", shape_names()));
    if (!name) {
        return {};
    }
    const auto entry = std::find_if(
        kShapes.begin(), kShapes.end(), [&](const ShapeEntry& e) { return e.name == *name; });
    try {
        return entry->read(organ);
    } catch (const InputError& error) {
        const Fault& first = error.faults().front();
        organ.fault(first.where + ": " + first.problem, first.why, first.suggestion);
        return {};
    }
}

}  // namespace quasimc
