#include "meshio/gltf_values.h"

#include <cmath>

#include <fmt/format.h>

#include "text/numbers.h"

namespace quasimc {
namespace {

std::optional<double> gltf_number(const Node& node) {
    if (const auto* whole = node.as<std::int64_t>()) {
        return static_cast<double>(*whole);
    }
    const auto* real = node.as<double>();
    return real != nullptr ? std::optional(*real) : std::nullopt;
}

std::optional<std::uint64_t> whole_of(const Node& node) {
    const std::optional<double> number = gltf_number(node);
    const auto whole = number ? whole_number(*number) : std::nullopt;
    return whole && *whole >= 0 ? std::optional(static_cast<std::uint64_t>(*whole)) : std::nullopt;
}

/// The rotation of a quaternion (x, y, z, w) of any length but 0.
std::array<Vec3, 3> rotation_rows(const std::vector<double>& q, const Vec3& scale) {
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    const double s = 2 / (x * x + y * y + z * z + w * w);
    return {
        Vec3{
            (1 - s * (y * y + z * z)) * scale.x, s * (x * y - z * w) * scale.y,
            s * (x * z + y * w) * scale.z},
        Vec3{
            s * (x * y + z * w) * scale.x, (1 - s * (x * x + z * z)) * scale.y,
            s * (y * z - x * w) * scale.z},
        Vec3{
            s * (x * z - y * w) * scale.x, s * (y * z + x * w) * scale.y,
            (1 - s * (x * x + y * y)) * scale.z}};
}

}  // namespace

std::optional<std::uint64_t> GltfValues::whole(
    const Node& object, std::string_view key, const std::string& where) {
    const Node* value = object.find(key);
    const auto number = value != nullptr ? whole_of(*value) : std::nullopt;
    if (value != nullptr && !number) {
        fault(fmt::format("{}: {} is not a whole number", where, key), "it must be 0 or more");
    }
    return number;
}

std::optional<std::size_t> GltfValues::index_of(
    const Node& value, std::string_view key, std::size_t count, const std::string& where) {
    const auto number = whole_of(value);
    if (!number || *number >= count) {
        fault(
            fmt::format("{}: {} refers to a missing item", where, key),
            fmt::format("there are {}, counted from 0", count));
        return std::nullopt;
    }
    return *number;
}

std::optional<std::size_t> GltfValues::index(
    const Node& object, std::string_view key, std::size_t count, const std::string& where) {
    const Node* value = object.find(key);
    return value != nullptr ? index_of(*value, key, count, where) : std::nullopt;
}

std::vector<std::size_t> GltfValues::indices(
    const Node& object, std::string_view key, std::size_t count, const std::string& where) {
    std::vector<std::size_t> all;
    for (const Node& value : gltf_list(object, key)) {
        if (const auto number = index_of(value, key, count, where)) {
            all.push_back(*number);
        }
    }
    return all;
}

std::optional<std::vector<double>> GltfValues::numbers(
    const Node& object, std::string_view key, std::size_t count, const std::string& where) {
    if (object.find(key) == nullptr) {
        return std::nullopt;
    }
    std::vector<double> all = gltf_numbers(object, key);
    if (all.size() != count || gltf_list(object, key).size() != count) {
        fault(fmt::format("{}: {} is not a list of {} finite numbers", where, key, count), "");
        return std::nullopt;
    }
    return all;
}

Affine GltfValues::matrix(const std::vector<double>& m, const std::string& where) {
    if (m[3] != 0 || m[7] != 0 || m[11] != 0 || m[15] != 1) {
        fault(
            where + ": its matrix is not composed of scale, rotation and translation", "",
            "apply it");
    }
    return {
        {Vec3{m[0], m[4], m[8]}, Vec3{m[1], m[5], m[9]}, Vec3{m[2], m[6], m[10]}},
        Vec3{m[12], m[13], m[14]}};
}

Affine GltfValues::transform(const Node& node, const std::string& where) {
    constexpr std::size_t kMatrix = 16, kQuaternion = 4;
    if (const auto m = numbers(node, "matrix", kMatrix, where)) {
        return matrix(*m, where);
    }
    Affine result;
    if (const auto shift = numbers(node, "translation", 3, where)) {
        result.shift = {(*shift)[0], (*shift)[1], (*shift)[2]};
    }
    const auto scale = numbers(node, "scale", 3, where).value_or(std::vector<double>(3, 1));
    const auto turn =
        numbers(node, "rotation", kQuaternion, where).value_or(std::vector<double>{0, 0, 0, 1});
    const double size =
        turn[0] * turn[0] + turn[1] * turn[1] + turn[2] * turn[2] + turn[3] * turn[3];
    if (!(size > 0) || !std::isfinite(2 / size)) {
        fault(where + ": its rotation is not a unit quaternion", "");
        return result;
    }
    result.rows = rotation_rows(turn, {scale[0], scale[1], scale[2]});
    return result;
}

std::vector<double> gltf_numbers(const Node& object, std::string_view key) {
    std::vector<double> all;
    for (const Node& value : gltf_list(object, key)) {
        const std::optional<double> number = gltf_number(value);
        if (number && std::isfinite(*number)) {
            all.push_back(*number);
        }
    }
    return all;
}

std::string gltf_text(const Node& object, std::string_view key) {
    const Node* value = object.find(key);
    const auto* text = value != nullptr ? value->as<std::string>() : nullptr;
    return text != nullptr ? *text : "";
}

const Node::List& gltf_list(const Node& object, std::string_view key) {
    static const Node::List kNone;
    const Node* value = object.find(key);
    const auto* list = value != nullptr ? value->as<Node::List>() : nullptr;
    return list != nullptr ? *list : kNone;
}

}  // namespace quasimc
