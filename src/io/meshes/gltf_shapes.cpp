#include "io/meshes/gltf_shapes.h"

#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace quasimc {
namespace {

/// The numbers of a primitive's vertices, corner after corner, as triangles.
std::vector<Face> gltf_faces(GltfMode mode, const std::vector<std::uint32_t>& corners) {
    std::vector<Face> faces;
    if (mode == GltfMode::triangles) {
        faces.reserve(corners.size() / 3);
        for (std::size_t i = 0; i + 2 < corners.size(); i += 3) {
            faces.push_back({corners[i], corners[i + 1], corners[i + 2]});
        }
        return faces;
    }
    for (std::size_t i = 0; i + 2 < corners.size(); ++i) {
        const std::size_t odd = i % 2;
        const Face face = mode == GltfMode::fan
                              ? Face{corners[0], corners[i + 1], corners[i + 2]}
                              : Face{corners[i], corners[i + 1 + odd], corners[i + 2 - odd]};
        // Strips go on over triangles that are lines.
        if (face[0] != face[1] && face[1] != face[2] && face[2] != face[0]) {
            faces.push_back(face);
        }
    }
    return faces;
}

std::vector<std::uint32_t> numbers_below(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
}

}  // namespace

std::optional<GltfTriangles> GltfShapes::triangles(const GltfPrimitive& primitive) {
    auto points = read_points(*primitive.positions);
    if (!points) {
        return std::nullopt;
    }
    auto corners = primitive.indices ? read_indices(*primitive.indices, points->size())
                                     : numbers_below(points->size());
    if (!corners) {
        return std::nullopt;
    }
    if (primitive.mode == GltfMode::triangles && corners->size() % 3 != 0) {
        values_.fault(
            fmt::format("a part with {} corners", corners->size()), "triangles have three each");
        return std::nullopt;
    }
    return GltfTriangles{std::move(*points), gltf_faces(primitive.mode, *corners)};
}

std::optional<std::vector<Vec3>> GltfShapes::read_points(std::size_t number) {
    constexpr std::size_t kAxes = 3;
    const std::optional<GltfAccessor> accessor = buffers_.accessor(number);
    if (!accessor) {
        return std::nullopt;
    }
    if (accessor->components != kAxes) {
        values_.fault(fmt::format("accessor {} is no list of points", number), "it needs VEC3");
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
    return points;
}

std::optional<std::vector<std::uint32_t>> GltfShapes::read_indices(
    std::size_t number, std::size_t count) {
    const std::optional<GltfAccessor> accessor = buffers_.accessor(number);
    if (!accessor) {
        return std::nullopt;
    }
    std::vector<std::uint32_t> indices;
    indices.reserve(accessor->count);
    for (std::size_t i = 0; i < accessor->count; ++i) {
        const double index = accessor->at(i, 0);
        if (!(index >= 0 && index < static_cast<double>(count))) {
            values_.fault(
                fmt::format("accessor {}: index {} names vertex {}", number, i, index),
                fmt::format("there are {}, counted from 0", count));
            return std::nullopt;
        }
        indices.push_back(static_cast<std::uint32_t>(index));
    }
    return indices;
}

}  // namespace quasimc
