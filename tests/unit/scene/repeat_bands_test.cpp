#include "scene/repeat_bands.h"

#include <vector>

#include <gtest/gtest.h>

#include "optics/material.h"
#include "scene/scene.h"

namespace quasimc::test {
namespace {

Scene two_bands() {
    SceneBuilder builder({{"a"}, {"b"}});
    builder.add_material({"leaf", {{.1, .2}, {.3, 0}}, {{.4, .1}, {0, .5}}});
    builder.add_organ(
        {.parts = {{.material = "leaf", .triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}}}});
    builder.add_detector({.type = "escaped_by_zenith", .name = "zenith"});
    return std::move(builder).build();
}

TEST(RepeatBands, GivesTheSameSurfacesInMoreBands) {
    const Scene scene = two_bands();
    const Scene repeated = with_repeated_bands(scene, 3);
    EXPECT_EQ(repeated.bands().size(), 6U);
    EXPECT_EQ(data_of(repeated).geometry, data_of(scene).geometry);
    EXPECT_TRUE(repeated.detectors().empty());
    EXPECT_EQ(repeated.bands()[repeated_band(1, 2, 3)].name, "b 2");
    ASSERT_EQ(data_of(repeated).materials.size(), data_of(scene).materials.size());
    for (std::size_t m = 0; m < data_of(scene).materials.size(); ++m) {
        for (const SurfaceSide side : kSurfaceSides) {
            const Side& own = data_of(scene).materials[m].side(side);
            const Side& more = data_of(repeated).materials[m].side(side);
            ASSERT_EQ(more.lobes().size(), own.lobes().size());
            for (std::size_t b = 0; b < 6; ++b) {
                EXPECT_EQ(more.albedo()[b], own.albedo()[b / 3]);
                for (std::size_t i = 0; i < own.lobes().size(); ++i) {
                    EXPECT_EQ(more.lobes()[i].albedo[b], own.lobes()[i].albedo[b / 3]);
                }
            }
        }
    }
}

TEST(RepeatBands, OfOnceIsTheSceneItself) {
    const Scene scene = two_bands();
    const Scene once = with_repeated_bands(scene, 1);
    EXPECT_EQ(once.bands().size(), 2U);
    EXPECT_NE(once.bands()[0].name, once.bands()[1].name);
}

}  // namespace
}  // namespace quasimc::test
