#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

const std::string kLeafOpf = R"(<opf><meshBDD><mesh Id="0"><points>0 0 1 1 0 1 0 1 1</points>
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

TEST(ReadOps, TellsWhatIsWrong) {
    EXPECT_EQ(
        read_placed("0 0 0 1 0 0").faults,
        Texts{"file:3: 9 fields (a plant has ten: scene, plant, file, x, y, z, scale, azimuth and "
              "angle of inclination, twist)"});
    EXPECT_EQ(read_placed("0 0 up 1 0 0 0").faults, Texts{"file:3: 'up' is not a finite number"});
    const std::string rows = "1 1 b.opf 0 0 0 1 0 0 0\n1 2 b.opf 0 0 0 1 0 0 0\n";
    EXPECT_EQ(
        read_mesh_text("ops", rows).faults,
        Texts{"file:1: 'b.opf' can't be read (No such file or directory)"})
        << "a file is told of once";
    EXPECT_EQ(
        read_mesh_text("ops", rows, {{"b.opf", "<opf></opf>"}}).faults,
        Texts{"b.opf: has no <topology> (it is no OPF file)"});
    EXPECT_EQ(
        read_mesh_text("ops", "1 1 a.ops 0 0 0 1 0 0 0\n").faults,
        Texts{
            "file:1: the format of 'a.ops' can't be read; plants are OPF, or of another format of "
            "geometry"});
}

}  // namespace
}  // namespace quasimc::test
