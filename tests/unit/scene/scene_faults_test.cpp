#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "small_scenes.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A sound builder with one organ.
SceneBuilder sound_builder() {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("sound", flat_triangle({})));
    return builder;
}

Cell cell_along_x(double low, double size) {
    Cell cell;
    cell.along_x = true;
    cell.low_x = low;
    cell.size_x = size;
    return cell;
}

TEST(SceneFaults, AreNoneInASoundScene) {
    EXPECT_EQ(faults_of(sound_builder()), Texts{});
}

TEST(SceneFaults, AreAllReportedAtOnce) {
    SceneBuilder builder({{"PAR"}, {"PAR"}, {""}}, Orientation(UpAxis::z, {0, 0, 1}));
    builder.add_material(lambertian("leaf", 0.7, 0.7), "materials.toml:3");
    OrganSpec unknown = one_triangle("leaf 7", flat_triangle({}));
    unknown.parts[0].material = "lef";
    unknown.where = "leaves.toml:12";
    builder.add_organ(unknown);
    OrganSpec empty;
    empty.name = "stalk";
    builder.add_organ(empty);
    builder.add_organ(one_triangle("far", flat_triangle({kInfinity, 0, 0})));
    builder.set_cell(cell_along_x(0, -1));
    builder.set_ground({.material = "soil", .extent = {{1, 0, 0, 1}}});
    const Texts faults = faults_of(std::move(builder));
    const auto has = [&](const std::string& part) {
        return std::any_of(faults.begin(), faults.end(), [&](const std::string& fault) {
            return fault.find(part) != std::string::npos;
        });
    };
    EXPECT_TRUE(has("band 'PAR' is named twice"));
    EXPECT_TRUE(has("band 3 has no name"));
    EXPECT_TRUE(has("is not horizontal"));
    EXPECT_TRUE(has("materials.toml:3: material 'leaf'"));
    EXPECT_TRUE(has("leaves.toml:12: organ 'leaf 7': material 'lef' is not defined"));
    EXPECT_TRUE(has("organ 'stalk' (id 2): it has no triangles"));
    EXPECT_TRUE(has("organ 'far' (id 3): corner 1 of triangle 1 is (inf, 0, 0)"));
    EXPECT_TRUE(has("cell along x: the size is -1"));
    EXPECT_TRUE(has("ground: the extent along x is from 1 to 0"));
    EXPECT_TRUE(has("material 'soil' is not defined"));
}

TEST(SceneFaults, SuggestTheMaterialThatWasMeant) {
    SceneBuilder builder = one_band_builder();
    OrganSpec organ = one_triangle("leaf 7", flat_triangle({}));
    organ.parts[0].material = "lef";
    organ.where = "leaves.toml:12";
    builder.add_organ(std::move(organ));
    EXPECT_EQ(
        faults_of(std::move(builder)),
        (Texts{"leaves.toml:12: organ 'leaf 7': material 'lef' is not defined (organs refer to "
               "materials by name); did you mean 'leaf'?"}));
}

TEST(SceneFaults, NameAMissingMaterialOnce) {
    SceneBuilder builder({{"PAR"}});
    for (int i = 0; i < 100; ++i) {
        builder.add_organ(one_triangle("", flat_triangle({})));
    }
    EXPECT_EQ(
        faults_of(std::move(builder)),
        (Texts{"organ 'organ 1' (id 1): material 'leaf' is not defined (100 parts of organs use "
               "it); define a material with that name"}));
}

TEST(SceneFaults, NameBothLocationsOfAnIdThatIsTaken) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(with_id(4, "a.tri:1"));
    builder.add_organ(with_id(2, "a.tri:2"));
    builder.add_organ(with_id(4, "b.tri:1"));
    builder.add_organ(with_id(4, "b.tri:2"));
    EXPECT_EQ(
        faults_of(std::move(builder)),
        (Texts{
            "b.tri:1: organ 'organ 4': id 4 is used already (by a.tri:1: organ 'organ 4'); ids "
            "must be unique in a scene",
            "b.tri:2: organ 'organ 4': id 4 is used already (by a.tri:1: organ 'organ 4'); ids "
            "must be unique in a scene"}));
}

TEST(SceneFaults, FindAnIdThatWasGivenByDefault) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("", flat_triangle({})));
    builder.add_organ(with_id(1, "a.tri:2"));
    EXPECT_EQ(faults_of(std::move(builder)).size(), 1U);
}

TEST(SceneFaults, RefuseTheLastIdSoThatOneIsFree) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(with_id(std::numeric_limits<std::int64_t>::max(), "a"));
    builder.add_organ(one_triangle("", flat_triangle({})));
    const Texts faults = faults_of(std::move(builder));
    ASSERT_FALSE(faults.empty());
    EXPECT_NE(faults[0].find("id 9223372036854775807 is too large"), std::string::npos);
}

TEST(SceneFaults, NameBothLocationsOfAMaterialDefinedTwice) {
    SceneBuilder builder({{"PAR"}});
    builder.add_material(lambertian("leaf"), "a.toml:1");
    builder.add_material(lambertian("leaf"), "b.toml:1");
    builder.add_organ(one_triangle("", flat_triangle({})));
    EXPECT_EQ(
        faults_of(std::move(builder)),
        (Texts{"b.toml:1: material 'leaf': it is defined twice (the first is at a.toml:1)"}));
}

TEST(SceneFaults, CountTheBandsOfAMaterial) {
    SceneBuilder builder({{"R"}, {"FR"}});
    builder.add_material(lambertian("leaf"));
    builder.add_organ(one_triangle("", flat_triangle({})));
    EXPECT_EQ(faults_of(std::move(builder)).size(), 2U);  // upper and lower side
}

TEST(SceneFaults, AreGivenInTheAxesOfTheFile) {
    SceneBuilder builder = one_band_builder(Orientation(UpAxis::y, {0, 0, -1}));
    builder.add_organ(one_triangle("a", {Vec3{1, 2, 3}, {1, kNan, 3}, {1, 2, 4}}));
    const Texts faults = faults_of(std::move(builder));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(faults[0].find("corner 2 of triangle 1 is (1, nan, 3)"), std::string::npos);
}

TEST(SceneFaults, CountTheTrianglesThatAreNotFinite) {
    SceneBuilder builder = one_band_builder();
    OrganSpec organ = one_triangle("a", flat_triangle({}));
    for (int i = 0; i < 3; ++i) {
        organ.parts.push_back({"leaf", {flat_triangle({0, 0, 1e31})}});
    }
    builder.add_organ(std::move(organ));
    const Texts faults = faults_of(std::move(builder));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_NE(
        faults[0].find(
            "corner 1 of triangle 2 is (0, 0, 1e+31), and 2 more triangles with this error"),
        std::string::npos);
}

TEST(SceneFaults, RefuseASceneWithoutOrgans) {
    EXPECT_EQ(
        faults_of(one_band_builder()),
        (Texts{"scene: there are no organs (results are computed for organs); add one"}));
}

TEST(SceneFaults, RefuseASceneWithoutBands) {
    SceneBuilder builder({});
    builder.add_material({"leaf", {}, {}});
    builder.add_organ(one_triangle("", flat_triangle({})));
    EXPECT_EQ(faults_of(std::move(builder)).size(), 1U);
}

TEST(SceneFaults, RefuseASceneInOnePoint) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("a", {Vec3{1, 1, 1}, {1, 1, 1}, {1, 1, 1}}));
    EXPECT_EQ(faults_of(std::move(builder)).size(), 1U);
}

TEST(SceneFaults, RefuseANorthThatIsNoDirection) {
    for (const Vec3 north : {Vec3{}, Vec3{kNan, 1, 0}, Vec3{0, 1, 1e-3}}) {
        SceneBuilder builder = one_band_builder(Orientation(UpAxis::z, north));
        builder.add_organ(one_triangle("a", flat_triangle({})));
        EXPECT_EQ(faults_of(std::move(builder)).size(), 1U);
    }
}

TEST(SceneFaults, RefuseCellsWithoutASize) {
    for (const double size : {0.0, -1.0, kNan, kInfinity}) {
        SceneBuilder builder = sound_builder();
        builder.set_cell(cell_along_x(0, size));
        EXPECT_EQ(faults_of(std::move(builder)).size(), 1U) << size;
    }
    SceneBuilder builder = sound_builder();
    builder.set_cell(cell_along_x(kNan, 1));
    EXPECT_EQ(faults_of(std::move(builder)).size(), 1U);
}

TEST(SceneFaults, RefuseCellsThatTheOrgansFillWithoutMeasure) {
    SceneBuilder tiny = sound_builder();
    tiny.set_cell(cell_along_x(0, 1e-7));
    EXPECT_EQ(faults_of(std::move(tiny)).size(), 1U);

    SceneBuilder both = sound_builder();
    Cell cell = cell_along_x(0, 1e-5);
    cell.along_y = true;
    cell.size_y = 1e-5;
    both.set_cell(cell);
    EXPECT_EQ(faults_of(std::move(both)).size(), 1U);
}

Cell square_cell(double size) {
    Cell cell;
    cell.along_x = cell.along_y = true;
    cell.size_x = cell.size_y = size;
    return cell;
}

/// A square of side 1 as 2 x 32 x 32 triangles.
OrganSpec fine_leaf(double rise) {
    constexpr int kSteps = 32;
    OrganSpec leaf = one_triangle("leaf", flat_triangle({}));
    std::vector<Triangle> triangles;
    const auto p = [&](int i, int k) {
        return Vec3{1. / kSteps * i, 1. / kSteps * k, 1 + rise * (i * 0.02 + k * 0.03)};
    };
    for (int i = 0; i < kSteps; ++i) {
        for (int k = 0; k < kSteps; ++k) {
            triangles.push_back({p(i, k), p(i + 1, k), p(i, k + 1)});
            triangles.push_back({p(i + 1, k), p(i + 1, k + 1), p(i, k + 1)});
        }
    }
    leaf.parts = {{"leaf", triangles}};
    return leaf;
}

/// A leaf in centimetres in a cell in metres: thousands of its images lie on each other.
TEST(SceneFaults, RefuseFlatOrgansThousandsOfTimesLargerThanTheCell) {
    for (const bool is_fine : {false, true}) {
        SceneBuilder builder = one_band_builder();
        builder.add_organ(is_fine ? fine_leaf(0) : one_triangle("leaf", flat_triangle({}, 1.5)));
        builder.set_cell(square_cell(0.01));
        const Texts faults = faults_of(std::move(builder));
        ASSERT_EQ(faults.size(), 1U);
        EXPECT_TRUE(faults[0].starts_with("cell: horizontal surfaces are 1")) << faults[0];
        EXPECT_NE(faults[0].find("in the same unit of length"), std::string::npos) << faults[0];
    }
}

/// Images of a wall along the cell lie on each other as well.
TEST(SceneFaults, RefuseWallsThousandsOfTimesLongerThanTheCell) {
    SceneBuilder builder = one_band_builder();
    builder.add_organ(one_triangle("wall", {Vec3{0, 0, 0}, {10, 0, 0}, {10, 0, 2}}));
    builder.set_cell(cell_along_x(0, 0.002));
    const Texts faults = faults_of(std::move(builder));
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_TRUE(faults[0].starts_with("cell: each triangle appears 500")) << faults[0];
}

TEST(SceneFaults, LetOrgansBeSomeTimesLargerThanTheCell) {
    for (const double rise : {0., 1.}) {
        SceneBuilder builder = one_band_builder();
        builder.add_organ(fine_leaf(rise));
        builder.set_cell(square_cell(0.07));
        EXPECT_EQ(faults_of(std::move(builder)), Texts{});
    }
}

TEST(SceneFaults, ConcernPeriodicAxesOnly) {
    SceneBuilder builder = sound_builder();
    Cell cell;
    cell.size_x = -1;
    cell.size_y = kNan;
    builder.set_cell(cell);
    EXPECT_EQ(faults_of(std::move(builder)), Texts{});
}

TEST(SceneFaults, OfVeryManyOrgansAreCounted) {
    SceneBuilder builder = one_band_builder();
    for (int i = 0; i < 3000; ++i) {
        builder.add_organ({});
    }
    const Texts faults = faults_of(std::move(builder));
    ASSERT_EQ(faults.size(), 1001U);
    EXPECT_EQ(faults.back(), "organs: 2000 more errors");
}

}  // namespace
}  // namespace quasimc::test
