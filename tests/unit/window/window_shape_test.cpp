// The triangles of a scene as the page takes them.

#include "window/window_shape.h"

#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "scene/scene.h"

namespace quasimc::test {
namespace {

template <typename T>
std::vector<T> take(std::string& bytes, std::size_t count) {
    std::vector<T> values(count);
    EXPECT_GE(bytes.size(), count * sizeof(T));
    std::memcpy(values.data(), bytes.data(), count * sizeof(T));
    bytes.erase(0, count * sizeof(T));
    return values;
}

/// Rationale: corners that neighbours share are sent once. Expected behaviour: those of another
/// organ are never taken for its own; sizes and heights are exact.
TEST(WindowShape, SharesCornersWithinAnOrganAlone) {
    SceneBuilder builder({{"PAR"}, {"NIR"}});
    builder.add_material({"leaf", {{.1, .1}, {.4, .4}}, {{.1, .1}, {.4, .4}}});
    const Vec3 a{0, 0, 0}, b{2, 0, 0}, c{2, 1, 0}, d{0, 1, 0}, top{0, 0, 3};
    for (const std::vector<Triangle>& triangles :
         {std::vector<Triangle>{{a, b, c}, {a, c, d}}, std::vector<Triangle>{{d, a, top}}}) {
        OrganSpec leaf;
        leaf.parts.push_back({"leaf", triangles});
        builder.add_organ(std::move(leaf));
    }
    const Scene scene = std::move(builder).build();
    const Vec3 middle = window_middle(scene);
    EXPECT_EQ(middle, (Vec3{1, .5, 1.5}));
    std::string bytes = window_shape(scene);
    EXPECT_EQ(take<float>(bytes, 2), (std::vector<float>{2, 1.5}));  // areas
    EXPECT_EQ(take<float>(bytes, 2), (std::vector<float>{0, 1}));    // heights
    EXPECT_EQ(take<std::uint32_t>(bytes, 2), (std::vector<std::uint32_t>{2, 1}));
    std::vector<float> coordinates;
    for (const Vec3& p : {a, b, c, d, d, a, top}) {
        for (const double x : {p.x - middle.x, p.y - middle.y, p.z - middle.z}) {
            coordinates.push_back(static_cast<float>(x));
        }
    }
    EXPECT_EQ(take<float>(bytes, coordinates.size()), coordinates);
    EXPECT_EQ(bytes, std::string("\0\0\0\3\1\0\0\0\0", 9));
}

}  // namespace
}  // namespace quasimc::test
