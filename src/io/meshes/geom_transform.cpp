#include "io/meshes/geom_transform.h"

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/meshes/file_axes.h"

namespace quasimc {
namespace {

/// <x,y,z> or the name of an axis; nothing after a fault.
std::optional<Vec3> geom_vector(
    const GeomObject& object, std::string_view name, Reporter& reporter) {
    const GeomField* field = object.find(name);
    if (field != nullptr) {
        const auto* rows = std::get_if<GeomRows>(&field->value);
        if (rows != nullptr && rows->numbers.size() == 3) {
            return Vec3{rows->numbers[0], rows->numbers[1], rows->numbers[2]};
        }
        const auto* word = std::get_if<std::string_view>(&field->value);
        if (word != nullptr && (*word == "OX" || *word == "OY" || *word == "OZ")) {
            return Vec3{
                *word == "OX" ? 1.0 : 0.0, *word == "OY" ? 1.0 : 0.0, *word == "OZ" ? 1.0 : 0.0};
        }
    }
    reporter.fault(
        field == nullptr ? object.line : field->line,
        fmt::format("the {} of {} is no vector", name, object.type), "it is <x,y,z>");
    return std::nullopt;
}

/// 0 if it is absent, or after a fault.
double geom_angle(const GeomObject& object, std::string_view name, Reporter& reporter) {
    const GeomField* field = object.find(name);
    if (field == nullptr) {
        return 0;
    }
    const auto* number = std::get_if<double>(&field->value);
    if (number == nullptr) {
        reporter.fault(
            field->line, fmt::format("the {} of {} is no number", name, object.type), "");
    }
    return number == nullptr ? 0 : *number;
}

std::optional<Affine> translation_of(const GeomObject& object, Reporter& reporter) {
    const auto shift = geom_vector(object, "Translation", reporter);
    return shift ? std::optional(Affine{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, *shift})
                 : std::nullopt;
}

std::optional<Affine> scaling_of(const GeomObject& object, Reporter& reporter) {
    const auto s = geom_vector(object, "Scale", reporter);
    return s ? std::optional(Affine{{Vec3{s->x, 0, 0}, Vec3{0, s->y, 0}, Vec3{0, 0, s->z}}, {}})
             : std::nullopt;
}

std::optional<Affine> axis_rotation_of(const GeomObject& object, Reporter& reporter) {
    const auto axis = geom_vector(object, "Axis", reporter);
    const auto rotation =
        axis ? rotation_about(*axis, geom_angle(object, "Angle", reporter)) : std::nullopt;
    if (axis && !rotation) {
        reporter.fault(object.line, "the Axis is no direction", "");
    }
    return rotation;
}

/// The first two axes as they are stated, the third one perpendicular to both.
std::optional<Affine> orientation_of(const GeomObject& object, Reporter& reporter) {
    const auto a = geom_vector(object, "Primary", reporter);
    const auto b = geom_vector(object, "Secondary", reporter);
    if (!a || !b) {
        return std::nullopt;
    }
    const Vec3 normal = cross(*a, *b);
    if (!(length(normal) > 0) || !is_finite(normal)) {
        reporter.fault(object.line, "Primary and Secondary are no two directions", "");
        return std::nullopt;
    }
    const Vec3 x = normalized(*a), y = normalized(*b), z = normalized(normal);
    return Affine{{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, {}};
}

}  // namespace

std::optional<Affine> geom_transform(const GeomObject& object, Reporter& reporter) {
    const std::string_view type = object.type;
    if (type == "Translated") {
        return translation_of(object, reporter);
    }
    if (type == "Scaled") {
        return scaling_of(object, reporter);
    }
    if (type == "AxisRotated") {
        return axis_rotation_of(object, reporter);
    }
    if (type == "EulerRotated") {
        return euler_rotation(
            geom_angle(object, "Azimuth", reporter), geom_angle(object, "Elevation", reporter),
            geom_angle(object, "Roll", reporter));
    }
    if (type == "Oriented") {
        return orientation_of(object, reporter);
    }
    reporter.fault(
        object.line, fmt::format("{} is not read", shown(type)),
        "only TriangleSet, QuadSet and FaceSet are, moved and grouped",
        "let PlantGL write triangles: scene.save(\"all.obj\")");
    return std::nullopt;
}

}  // namespace quasimc
