#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "geometry/shapes/shapes.h"
#include "geometry_testing.h"
#include "quasimc/mesh.h"

namespace quasimc {

namespace {

using test::Random;

/// A patch over the unit square, with random heights and slightly random positions.
BezierPatch random_patch(Random& random, double height) {
    BezierPatch patch;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            patch[4 * i + j] = Vec3{static_cast<double>(i) / 3, static_cast<double>(j) / 3, 0} +
                               Vec3{
                                   random.between(-0.1, 0.1), random.between(-0.1, 0.1),
                                   height * random.between(-1, 1)};
        }
    }
    return patch;
}

/// A point of the surface, by de Casteljau's way, which the tessellation does not use.
Vec3 surface_point(const BezierPatch& patch, double u, double v) {
    const auto curve = [](std::array<Vec3, 4> p, double t) {
        for (std::size_t n = 3; n > 0; --n) {
            for (std::size_t i = 0; i < n; ++i) {
                p[i] = (1 - t) * p[i] + t * p[i + 1];
            }
        }
        return p[0];
    };
    std::array<Vec3, 4> rows;
    for (std::size_t i = 0; i < 4; ++i) {
        rows[i] = curve({patch[4 * i], patch[4 * i + 1], patch[4 * i + 2], patch[4 * i + 3]}, v);
    }
    return curve(rows, u);
}

/// Distance of a point from a triangle (Ericson 2005, 5.1.5, by regions).
double distance(const Vec3& p, const Triangle& t) {
    const Vec3 normal = area_vector(t);
    const double square = dot(normal, normal);
    const Vec3 from = p - t[0];
    const double u = dot(cross(from, t[2] - t[0]), normal) / square;
    const double v = dot(cross(t[1] - t[0], from), normal) / square;
    if (u >= 0 && v >= 0 && u + v <= 1) {
        return std::abs(dot(from, normal)) / std::sqrt(square);
    }
    double nearest = INFINITY;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3 side = t[(i + 1) % 3] - t[i];
        const double along = std::clamp(dot(p - t[i], side) / dot(side, side), 0.0, 1.0);
        nearest = std::min(nearest, length(p - t[i] - along * side));
    }
    return nearest;
}

double size_of(const BezierPatch& patch) {
    Bounds bounds;
    for (const Vec3& p : patch) {
        bounds.add(p);
    }
    return length(bounds.size());
}

/// The largest distance of the surface from the triangles, as a fraction of the patch's size.
double deviation(const BezierPatch& patch, const std::vector<Triangle>& triangles) {
    double largest = 0;
    constexpr int kSteps = 40;
    for (int i = 0; i <= kSteps; ++i) {
        for (int j = 0; j <= kSteps; ++j) {
            const Vec3 p = surface_point(patch, double(i) / kSteps, double(j) / kSteps);
            double nearest = INFINITY;
            for (const Triangle& t : triangles) {
                nearest = std::min(nearest, distance(p, t));
            }
            largest = std::max(largest, nearest);
        }
    }
    return largest / size_of(patch);
}

TEST(BezierSurface, FollowsTheTrueSurfaceAsCloselyAsAsked) {
    Random random(91);
    for (const double tolerance : {0.1, 0.02, 0.005}) {
        for (const double height : {0.05, 0.5}) {
            const BezierPatch patch = random_patch(random, height);
            const auto triangles = make_bezier_surface({&patch, 1}, {tolerance});
            EXPECT_LE(deviation(patch, triangles), tolerance);
        }
    }
}

TEST(BezierSurface, DeviationShowsTooFewTriangles) {
    Random random(92);
    const BezierPatch patch = random_patch(random, 0.5);
    EXPECT_GT(deviation(patch, make_bezier_surface({&patch, 1}, {0.3})), 0.005);
}

TEST(BezierSurface, DoesNotWasteTriangles) {
    Random random(93);
    BezierPatch patch = random_patch(random, 0);
    for (std::size_t i = 0; i < 16; ++i) {
        // A gutter: bent along u only.
        const std::size_t u = i / 4, v = i % 4;
        patch[i] = {double(u) / 3, double(v) / 3, u == 0 || u == 3 ? 0.0 : 0.3};
    }
    const auto gutter = make_bezier_surface({&patch, 1}, {1e-3});
    EXPECT_LT(gutter.size(), 60U);
    EXPECT_LE(deviation(patch, gutter), 1e-3);
    EXPECT_GT(deviation(patch, gutter), 1e-4);
    for (Vec3& p : patch) {
        p.z = 0;
    }
    EXPECT_EQ(make_bezier_surface({&patch, 1}, {1e-3}).size(), 2U);
}

TEST(BezierSurface, AFlatPatchHasItsAreaAndUpperSide) {
    BezierPatch patch;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            patch[4 * i + j] = {2 * double(i) / 3, 3 * double(j) / 3, 1};
        }
    }
    const auto triangles = make_bezier_surface({&patch, 1}, {1e-3});
    EXPECT_NEAR(area(triangles), 6, 1e-12);
    for (const Triangle& t : triangles) {
        EXPECT_GT(area_vector(t).z, 0);  // u along x, v along y
    }
}

TEST(BezierSurface, ACornerDrawnTogetherLeavesNoTrianglesWithoutArea) {
    Random random(94);
    BezierPatch patch = random_patch(random, 0.3);
    for (std::size_t j = 0; j < 4; ++j) {
        patch[j] = {-0.2, 0.5, 0};
    }
    for (const Triangle& t : make_bezier_surface({&patch, 1}, {1e-2})) {
        EXPECT_GT(area(t), 0);
    }
}

TEST(BezierSurface, OfOnePointHasNoArea) {
    BezierPatch patch;
    patch.fill({1, 2, 3});
    const auto triangles = make_bezier_surface({&patch, 1}, {});
    ASSERT_FALSE(triangles.empty());
    EXPECT_EQ(area(triangles), 0);
}

using Key = std::tuple<double, double, double>;

Key key(const Vec3& p) {
    return {p.x, p.y, p.z};
}

/// Sides that belong to one triangle only, compared bit for bit, whose both ends lie on the curve
/// given by four control points: the cracks along it.
std::size_t cracks_along(const std::array<Vec3, 4>& curve, const std::vector<Triangle>& triangles) {
    BezierPatch ribbon;
    for (std::size_t i = 0; i < 16; ++i) {
        ribbon[i] = curve[i % 4];
    }
    const auto lies_on_curve = [&](const Key& k) {
        const auto& [x, y, z] = k;
        double nearest = INFINITY;
        for (int i = 0; i <= 1000; ++i) {
            nearest =
                std::min(nearest, length(surface_point(ribbon, 0, i / 1000.0) - Vec3{x, y, z}));
        }
        return nearest < 1e-3;
    };
    std::map<std::pair<Key, Key>, int> count;
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Key a = key(t[i]), b = key(t[(i + 1) % 3]);
            ++count[{std::min(a, b), std::max(a, b)}];
        }
    }
    std::size_t cracks = 0;
    for (const auto& [side, uses] : count) {
        cracks += uses == 1 && lies_on_curve(side.first) && lies_on_curve(side.second) ? 1 : 0;
    }
    return cracks;
}

/// The same patch with u and v changed in one of eight ways.
BezierPatch turned(const BezierPatch& patch, int way) {
    BezierPatch result;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            const std::size_t a = (way & 1) != 0 ? 3 - i : i, b = (way & 2) != 0 ? 3 - j : j;
            result[4 * i + j] = (way & 4) != 0 ? patch[4 * b + a] : patch[4 * a + b];
        }
    }
    return result;
}

/// Two patches side by side, one flatter than the other; they share the curve that is given too.
struct Neighbours {
    BezierPatch left, right;
    std::array<Vec3, 4> seam;
};

Neighbours neighbours(Random& random) {
    Neighbours two{random_patch(random, 0.05), random_patch(random, 0.8), {}};
    for (Vec3& p : two.right) {
        p.x += 1;
    }
    for (std::size_t j = 0; j < 4; ++j) {
        two.seam[j] = two.left[12 + j];
        two.right[j] = two.seam[j];
    }
    return two;
}

TEST(BezierSurface, HasNoCracksBetweenPatchesHoweverTheyAreTurned) {
    Random random(95);
    for (int way = 0; way < 64; ++way) {
        const Neighbours two = neighbours(random);
        const std::array patches{turned(two.left, way % 8), turned(two.right, way / 8)};
        EXPECT_EQ(cracks_along(two.seam, make_bezier_surface(patches, {0.01})), 0U) << way;
    }
}

TEST(BezierSurface, PatchesThatAreMadeOneByOneDoShowCracks) {
    Random random(96);
    const Neighbours two = neighbours(random);
    auto triangles = make_bezier_surface({&two.left, 1}, {0.01});
    for (const Triangle& t : make_bezier_surface({&two.right, 1}, {0.01})) {
        triangles.push_back(t);
    }
    EXPECT_GT(cracks_along(two.seam, triangles), 0U);
}

TEST(BezierSurface, WithinAPatchEveryInnerSideIsShared) {
    Random random(97);
    const BezierPatch patch = random_patch(random, 0.5);
    const auto triangles = make_bezier_surface({&patch, 1}, {0.01});
    std::map<std::pair<Key, Key>, int> count;
    for (const Triangle& t : triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            const Key a = key(t[i]), b = key(t[(i + 1) % 3]);
            ++count[{std::min(a, b), std::max(a, b)}];
        }
    }
    std::map<Key, int> rim;  // how many open sides meet in a point
    for (const auto& [side, uses] : count) {
        ASSERT_LE(uses, 2);
        if (uses == 1) {
            ++rim[side.first];
            ++rim[side.second];
        }
    }
    for (const auto& [point, sides] : rim) {
        EXPECT_EQ(sides, 2);
    }
    // Euler: one rim of r sides, e = (3 f + r) / 2, v - e + f = 1; so v - 1 = (f + r) / 2.
    std::map<Key, int> points;
    for (const auto& [side, uses] : count) {
        points[side.first] = points[side.second] = 1;
    }
    EXPECT_EQ(2 * (points.size() - 1), triangles.size() + rim.size());
}

}  // namespace

}  // namespace quasimc
