#include <cmath>
#include <limits>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "scene/assembly.h"
#include "scene/scene.h"
#include "small_scenes.h"

namespace quasimc {
namespace {

using test::flat_triangle;
using test::one_band_builder;
using test::one_triangle;

/// A strip of flat triangles along x, all of one area: large enough to be kept as instances.
std::shared_ptr<const Mesh> strip(std::size_t triangles = kSmallestPrototype) {
    std::vector<Triangle> all;
    for (std::size_t i = 0; i < triangles; ++i) {
        all.push_back(flat_triangle({static_cast<double>(i), 0, 0}));
    }
    return std::make_shared<const Mesh>(all);
}

Affine moved(const Vec3& shift, double scale = 1) {
    return {{Vec3{scale, 0, 0}, Vec3{0, scale, 0}, Vec3{0, 0, scale}}, shift};
}

OrganSpec copy_of(const std::shared_ptr<const Mesh>& mesh, const Affine& transform) {
    OrganSpec organ;
    organ.parts.push_back({"leaf", {}, mesh, transform});
    return organ;
}

TEST(SceneInstances, KeepTheirMeshOnce) {
    SceneBuilder builder = one_band_builder();
    const auto mesh = strip();
    for (int i = 0; i < 5; ++i) {
        builder.add_organ(copy_of(mesh, moved({0, 0, 1.0 * i}, 1 + i)));
    }
    const Scene scene = std::move(builder).build();
    ASSERT_EQ(data_of(scene).triangles().instances().size(), 5U);
    EXPECT_TRUE(data_of(scene).triangles().mesh().empty());
    EXPECT_EQ(
        data_of(scene).triangles().instances()[4].mesh,
        data_of(scene).triangles().instances()[0].mesh);
    EXPECT_EQ(scene.triangle_count(), 5 * kSmallestPrototype);
    for (std::uint32_t i = 0; i < 5; ++i) {
        const Organ& organ = scene.organs()[i];
        EXPECT_EQ(organ.triangle_count, kSmallestPrototype);
        EXPECT_EQ(organ.first_triangle, i * kSmallestPrototype);
        EXPECT_DOUBLE_EQ(organ.area, kSmallestPrototype * 0.5 * (1 + i) * (1 + i));
        EXPECT_EQ(data_of(scene).region_of(organ.first_triangle + 3).value, organ.first_region);
        EXPECT_EQ(
            data_of(scene).triangles()[organ.first_triangle + 3],
            flat_triangle({3.0 * (1 + i), 0, 1.0 * i}, 1 + i));
    }
    EXPECT_EQ(scene.bounds().high.z, 4);
}

TEST(SceneInstances, FewOrSmallCopiesAreStoredAsTriangles) {
    for (const std::size_t size : {kSmallestPrototype - 1, kSmallestPrototype}) {
        const std::size_t copies = size < kSmallestPrototype ? 10 : kMinCopies - 1;
        SceneBuilder builder = one_band_builder();
        const auto mesh = strip(size);
        for (std::size_t i = 0; i < copies; ++i) {
            builder.add_organ(copy_of(mesh, moved({0, 0, static_cast<double>(i)})));
        }
        const Scene scene = std::move(builder).build();
        EXPECT_TRUE(data_of(scene).triangles().instances().empty());
        EXPECT_EQ(data_of(scene).triangles().mesh().size(), copies * size);
        EXPECT_EQ(data_of(scene).triangles()[size], flat_triangle({0, 0, 1}));
    }
}

TEST(SceneInstances, StandAfterTheTrianglesOfOtherOrgans) {
    SceneBuilder builder = one_band_builder();
    const auto mesh = strip();
    for (int i = 1; i < 4; ++i) {
        builder.add_organ(copy_of(mesh, moved({0, 0, 1.0 * i})));
    }
    builder.add_organ(one_triangle("leaf", flat_triangle({0, 0, 9})));
    builder.set_ground({.material = "soil"});
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(scene.organs()[3].first_triangle, 0U);
    EXPECT_EQ(scene.organs()[4].first_triangle, 1U);
    EXPECT_TRUE(scene.organs()[4].is_ground);
    EXPECT_EQ(scene.organs()[0].first_triangle, 3U);
    EXPECT_EQ(data_of(scene).region_of(0).value, scene.organs()[3].first_region);
}

TEST(SceneInstances, AnOrganMayHaveTrianglesOfItsOwnBeside) {
    SceneBuilder builder = one_band_builder();
    const auto mesh = strip();
    for (int i = 0; i < 3; ++i) {
        OrganSpec organ = copy_of(mesh, moved({0, 0, 1.0 * i}));
        organ.parts.push_back({"soil", {flat_triangle({0, 5, 1.0 * i})}});
        builder.add_organ(std::move(organ));
    }
    const Scene scene = std::move(builder).build();
    for (const Organ& organ : scene.organs()) {
        EXPECT_EQ(organ.triangle_count, kSmallestPrototype + 1);
        EXPECT_EQ(organ.region_count, 2U);
        const std::uint32_t last = organ.first_triangle + organ.triangle_count - 1;
        EXPECT_EQ(data_of(scene).triangles()[last][0].y, 5);
        EXPECT_EQ(data_of(scene).region_of(last).value, organ.first_region + 1);
        EXPECT_EQ(scene.regions()[organ.first_region + 1].area, 0.5);
    }
}

TEST(SceneInstances, TurnWithTheAxesOfTheFile) {
    const Orientation y_up(UpAxis::y, {0, 0, 1});
    SceneBuilder builder = one_band_builder(y_up);
    const auto mesh = strip();
    for (int i = 0; i < 3; ++i) {
        builder.add_organ(copy_of(mesh, moved({1, 2.0 * i, 3}, 2)));
    }
    const Scene scene = std::move(builder).build();
    ASSERT_EQ(data_of(scene).triangles().instances().size(), 3U);
    const Vec3 in_file{2 * 3.0 + 1, 2.0 * 2, 3};
    EXPECT_EQ(data_of(scene).triangles()[2 * kSmallestPrototype + 3][0], y_up.inward(in_file));
}

TEST(SceneInstances, ScaledCopiesHaveTheAreaOfTheirTriangles) {
    SceneBuilder builder = one_band_builder();
    const auto mesh = strip();
    for (int i = 0; i < 3; ++i) {
        builder.add_organ(
            copy_of(mesh, {{Vec3{2, 0, 0}, Vec3{0, 3, 0}, Vec3{0, 0, 1}}, Vec3{0, 0, 1.0 * i}}));
    }
    const Scene scene = std::move(builder).build();
    EXPECT_EQ(data_of(scene).triangles().instances().size(), 3U);
    EXPECT_DOUBLE_EQ(scene.organs()[1].area, 6 * 0.5 * kSmallestPrototype);
}

TEST(SceneInstances, FlatTransformsAreNotKept) {
    SceneBuilder builder = one_band_builder();
    const auto mesh = strip();
    const Affine flat{{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 0}}, {}};
    for (int i = 0; i < 3; ++i) {
        builder.add_organ(copy_of(mesh, flat));
    }
    EXPECT_TRUE(data_of(builder.build()).triangles().instances().empty());
}

TEST(SceneInstances, PositionsThatAreNoNumbersAreFaults) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), 2e30}) {
        SceneBuilder builder = one_band_builder();
        OrganSpec organ = copy_of(strip(), moved({0, bad, 0}));
        organ.name = "tree";
        builder.add_organ(std::move(organ));
        const auto faults = test::faults_of(std::move(builder));
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_NE(faults[0].find("organ 'tree'"), std::string::npos) << faults[0];
    }
}

TEST(SceneInstances, DegenerateTrianglesOfAMeshAreFoundInEachCopy) {
    SceneBuilder builder = one_band_builder();
    builder.set_length_unit("");  // each copy is 100 long
    Mesh mesh = *strip();
    mesh.push_back({Vec3{0, 9, 0}, Vec3{1, 9, 0}, Vec3{2, 9, 0}});
    const auto shared = std::make_shared<const Mesh>(mesh);
    for (int i = 0; i < 3; ++i) {
        builder.add_organ(copy_of(shared, moved({0, 0, 1.0 * i})));
    }
    EXPECT_EQ(test::warnings_of(std::move(builder)).size(), 3U);
}

}  // namespace
}  // namespace quasimc
