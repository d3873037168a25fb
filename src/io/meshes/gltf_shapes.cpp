#include "io/meshes/gltf_shapes.h"

#include <numeric>
#include <utility>

#include <fmt/format.h>

namespace quasimc {
namespace {

std::vector<std::uint32_t> numbers_below(std::size_t count) {
    std::vector<std::uint32_t> indices(count);
    std::iota(indices.begin(), indices.end(), 0U);
    return indices;
}

}  // namespace

std::optional<LocalTriangles> GltfShapes::triangles(const GltfPrimitive& primitive) {
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
            fmt::format("a part with {} corners", corners->size()), "triangles have three each");
        return std::nullopt;
    }
    return LocalTriangles{std::move(*points), faces_of(primitive.mode, *corners)};
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
