#include <cmath>

#include <gtest/gtest.h>

#include "small_scenes.h"
#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

constexpr const char* kSame =
    "1 triangle has the same corners as triangles of organ 'first' (id 1); there, only that organ "
    "receives light";
constexpr const char* kUpon =
    "1 triangle overlaps coplanar triangles of organ 'first' (id 1); there, only that organ "
    "receives light";

constexpr Triangle kTilted{Vec3{0.3, 0.1, 0.2}, {1.4, 0.2, 0.7}, {0.5, 1.3, 0.4}};

/// What is said of the organ "second".
Texts second(const char* words) {
    return {std::string("organ 'second' (id 2): ") + words};
}

/// A point in the plane of kTilted, (0, 0), (1, 0) and (0, 1) its corners.
Vec3 in_plane(double u, double v) {
    return kTilted[0] + u * (kTilted[1] - kTilted[0]) + v * (kTilted[2] - kTilted[0]);
}

Triangle part_of_plane(double u, double v, double leg) {
    return {in_plane(u, v), in_plane(u + leg, v), in_plane(u, v + leg)};
}

/// Warnings about two organs of one triangle each among clean random leaves, scaled and shifted.
Texts warnings_about(
    const Triangle& first, const Triangle& second, double scale = 1, const Vec3& shift = {}) {
    SceneBuilder builder = one_band_builder();
    const auto placed = [&](Triangle t) {
        for (Vec3& corner : t) {
            corner = scale * corner + shift;
        }
        return t;
    };
    builder.set_length_unit("");
    builder.add_organ(one_triangle("first", placed(first)));
    builder.add_organ(one_triangle("second", placed(second)));
    for (const Triangle& leaf : random_leaves(100, 1.3, 10, 7)) {
        builder.add_organ(one_triangle("", placed(leaf)));
    }
    return warnings_of(std::move(builder));
}

TEST(LintOverlap, OfAllOfTheGroundIsNoSmallGround) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("half", {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{1, 1, 0}}));
    builder.add_organ(one_triangle("other", {Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}));
    Cell cell;
    cell.along_x = cell.along_y = true;
    cell.size_x = cell.size_y = 1;
    builder.set_cell(cell);
    builder.set_ground({.material = "soil"});
    const std::vector<std::string> warnings = warnings_of(std::move(builder));
    ASSERT_EQ(warnings.size(), 2U);
    for (const std::string& warning : warnings) {
        EXPECT_NE(warning.find("the same corners"), std::string::npos) << warning;
    }
}

TEST(LintOverlap, FindsATriangleGivenTwice) {
    EXPECT_EQ(warnings_about(kTilted, kTilted), second(kSame));
}

TEST(LintOverlap, FindsATriangleGivenTwiceInAnyOrderOfCorners) {
    const Triangle turned{kTilted[1], kTilted[2], kTilted[0]};
    const Triangle reversed{kTilted[1], kTilted[0], kTilted[2]};
    EXPECT_EQ(warnings_about(kTilted, turned), second(kSame));
    EXPECT_EQ(warnings_about(kTilted, reversed), second(kSame));
}

TEST(LintOverlap, FindsTrianglesThatOverlapInOnePlane) {
    for (const double leg : {1e-2, 0.1, 0.6, 1.0, 3.0, 10.0}) {
        EXPECT_EQ(warnings_about(kTilted, part_of_plane(0.2, 0.3, leg)), second(kUpon)) << leg;
    }
}

TEST(LintOverlap, FindsSliversWhosePlaneRoundingTurns) {
    // Longer than the triangle, as flat as single precision allows, and turned by far more.
    const Vec3 n = normalized(area_vector(kTilted));
    for (const double width : {1e-3, 1e-4}) {
        const Triangle sliver{
            in_plane(-1.8, .4), in_plane(2.2, .4), in_plane(2.2, .4 + width) + 1e-7 * n};
        EXPECT_EQ(warnings_about(kTilted, sliver), second(kUpon)) << width;
        EXPECT_EQ(warnings_about(sliver, kTilted), second(kUpon)) << width;
    }
}

TEST(LintOverlap, FindsTheSameAtAnySizeAndPosition) {
    for (const double scale : {1e-12, 1e-3, 1e12}) {
        const Vec3 shift{1e4 * scale, -2e4 * scale, scale};
        EXPECT_EQ(warnings_about(kTilted, kTilted, scale, shift).size(), 1U) << scale;
        EXPECT_EQ(warnings_about(kTilted, part_of_plane(0.1, 0.2, 0.5), scale, shift).size(), 1U)
            << scale;
        EXPECT_EQ(warnings_about(kTilted, part_of_plane(1, 0, 0.5), scale, shift), Texts{})
            << scale;
    }
}

TEST(LintOverlap, LetsTrianglesTouch) {
    const Triangle neighbour{kTilted[2], kTilted[1], in_plane(1, 1)};
    EXPECT_EQ(warnings_about(kTilted, neighbour), Texts{});
    EXPECT_EQ(warnings_about(kTilted, part_of_plane(1, 0, 1)), Texts{});
    EXPECT_EQ(warnings_about(kTilted, part_of_plane(2, 2, 1)), Texts{});
}

TEST(LintOverlap, LetsTrianglesCross) {
    EXPECT_EQ(
        warnings_about(kTilted, {kTilted[0], kTilted[1], kTilted[2] + Vec3{0, 0, 0.01}}), Texts{});
}

TEST(LintOverlap, LetsTrianglesLieAboveEachOther) {
    const auto above = [](double distance) {
        Triangle t = kTilted;
        const Vec3 n = normalized(area_vector(t));
        for (Vec3& corner : t) {
            corner += distance * n;
        }
        return t;
    };
    EXPECT_EQ(warnings_about(kTilted, above(1e-4)), Texts{});
    EXPECT_EQ(warnings_about(kTilted, above(1e-7)).size(), 1U);  // less than single precision sees
}

TEST(LintOverlap, FindsALeafThatLiesOnTheGround) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("up", flat_triangle({0, 0, 1})));
    builder.add_organ(one_triangle("down", flat_triangle({0.3, 0.3, 0}, 0.1)));
    builder.set_ground({.material = "soil"});
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{
            "organ 'ground' (id 3): 2 triangles overlap coplanar triangles of organ 'down' (id 2); "
            "there, only that organ receives light"}));
}

TEST(LintOverlap, CountsTheTrianglesOfAnOrganGivenTwice) {
    SceneBuilder builder = one_band_builder();
    OrganSpec organ = one_triangle("first", kTilted);
    organ.parts[0].triangles = random_leaves(20, 1.3, 10, 3);
    builder.add_organ(organ);
    organ.name = "second";
    builder.add_organ(organ);
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{"organ 'second' (id 2): 20 triangles have the same corners as triangles of organ "
               "'first' (id 1); there, only that organ receives light"}));
}

TEST(LintOverlap, NamesAtMostThreePairsOfOrgans) {
    SceneBuilder builder = one_band_builder();
    for (int i = 0; i < 10; ++i) {
        builder.add_organ(one_triangle("a", flat_triangle({0, 0, 1.0 + i})));
        builder.add_organ(one_triangle("b", flat_triangle({0, 0, 1.0 + i})));
    }
    const Texts warnings = warnings_of(std::move(builder));
    ASSERT_EQ(warnings.size(), 4U);
    EXPECT_EQ(warnings[3], "scene: 7 more pairs of organs have triangles in common");
}

TEST(LintOverlap, IsSilentAboutAFineFlatMesh) {
    SceneBuilder builder = one_band_builder();
    OrganSpec field;
    field.name = "field";
    field.parts.push_back({"soil", {}});
    const int n = 100;
    for (int i = 0; i < n * n; ++i) {
        const auto corner = [&](int dx, int dy) {
            return Vec3{0.1 * (i % n + dx), 0.1 * (static_cast<int>(i / n) + dy), 0.7};
        };
        const Vec3 a = corner(0, 0);
        const Vec3 c = corner(1, 1);
        field.parts[0].triangles.push_back({a, corner(1, 0), c});
        field.parts[0].triangles.push_back({a, c, corner(0, 1)});
    }
    builder.add_organ(std::move(field));
    EXPECT_EQ(warnings_of(std::move(builder)), Texts{});
}

TEST(LintOverlap, IsSilentAboutAFineRoundMesh) {
    SceneBuilder builder = one_band_builder();
    OrganSpec stalk;
    stalk.name = "stalk";
    stalk.parts.push_back({"leaf", {}});
    const int sides = 2000;
    const auto corner = [&](int i, double z) {
        const double angle = 2 * 3.14159265358979323846 * (i % sides) / sides;
        return Vec3{std::cos(angle), std::sin(angle), z};
    };
    for (int i = 0; i < sides; ++i) {
        stalk.parts[0].triangles.push_back({corner(i, 0), corner(i + 1, 0), corner(i, 1)});
        stalk.parts[0].triangles.push_back({corner(i + 1, 0), corner(i + 1, 1), corner(i, 1)});
    }
    builder.add_organ(std::move(stalk));
    EXPECT_EQ(warnings_of(std::move(builder)), Texts{});
}

TEST(LintOverlap, SaysWhenItGivesUp) {
    SceneBuilder builder = one_band_builder();
    OrganSpec pile;
    pile.name = "pile";
    pile.parts.push_back({"leaf", {}});
    for (int i = 0; i < 12000; ++i) {
        pile.parts[0].triangles.push_back(flat_triangle({0, 0, 0.0001 * i}));
    }
    builder.add_organ(std::move(pile));
    EXPECT_EQ(
        warnings_of(std::move(builder)),
        (Texts{"scene: has too many triangles close together; not all were checked for overlaps"}));
}

TEST(LintOverlap, EndsSoonWhenAllTrianglesAreTheSame) {
    SceneBuilder builder = one_band_builder();
    OrganSpec pile;
    pile.name = "pile";
    pile.parts.push_back({"leaf", std::vector<Triangle>(20000, kTilted)});
    builder.add_organ(std::move(pile));
    EXPECT_EQ(warnings_of(std::move(builder)).size(), 1U);
}

}  // namespace
}  // namespace quasimc::test
