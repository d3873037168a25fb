#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "base/text.h"
#include "runfile/copies.h"
#include "runfile/run_file_sections.h"

namespace quasimc {
namespace {

constexpr Range kAnyId{-9.2e18, 9.2e18};

/// The horizontal axes of the file, in the order of the world's x and y (see Orientation).
std::array<std::string_view, 2> horizontal_axes(const Orientation& orientation) {
    return orientation.up() == UpAxis::z ? std::array<std::string_view, 2>{"x", "y"}
                                         : std::array<std::string_view, 2>{"z", "x"};
}

/// Reads a pair [low, high] with low < high.
std::optional<Range> read_horizontal_range(TableReader& table, std::string_view key) {
    const Node* node = table.any(key);
    return node ? table.interval_at(key, *node, TableReader::kFinite) : std::nullopt;
}

std::array<Vec3, 3> read_rotation(const Node& node, TableReader& parent) {
    TableReader table(node, parent.what() + ": rotate", parent.reporter());
    const auto axis = table.required("axis", table.vector("axis"));
    const auto degrees = table.required("angle_deg", table.real("angle_deg"));
    table.finish();
    if (!axis || !degrees) {
        return Affine{}.rows;
    }
    const double size = std::max({std::abs(axis->x), std::abs(axis->y), std::abs(axis->z)});
    if (size == 0) {
        table.fault_at("axis", "axis is [0, 0, 0]", "it has no direction");
        return Affine{}.rows;
    }
    return rotation(normalized(*axis / size), *degrees * std::numbers::pi / 180);
}

/// Adds an organ for each copy, all with the same triangles.
void add_copies(
    TableReader& table,
    const OrganSpec& organ,
    const std::vector<Copy>& copies,
    std::vector<Triangle> triangles,
    SceneBuilder& builder) {
    CopyTexts texts(table, copies);
    const std::vector<Labels> labels = texts.labels(organ.labels);
    const std::vector<std::string> names = texts.names(organ.name, "");
    if (table.failed()) {
        triangles = {kSubstitute};
    }
    const auto shared = std::make_shared<const Mesh>(triangles);
    for (std::size_t i = 0; i < copies.size(); ++i) {
        OrganSpec copy = organ;
        copy.id = organ.id ? std::optional(*organ.id + static_cast<std::int64_t>(i)) : std::nullopt;
        copy.name = i < names.size() ? names[i] : "";
        copy.labels = labels[i];
        copy.parts.front().shared = shared;
        copy.parts.front().transform = copies[i].transform;
        builder.add_organ(std::move(copy));
    }
}

void read_organ(const Node& node, RunFileContext& context, SceneBuilder& builder) {
    TableReader table(node, "organ", *context.reporter);
    OrganSpec organ;
    organ.where = table.where();
    organ.id = table.integer("id", kAnyId);
    organ.name = table.text("name").value_or("");
    if (!organ.name.empty() || organ.id) {
        table.rename(
            fmt::format("organ '{}'", organ.name.empty() ? std::to_string(*organ.id) : organ.name));
    }
    organ.labels = read_labels(table);
    organ.measured = table.boolean("measured").value_or(true);
    organ.field_of_view_deg =
        table.real("field_of_view_deg", {0, 90}).value_or(organ.field_of_view_deg);
    const auto material = table.required("material", table.text("material"));
    std::vector<Triangle> triangles = read_shape(table);
    if (const auto transform = read_transform(table)) {
        move_triangles(*transform, triangles);
    }
    const auto copies = read_copies(
        table, organ.name.empty() ? table.text("shape").value_or("") : organ.name, context);
    table.finish();
    if (!material) {
        return;
    }
    organ.parts.push_back({*material, {}});
    if (copies) {
        add_copies(table, organ, *copies, std::move(triangles), builder);
        return;
    }
    organ.parts.front().triangles =
        table.failed() ? std::vector{kSubstitute} : std::move(triangles);
    builder.add_organ(std::move(organ));
}

/// The rectangle of a ground, horizontal axes of the world; empty if it is absent.
std::optional<std::array<double, 4>> read_extent(
    TableReader& table, const Orientation& orientation) {
    const auto [x, y] = horizontal_axes(orientation);
    const auto along_x = read_horizontal_range(table, x);
    const auto along_y = read_horizontal_range(table, y);
    if ((table.any(x) == nullptr) != (table.any(y) == nullptr)) {
        table.fault(
            fmt::format("{} is missing", table.any(x) ? y : x), "a rectangle has two sides");
    }
    if (!along_x || !along_y) {
        return std::nullopt;
    }
    return std::array{along_x->low, along_y->low, along_x->high, along_y->high};
}

}  // namespace

/// Rodrigues' formula.
std::array<Vec3, 3> rotation(const Vec3& k, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const double d = 1 - c;
    return {
        Vec3{c + d * k.x * k.x, d * k.x * k.y - s * k.z, d * k.x * k.z + s * k.y},
        Vec3{d * k.y * k.x + s * k.z, c + d * k.y * k.y, d * k.y * k.z - s * k.x},
        Vec3{d * k.z * k.x - s * k.y, d * k.z * k.y + s * k.x, c + d * k.z * k.z}};
}

Labels read_labels(TableReader& table) {
    Labels labels;
    const Node* node = table.any("labels");
    if (node == nullptr) {
        return labels;
    }
    const auto* members = node->as<Node::Table>();
    if (members == nullptr) {
        table.fault_at(
            *node, fmt::format("labels is {}", node->type_name()),
            "it must be a table like { plant = \"3\", kind = \"leaf\" }");
        return labels;
    }
    for (const auto& [key, line, value] : *members) {
        if (const auto* text = value.as<std::string>()) {
            labels.emplace_back(key, *text);
        } else if (const auto* number = value.as<std::int64_t>()) {
            labels.emplace_back(key, std::to_string(*number));
        } else {
            table.fault_at(
                value, fmt::format("label {} is {}", key, value.type_name()),
                "it must be a text or an integer");
        }
    }
    return labels;
}

std::optional<Affine> read_transform(TableReader& table) {
    const Node* node = table.any("transform");
    if (node == nullptr) {
        return std::nullopt;
    }
    TableReader parts(*node, table.what() + ": transform", table.reporter());
    const double scale = parts.real("scale").value_or(1);
    if (scale <= 0) {
        parts.fault_at("scale", fmt::format("scale is {}", scale), "it must be more than 0");
    }
    const Node* rotate = parts.any("rotate");
    Affine affine;
    affine.rows = rotate ? read_rotation(*rotate, parts) : affine.rows;
    for (Vec3& row : affine.rows) {
        row *= scale;
    }
    affine.shift = parts.vector("translate").value_or(Vec3{});
    parts.finish();
    return affine;
}

void move_triangles(const Affine& transform, std::vector<Triangle>& triangles) {
    for (Triangle& triangle : triangles) {
        for (Vec3& corner : triangle) {
            corner = transform.point(corner);
        }
    }
}

void move_points(const Affine& transform, std::vector<Vec3>& points) {
    for (Vec3& p : points) {
        p = transform.point(p);
    }
}

void read_organs(TableReader& top, RunFileContext& context, SceneBuilder& builder) {
    for (const Node* node : top.tables("organ")) {
        read_organ(*node, context, builder);
    }
}

namespace {

/// Reads all triangles of the file that a table names; empty after a fault.
Mesh read_surface(TableReader& table, RunFileContext& context) {
    Mesh surface;
    const std::optional<Affine> transform = read_transform(table);
    std::optional<NamedMesh> named = read_named_mesh(table, context);
    if (!named) {
        return surface;
    }
    for (Mesh& mesh : named->mesh.take_meshes()) {
        surface.append(mesh);
    }
    if (transform) {
        move_points(*transform, surface.vertices);
    }
    return surface;
}

}  // namespace

std::optional<GroundSpec> read_ground(TableReader& top, RunFileContext& context) {
    const Node* node = top.any("ground");
    if (node == nullptr) {
        return std::nullopt;
    }
    TableReader table(*node, "ground", *context.reporter);
    GroundSpec ground;
    ground.where = table.where();
    ground.name = table.text("name").value_or(ground.name);
    ground.material = table.required("material", table.text("material")).value_or("");
    ground.measured = table.boolean("measured").value_or(true);
    if (table.any("file") != nullptr) {
        ground.triangles = read_surface(table, context);
    } else {
        ground.height = table.real("height").value_or(0);
        ground.extent = read_extent(table, context.orientation);
    }
    table.finish();
    return table.failed() ? std::nullopt : std::optional(std::move(ground));
}

void read_cell(TableReader& top, const RunFileContext& context, SceneBuilder& builder) {
    const Node* node = top.any("cell");
    if (node == nullptr) {
        return;
    }
    TableReader table(*node, "cell", *context.reporter);
    const auto [x, y] = horizontal_axes(context.orientation);
    auto along_x = read_horizontal_range(table, x);
    auto along_y = read_horizontal_range(table, y);
    if (const auto pattern = read_pattern_file(table, context)) {
        if (along_x || along_y) {
            table.fault("both a file and ranges are given", "", "use one of them");
        }
        along_x = Range{(*pattern)[0], (*pattern)[2]};
        along_y = Range{(*pattern)[1], (*pattern)[3]};
    }
    if (!along_x && !along_y && !table.failed()) {
        table.fault(
            "it is not periodic along any axis", "",
            fmt::format("give {0} = [low, high], {1} = [low, high] or both", x, y));
    }
    table.finish();
    if (table.failed()) {
        return;
    }
    Cell cell;
    if (along_x) {
        cell.along_x = true;
        cell.low_x = along_x->low;
        cell.size_x = along_x->high - along_x->low;
    }
    if (along_y) {
        cell.along_y = true;
        cell.low_y = along_y->low;
        cell.size_y = along_y->high - along_y->low;
    }
    builder.set_cell(cell);
}

}  // namespace quasimc
