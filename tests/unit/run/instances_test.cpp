#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "quasimc/run.h"
#include "scene/scene.h"
#include "statistical/scenes.h"
#include "support/random_leaves.h"
#include "support/statistics.h"

namespace quasimc::test {
namespace {

/// Twelve plants of 80 leaves each, turned, scaled and moved, over a ground.
/// @param shared  whether they share one mesh
Scene make_copied_stand(bool shared, const Cell& cell) {
    const auto plant = std::make_shared<const Mesh>(random_leaves(80, .3, 1, 5));
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("leaf", .3, .3));
    builder.add_material(diffuse("soil", .2, 0));
    for (int i = 0; i < 12; ++i) {
        const double size = .6 + .05 * i, angle = .7 * i;
        const double c = size * std::cos(angle), s = size * std::sin(angle);
        const Affine transform{
            {Vec3{c, s, 0}, Vec3{-s, c, 0}, Vec3{0, 0, size}}, {1.2 * (i % 4), 1.3 * (i / 4), .1}};
        OrganSpec organ;
        if (shared) {
            organ.parts.push_back({"leaf", {}, plant, transform});
        } else {
            std::vector<Triangle> triangles;
            for (std::size_t k = 0; k < plant->size(); ++k) {
                triangles.push_back(Instance{plant, transform}.triangle(k));
            }
            organ.parts.push_back({"leaf", triangles});
        }
        builder.add_organ(std::move(organ));
    }
    builder.set_ground({.material = "soil"});
    builder.set_cell(cell);
    return std::move(builder).build();
}

/// Every organ absorbs the same in both scenes, within the errors of both.
void expect_same_light(const Scene& one, const Scene& other, const RunSpec& spec) {
    const Sources sources{
        make_directional_source("sun", {.3, .2, -1}, {1}), make_uniform_sky("sky", {1})};
    const Result a = run(one, sources, spec);
    RunSpec again = spec;
    again.seed = spec.seed + 1;
    const Result b = run(other, sources, again);
    const double level = sidak_level(kLevel, static_cast<unsigned>(one.organs().size()));
    for (std::size_t i = 0; i < one.organs().size(); ++i) {
        const Estimate x = a.at(i, Quantity::absorbed_flux_density, 0);
        const Estimate y = b.at(i, Quantity::absorbed_flux_density, 0);
        EXPECT_NEAR(one.organs()[i].area, other.organs()[i].area, 1e-12);
        EXPECT_TRUE(agrees(measured(x, spec.replicates), measured(y, spec.replicates), .06, level))
            << "organ " << i;
    }
}

class SharedMeshes : public ::testing::TestWithParam<Method> {
  protected:
    static RunSpec spec() {
        RunSpec spec;
        spec.method = GetParam();
        spec.paths = 1U << 14U;
        spec.replicates = kReplicates;
        return spec;
    }
};

TEST_P(SharedMeshes, TakeTheLightOfTheirTriangles) {
    const Scene shared = make_copied_stand(true, {});
    ASSERT_EQ(data_of(shared).triangles().instances().size(), 12U);
    expect_same_light(shared, make_copied_stand(false, {}), spec());
}

TEST_P(SharedMeshes, TakeTheLightOfTheirTrianglesInAPeriodicScene) {
    const Cell cell{true, true, -.3, -.3, 4.4, 3.7};
    expect_same_light(make_copied_stand(true, cell), make_copied_stand(false, cell), spec());
}

INSTANTIATE_TEST_SUITE_P(
    Ways,
    SharedMeshes,
    ::testing::Values(Method::light_tracing, Method::from_organs, Method::first_hits),
    name_of);

}  // namespace
}  // namespace quasimc::test
