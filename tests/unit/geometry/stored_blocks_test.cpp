#include "raster/stored_blocks.h"

#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/mesh/local_mesh.h"
#include "support/random_leaves.h"
#include "support/vector_units.h"

namespace quasimc {
namespace {

/// Not a multiple of the lanes; one of them has no area.
constexpr std::size_t kTriangles = 45, kFlat = 9;

LocalMesh some_triangles() {
    std::vector<Triangle> triangles = test::random_leaves(kTriangles, .3, 1, 3);
    triangles[kFlat][2] = triangles[kFlat][1];
    return make_local_mesh(triangles);
}

/// Of each three one hides nothing.
std::vector<VisibilityRole> some_roles() {
    std::vector<VisibilityRole> roles(kTriangles, VisibilityRole::opaque);
    for (std::size_t i = 0; i < kTriangles; i += 3) {
        roles[i] = VisibilityRole::sensor;
    }
    return roles;
}

TEST(StoredBlocks, AreThoseOfTheMesh) {
    const LocalMesh mesh = some_triangles();
    const std::vector<VisibilityRole> roles = some_roles();
    ProjectedScene scene{.mesh = &mesh, .cell = {}, .roles = roles};
    const std::vector<StoredBlock> blocks = stored_blocks(scene);
    ASSERT_EQ(blocks.size(), (kTriangles + kBlockLanes - 1) / kBlockLanes);
    for (std::uint32_t first = 0; first < kTriangles; first += kBlockLanes) {
        scene.blocks = {};
        const TriangleBlock of_mesh = block_of(scene, first);
        scene.blocks = blocks;
        const TriangleBlock stored = block_of(scene, first);
        EXPECT_EQ(std::memcmp(&of_mesh, &stored, sizeof stored), 0) << first;
        for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
            const std::uint32_t i = first + lane;
            const bool hides = i < kTriangles && i % 3 != 0;
            const Vec3 corner = hides ? mesh.vertex(i, 1) : Vec3{};
            EXPECT_EQ(stored.at[1][0][lane], corner.x) << i;
            EXPECT_EQ(stored.at[1][1][lane], corner.y) << i;
            EXPECT_EQ(stored.at[1][2][lane], corner.z) << i;
        }
    }
}

TEST(TriangleBlock, HasTheCosinesOfItsTrianglesOnEveryVectorUnit) {
    const LocalMesh mesh = some_triangles();
    const ProjectedScene scene{.mesh = &mesh, .cell = {}};
    const Vec3 direction = normalized(Vec3{.3, -.4, -.8});
    for_each_vector_unit([&] {
        for (std::uint32_t first = 0; first < kTriangles; first += kBlockLanes) {
            double cosines[kBlockLanes];
            best_span_loops().cosines(block_of(scene, first), direction, cosines);
            for (std::uint32_t lane = 0; lane < kBlockLanes; ++lane) {
                const std::uint32_t i = first + lane;
                EXPECT_EQ(cosines[lane], i < kTriangles ? scene.cosine(i, direction) : 0) << i;
            }
        }
    });
    EXPECT_EQ(scene.cosine(kFlat, direction), 0);
}

}  // namespace
}  // namespace quasimc
