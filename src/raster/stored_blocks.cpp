#include "raster/stored_blocks.h"

#include <algorithm>

namespace quasimc {
namespace {

/// 36 bytes each; for more triangles the memory is not worthwhile.
constexpr std::uint32_t kMaxTriangles = 1U << 17U;
constexpr std::size_t kNumbers = std::size_t{3} * 3 * kBlockLanes;

TriangleBlock from_mesh(const ProjectedScene& scene, std::uint32_t first) {
    TriangleBlock block{};
    for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
        const std::uint32_t i = first + lane;
        if (i < scene.mesh->triangle_count() && scene.role(i) == VisibilityRole::opaque) {
            block.set(lane, *scene.mesh, i);
        }
    }
    return block;
}

}  // namespace

std::vector<StoredBlock> stored_blocks(const ProjectedScene& scene) {
    const std::uint32_t triangles = scene.mesh->triangle_count();
    std::vector<StoredBlock> blocks;
    if (triangles > kMaxTriangles || scene.mesh->instance_triangles > 0) {
        return blocks;
    }
    blocks.reserve(triangles / kBlockLanes + 1);
    for (std::uint32_t first = 0; first < triangles; first += kBlockLanes) {
        const TriangleBlock block = from_mesh(scene, first);
        const double* numbers = &block.at[0][0][0];
        StoredBlock& stored = blocks.emplace_back();
        std::transform(numbers, numbers + kNumbers, &stored.at[0][0][0], [](double x) {
            return static_cast<float>(x);
        });
    }
    return blocks;
}

TriangleBlock block_of(const ProjectedScene& scene, std::uint32_t first) {
    if (scene.blocks.empty()) {
        return from_mesh(scene, first);
    }
    TriangleBlock block;
    std::copy_n(&scene.blocks[first / kBlockLanes].at[0][0][0], kNumbers, &block.at[0][0][0]);
    return block;
}

}  // namespace quasimc
