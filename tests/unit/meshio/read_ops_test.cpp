#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A leaf of a metre: AMAP's plants are in centimetres.
const std::string kLeafOpf =
    R"(<opf><meshBDD><mesh Id="0"><points>0 0 100 100 0 100 0 100 100</points>
<faces><face>0 1 2</face></faces></mesh></meshBDD>
<materialBDD><material Id="4"><diffuse>0.1 0.2 0.3 1</diffuse></material></materialBDD>
<shapeBDD><shape Id="0"><meshIndex>0</meshIndex><materialIndex>4</materialIndex></shape></shapeBDD>
<topology class="Plant" id="1"><decomp class="Leaf" id="7"><geometry><shapeIndex>0</shapeIndex>
<mat>1 0 0 0 0 1 0 0 0 0 1 0</mat></geometry></decomp></topology></opf>)";

/// A scene of one plant, placed by seven numbers.
ReadMesh read_placed(const std::string& numbers) {
    return read_mesh_text(
        "ops", "T 0 0 0 10 10 flat\n#[Archimed] palms\n1 3 opf/leaf.opf " + numbers + "\n",
        {{"opf/leaf.opf", kLeafOpf}});
}

void expect_near(const Vec3& p, const Vec3& q) {
    EXPECT_LT(length(p - q), 1e-12) << p.x << " " << p.y << " " << p.z;
}

TEST(ReadOps, PlacesPlantsAndKeepsWhereOrgansComeFrom) {
    const ReadMesh read = read_mesh_text(
        "ops",
        "# sceneId plantId plantFileName x y z scale azimut angle twist\nT 0 0 0 10 10 flat\n"
        "#[Archimed] palms\n1\t3\topf/my leaf.opf\t2\t3\t4\t1\t0\t0\t0\n"
        "1\t4\topf/my leaf.opf\t5\t0\t0\t2\t0\t0\t0\n-1 1 1\n",
        {{"opf/my leaf.opf", kLeafOpf}});
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    const MeshGroup& group = read.mesh.groups[0];
    EXPECT_EQ(group.name, "3 Leaf 7");
    EXPECT_EQ(group.id, std::nullopt) << "plants have the same numbers of nodes";
    EXPECT_EQ(
        group.labels,
        (Labels{{"class", "Leaf"}, {"node", "7"}, {"plant", "3"}, {"group", "palms"}}));
    EXPECT_EQ(group.parts[0].material, "my leaf.opf material 4");
    ASSERT_EQ(read.mesh.materials.size(), 1U);
    EXPECT_EQ(read.mesh.materials[0].name, "my leaf.opf material 4");
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    EXPECT_EQ(triangles[0], (Triangle{Vec3{2, 3, 5}, Vec3{3, 3, 5}, Vec3{2, 4, 5}}));
    EXPECT_EQ(triangles[1], (Triangle{Vec3{5, 0, 2}, Vec3{7, 0, 2}, Vec3{5, 2, 2}}));
}

TEST(ReadOps, TurnsFirstThenInclinesTowardsTheAzimuth) {
    const double quarter = std::numbers::pi / 2;
    // A quarter of a turn: what was along x is along y.
    const ReadMesh turned = read_placed(fmt::format("0 0 0 1 0 0 {}", quarter));
    EXPECT_EQ(turned.faults, Texts{});
    expect_near(triangles_of(turned.mesh)[0][1], {0, 1, 1});
    // Inclined towards x by a quarter: the top comes to lie along x.
    const ReadMesh inclined = read_placed(fmt::format("0 0 0 1 0 {} 0", quarter));
    expect_near(triangles_of(inclined.mesh)[0][0], {1, 0, 0});
    // And towards y.
    const ReadMesh along_y = read_placed(fmt::format("0 0 0 1 {0} {0} 0", quarter));
    expect_near(triangles_of(along_y.mesh)[0][0], {0, 1, 0});
    const ReadMesh both = read_placed(fmt::format("0 0 0 2 0 {0} {0}", quarter));
    expect_near(triangles_of(both.mesh)[0][1], {2, 2, 0});
}

/// The numbers of a plant below a comment that names the columns.
ReadMesh read_below(const std::string& columns, const std::string& numbers) {
    return read_mesh_text(
        "ops", "#sceneId plantId plantFileName x y z " + columns + "\n1 3 a.opf " + numbers + "\n",
        {{"a.opf", kLeafOpf}});
}

TEST(ReadOps, TakesPlantsAsCentimetresAndPlacesAsMetresAndSaysSo) {
    const ReadMesh read = read_placed("2 0 0 1 0 0 0");
    EXPECT_NEAR(area(triangles_of(read.mesh)), 0.5, 1e-12);
    EXPECT_EQ(
        read.warnings,
        Texts{"file: plants are read in centimetres and their positions in metres, as in AMAP's "
              "programs; the largest plant is 1 m large; set plant_unit (\"cm\", "
              "\"m\", ...) to confirm or change it"});
    // A mesh without a unit of its own is in metres, as its position is.
    const ReadMesh other =
        read_mesh_text("ops", "1 1 a.tri 5 0 0 1 0 0 0\n", {{"a.tri", "0 0 0 1 0 0 0 1 0\n"}});
    EXPECT_EQ(other.warnings, Texts{});
    EXPECT_EQ(triangles_of(other.mesh)[0], (Triangle{Vec3{5, 0, 0}, Vec3{6, 0, 0}, Vec3{5, 1, 0}}));
}

TEST(ReadOps, ReadsPavements) {
    const std::string gwa = repository_file("tests/fuzz/corpus/gwa/pavement.gwa");
    const ReadMesh read =
        read_mesh_text("ops", "#[Archimed] floor\n1 1 p.gwa 1 0 0 2 0 0 0\n", {{"p.gwa", gwa}});
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_NEAR(area(triangles_of(read.mesh)), 4, 1e-12);
    EXPECT_EQ(read.mesh.groups[0].name, "1 pave");
    EXPECT_EQ(read.mesh.groups[0].parts[0].material, "p.gwa color 120 100 50");
}

TEST(ReadOps, ReadsLinesOfTheOldLayoutWithoutAScale) {
    const double quarter = std::numbers::pi / 2;
    const std::string turned = fmt::format("0 0 0 0 0 {}", quarter);
    for (const ReadMesh& read :
         {read_placed(turned), read_placed(turned + " 0"),
          read_below("inclinationAzimut inclinationAngle stemTwist", turned),
          read_below("inclinationAzimut inclinationAngle stemTwist ignored", turned + " 7")}) {
        EXPECT_EQ(read.faults, Texts{});
        expect_near(triangles_of(read.mesh)[0][1], {0, 1, 1});
    }
    EXPECT_TRUE(mentions(
        read_placed(turned).warnings, "file:3: 1 plant has no scale: their lines are read in the"));
    // The azimuth of such a line is no scale.
    const ReadMesh inclined = read_below(
        "inclinationAzimut inclinationAngle stemTwist ignored",
        fmt::format("0 0 0 {0} {0} 0 0", quarter));
    expect_near(triangles_of(inclined.mesh)[0][0], {0, 1, 0});
}

TEST(ReadOps, TakesTheScaleZeroAsOneAndDoubtsDegrees) {
    const std::string columns = "scale inclinationAzimut inclinationAngle stemTwist";
    const ReadMesh zero = read_below(columns, "0 0 0 0 0 0 0");
    EXPECT_NEAR(area(triangles_of(zero.mesh)), 0.5, 1e-12);
    EXPECT_TRUE(mentions(zero.warnings, "file:2: 1 plant has the scale 0, and 1 is used"));
    EXPECT_TRUE(mentions(
        read_below(columns, "0 0 0 1 0 0 90").warnings,
        "file:2: 1 plant has an angle beyond a full turn (2 pi)"));
    EXPECT_FALSE(mentions(read_below(columns, "0 0 0 1 0 0 6.2832").warnings, "full turn"));
}

TEST(ReadOps, KeepsTheMaterialsOfFilesOfOneNameApart) {
    std::string dark = kLeafOpf;
    dark.replace(dark.find("0.1 0.2 0.3"), 11, "0.0 0.0 0.0");
    const ReadMesh read = read_mesh_text(
        "ops", "1 1 a/leaf.opf 0 0 0 1 0 0 0\n1 2 b/leaf.opf 3 0 0 1 0 0 0\n",
        {{"a/leaf.opf", kLeafOpf}, {"b/leaf.opf", dark}});
    ASSERT_EQ(read.mesh.materials.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].parts[0].material, "leaf.opf material 4");
    EXPECT_EQ(read.mesh.groups[1].parts[0].material, "b/leaf.opf material 4");
    EXPECT_EQ(read.mesh.materials[1].name, "b/leaf.opf material 4");
    EXPECT_EQ(read.mesh.materials[1].reflectance, 0);
}

TEST(ReadOps, TellsWhatIsWrong) {
    EXPECT_EQ(
        read_placed("0 0 0 1 0").faults,
        Texts{"file:3: 8 fields (a plant has ten: scene, plant, file, x, y, z, scale, azimuth and "
              "angle of inclination, twist; nine (without scale) in the old layout)"});
    EXPECT_EQ(read_placed("0 0 up 1 0 0 0").faults, Texts{"file:3: 'up' is not a finite number"});
    const std::string rows = "1 1 b.opf 0 0 0 1 0 0 0\n1 2 b.opf 0 0 0 1 0 0 0\n";
    EXPECT_EQ(
        read_mesh_text("ops", rows).faults,
        Texts{"file:1: 'b.opf' can't be read (No such file or directory)"})
        << "a file is told of once";
    EXPECT_EQ(
        read_mesh_text("ops", rows, {{"b.opf", "<opf></opf>"}}).faults,
        Texts{"b.opf: has no <topology> (it is not an OPF file)"});
    EXPECT_EQ(
        read_mesh_text("ops", "1 1 a.ops 0 0 0 1 0 0 0\n").faults,
        Texts{"file:1: the format of 'a.ops' can't be read; plants must be OPF or another geometry "
              "format"});
    EXPECT_TRUE(
        mentions(read_mesh_text("ops", "1 1 a.dae 0 0 0 1 0 0 0\n").faults, "assimp export"));
}

}  // namespace
}  // namespace quasimc::test
