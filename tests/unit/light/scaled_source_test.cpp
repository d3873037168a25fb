#include <gtest/gtest.h>

#include "geometry/shapes/shapes.h"
#include "light/models/source.h"

namespace quasimc::test {
namespace {

std::shared_ptr<const Source> lamp() {
    LampSpec spec;
    spec.name = "lamp";
    spec.position = {0, 0, 2};
    spec.flux = {10, 4};
    return make_lamp(std::move(spec));
}

TEST(ScaledSource, IsTheSourceWithLessLight) {
    const auto whole = lamp();
    const auto half = make_dimmed(whole, .5);
    EXPECT_EQ(half->name(), "lamp");
    EXPECT_EQ(half->spectrum()[0], 5);
    EXPECT_EQ(half->spectrum()[1], 2);
    EXPECT_EQ(half->traits(), kLampTraits);
    EXPECT_EQ(
        model_of(*half).illuminate({1, 0, 0}, .1, .2).weight,
        model_of(*whole).illuminate({1, 0, 0}, .1, .2).weight);
    EXPECT_EQ(make_dimmed(whole, 1), whole);
    const auto sun = make_dimmed(make_directional_source("sun", {0, 0, -1}, {2}), 3);
    EXPECT_EQ(sun->spectrum()[0], 6);
    EXPECT_EQ(sun->traits(), kBeamTraits);
    EXPECT_EQ(sun->horizontal_irradiance(), 1);
    EXPECT_EQ(model_of(*sun).radiance({0, 0, 1}), 0);
}

TEST(ScaledSource, SendsNothingWhenOff) {
    const LocalMesh mesh =
        make_local_mesh(std::vector<Triangle>{{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}}});
    const SceneProjection projection(mesh, {}, StartArea::silhouette);
    EXPECT_NE(model_of(*make_dimmed(lamp(), .1)).make_sampler_in(projection), nullptr);
    EXPECT_EQ(model_of(*make_dimmed(lamp(), 0)).make_sampler_in(projection), nullptr);
}

}  // namespace
}  // namespace quasimc::test
