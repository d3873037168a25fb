#include "io/meshes/dae_transform.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/meshes/file_axes.h"
#include "io/numbers.h"

namespace quasimc {
namespace {

Affine matrix_of(const std::vector<double>& m) {
    return {
        {Vec3{m[0], m[1], m[2]}, Vec3{m[4], m[5], m[6]}, Vec3{m[8], m[9], m[10]}},
        Vec3{m[3], m[7], m[11]}};
}

/// Where a camera stands, what it looks at, and which way is up: it looks along -z.
std::optional<Affine> look_of(const std::vector<double>& v) {
    const Vec3 eye{v[0], v[1], v[2]};
    const Vec3 back = eye - Vec3{v[3], v[4], v[5]};
    const Vec3 right = cross({v[6], v[7], v[8]}, back);
    if (!(length(right) > 0) || !is_finite(right)) {
        return std::nullopt;
    }
    const Vec3 z = back / length(back), x = right / length(right), y = cross(z, x);
    return Affine{{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}, eye};
}

/// What a transform of a node does; nothing after a fault. @param name  that of the element
std::optional<Affine> one_transform(
    std::size_t element, std::string_view name, DaeLibrary& library) {
    constexpr std::size_t kAxes = 3, kTurn = 4, kLook = 9, kMatrix = 16;
    const std::size_t count = name == "matrix"   ? kMatrix
                              : name == "rotate" ? kTurn
                              : name == "lookat" ? kLook
                                                 : kAxes;
    const auto values = library.numbers(element, count);
    if (!values) {
        return std::nullopt;
    }
    const Vec3 xyz{(*values)[0], (*values)[1], (*values)[2]};
    if (name == "translate") {
        return Affine{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}, xyz};
    }
    if (name == "scale") {
        return Affine{{Vec3{xyz.x, 0, 0}, Vec3{0, xyz.y, 0}, Vec3{0, 0, xyz.z}}, {}};
    }
    const std::optional<Affine> transform = name == "matrix"   ? std::optional(matrix_of(*values))
                                            : name == "rotate" ? rotation_about(xyz, (*values)[3])
                                                               : look_of(*values);
    if (!transform) {
        library.fault(element, fmt::format("<{}> has no direction", name));
    }
    return transform;
}

}  // namespace

std::optional<Affine> dae_transform(const XmlTree& tree, std::size_t node, DaeLibrary& library) {
    Affine all;
    for (const std::size_t child : tree[node].children) {
        const std::string_view name = tree[child].name;
        if (name == "skew") {
            library.fault(
                child, "<skew> is not read", "", "apply the transforms, or export a <matrix>");
            return std::nullopt;
        }
        if (name != "matrix" && name != "translate" && name != "rotate" && name != "scale" &&
            name != "lookat") {
            continue;
        }
        const std::optional<Affine> one = one_transform(child, name, library);
        if (!one) {
            return std::nullopt;
        }
        all = after(all, *one);
    }
    return all;
}

Affine dae_axes(const XmlTree& tree, DaeLibrary& library, FormatContext& context) {
    const auto asset = tree.child(0, "asset");
    const auto unit = asset ? tree.child(*asset, "unit") : std::nullopt;
    const auto up = asset ? tree.child(*asset, "up_axis") : std::nullopt;
    double metres = 1;
    if (unit && !tree[*unit].attribute("meter").empty()) {
        metres = parse_real(trimmed(tree[*unit].attribute("meter"))).value_or(0);
        if (!(metres > 0) || !std::isfinite(metres)) {
            library.fault(*unit, "the meter of <unit> is no positive number");
            metres = 1;
        }
    }
    const Affine from_y = from_y_up(context.up, metres * context.units_per_metre());
    const std::size_t at = up.value_or(0);
    const std::string_view word = up ? trimmed(tree[at].text) : "Y_UP";
    if (word == "Z_UP") {
        return after(from_y, to_y_up(UpAxis::z, 1));
    }
    if (word == "X_UP") {  // its right is -y, and in is z
        return after(from_y, {{Vec3{0, -1, 0}, Vec3{1, 0, 0}, Vec3{0, 0, 1}}, {}});
    }
    if (word != "Y_UP") {
        library.fault(at, fmt::format("<up_axis> is {}", shown(word)), "it is X_UP, Y_UP or Z_UP");
    }
    return from_y;
}

}  // namespace quasimc
