#include "meshio/gltf_shapes.h"

#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "meshio/float_steps.h"

namespace quasimc {
namespace {

std::vector<std::uint32_t> numbers_below(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
}

/// Makes the triangles of corners in an order; omits degenerate ones of strips and fans.
std::vector<Face> faces_of(CornerOrder order, const std::vector<std::uint32_t>& corners) {
    std::vector<Face> faces;
    if (order == CornerOrder::triangles) {
        faces.reserve(corners.size() / 3);
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
        }
        return faces;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        const Face face = order == CornerOrder::fan
                              ? Face{corners[0], corners[i + 1], corners[i + 2]}
                              : Face{corners[i], corners[i + 1 + odd], corners[i + 2 - odd]};
        // Strips continue after degenerate triangles.
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
            faces.push_back(face);
        }
    }
    return faces;
}

}  // namespace

std::optional<Mesh> GltfShapes::triangles(const GltfPrimitive& primitive) {
    auto points = read_points(*primitive.positions);
    if (!points) {
        return std::nullopt;
    }
    auto corners = primitive.indices ? read_indices(*primitive.indices, points->size())
                                     : numbers_below(points->size());
    if (!corners) {
        return std::nullopt;
    }
    if (primitive.mode == CornerOrder::triangles && corners->size() % 3 != 0) {
        values_.fault(
            fmt::format("a primitive with {} vertices", corners->size()),
            "it must be a multiple of 3");
        return std::nullopt;
    }
    Mesh triangles{std::move(*points), faces_of(primitive.mode, *corners)};
    const std::span<const Face> faces(triangles.faces);
    const std::string steps = describe_float_steps(triangles.vertices, {&faces, 1});
    if (!steps.empty() && ++coarse_.count == 1) {
        coarse_.first = steps;
    }
    return triangles;
}

void GltfShapes::finish() {
    if (other_bounds_.count > 0) {
        reporter_.warn(fmt::format(
            "points are outside the min and max of their accessor ({} accessors, the first is {}): "
            "a type or an offset may be wrong, or the file is damaged",
            other_bounds_.count, other_bounds_.first));
    }
    if (coarse_.count > 0) {
        reporter_.warn(
            coarse_.count == 1
                ? coarse_.first
                : fmt::format("{} (the first of {} meshes)", coarse_.first, coarse_.count));
    }
}

std::optional<std::vector<Vec3>> GltfShapes::read_points(std::size_t number) {
    constexpr std::size_t kAxes = 3;
    const std::optional<GltfAccessor> accessor = buffers_.accessor(number);
    if (!accessor) {
        return std::nullopt;
    }
    constexpr std::uint32_t kUint32 = 5125;
    if (accessor->components != kAxes || accessor->component_type == kUint32) {
        values_.fault(
            fmt::format("accessor {} is not a list of points", number),
            "it must be VEC3 of float, or of quantized 8 or 16 bits");
        return std::nullopt;
    }
    std::vector<Vec3> points;
    points.reserve(accessor->count);
    for (std::size_t i = 0; i < accessor->count; ++i) {
        points.push_back({accessor->at(i, 0), accessor->at(i, 1), accessor->at(i, 2)});
        if (!is_finite(points.back())) {
            values_.fault(fmt::format("accessor {}: point {} is not finite", number, i), "");
            return std::nullopt;
        }
    }
    check_bounds(number, *accessor, points);
    return points;
}

/// Compares the points with the bounds in the file. Differences mean a wrong type, offset or bytes.
void GltfShapes::check_bounds(
    std::size_t number, const GltfAccessor& accessor, const std::vector<Vec3>& points) {
    constexpr double kTolerance = 1e-3, kRounding = 1e-6;
    constexpr std::size_t kAxes = 3;
    if (accessor.is_normalized || accessor.low.size() != kAxes || accessor.high.size() != kAxes) {
        return;
    }
    Bounds bounds;
    for (const Vec3& point : points) {
        bounds.add(point);
    }
    const auto point_of = [](const std::vector<double>& v) { return Vec3{v[0], v[1], v[2]}; };
    const Vec3 low = point_of(accessor.low), high = point_of(accessor.high);
    // Bounds may be rounded to single precision.
    const double tolerance = kTolerance * (length(high - low) + length(bounds.size())) +
                             kRounding * (length(low) + length(high));
    const bool is_other =
        length(bounds.low - low) > tolerance || length(bounds.high - high) > tolerance;
    if (!points.empty() && is_other && ++other_bounds_.count == 1) {
        other_bounds_.first = fmt::format("accessor {}", number);
    }
}

std::optional<std::vector<std::uint32_t>> GltfShapes::read_indices(
    std::size_t number, std::size_t count) {
    const std::optional<GltfAccessor> accessor = buffers_.accessor(number);
    if (!accessor) {
        return std::nullopt;
    }
    if (accessor->components != 1 || !accessor->is_whole()) {
        values_.fault(
            fmt::format("accessor {} is not a list of indices", number),
            "it must be SCALAR of integers");
        return std::nullopt;
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(accessor->count);
    for (std::size_t i = 0; i < accessor->count; ++i) {
        const double index = accessor->at(i, 0);
        if (!(index >= 0 && index < static_cast<double>(count))) {
            values_.fault(
                fmt::format("accessor {}: index {} refers to vertex {}", number, i, index),
                fmt::format("there are {}, counted from 0", count));
            return std::nullopt;
        }
        indices.push_back(static_cast<std::uint32_t>(index));
    }
    return indices;
}

}  // namespace quasimc
