#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

TEST(ReadObj, CountsVerticesFromOneOrFromTheLast) {
    const ReadMesh read = read_mesh_text("obj", kSquare + "f 1 2 3\nf -4 -2 -1\n");
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(triangles_of(read.mesh).size(), 2U);
    EXPECT_EQ(triangles_of(read.mesh)[0][2], (Vec3{1, 1, 0}));
    EXPECT_EQ(triangles_of(read.mesh)[1], (Triangle{Vec3{0, 0, 0}, Vec3{1, 1, 0}, Vec3{0, 1, 0}}));
}

TEST(ReadObj, PassesOverTextureAndNormalIndices) {
    const ReadMesh read = read_mesh_text(
        "obj",
        kSquare + "vn 0 0 1\nvt 0 0\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 3/1/1 4/1/1\n");
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(triangles_of(read.mesh).size(), 3U);
}

TEST(ReadObj, CutsPolygonsIntoTriangles) {
    const ReadMesh read = read_mesh_text("obj", kSquare + "f 1 2 3 4\n");
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    ASSERT_EQ(triangles.size(), 2U);
    EXPECT_DOUBLE_EQ(area(triangles), 1);
    EXPECT_EQ(read.mesh.groups[0].parts[0].lines, (std::vector<std::uint32_t>{5, 5}));
}

TEST(ReadObj, EachPairOfObjectAndGroupIsAnOrganWhereverItsFacesStand) {
    const ReadMesh read = read_mesh_text(
        "obj", kSquare +
                   "f 1 2 3\no tree\nf 1 2 3\ng leaf 1\nf 1 2 3\no bush\ng leaf 1\nf 1 2 3\n"
                   "o tree\ng leaf 1\nf 1 3 4\n");
    ASSERT_EQ(read.mesh.groups.size(), 4U);
    EXPECT_EQ(read.mesh.groups[0].name, "");
    EXPECT_EQ(read.mesh.groups[1].name, "tree");
    EXPECT_EQ(read.mesh.groups[2].name, "tree/leaf 1");
    EXPECT_EQ(read.mesh.groups[2].parts[0].faces.size(), 2U);
    EXPECT_EQ(read.mesh.groups[3].name, "bush/leaf 1");
}

TEST(ReadObj, PartsOfAnOrganHaveTheirOwnMaterials) {
    const ReadMesh read = read_mesh_text(
        "obj", kSquare + "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl a\nf 1 3 4\n");
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    const std::vector<MeshPart>& parts = read.mesh.groups[0].parts;
    ASSERT_EQ(parts.size(), 2U);
    EXPECT_EQ(parts[0].material, "a");
    EXPECT_EQ(parts[0].faces.size(), 2U);
    EXPECT_EQ(parts[1].material, "b");
}

TEST(ReadObj, LinesGoOnAfterABackslash) {
    const ReadMesh read = read_mesh_text("obj", kSquare + "f 1 \\\n 2 \\\r\n 3\n");
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(triangles_of(read.mesh).size(), 1U);
    EXPECT_EQ(triangles_of(read_mesh_text("obj", kSquare + "f 1 2 3 \\").mesh).size(), 1U);
}

TEST(ReadObj, ReportsEveryBadStatement) {
    const ReadMesh read = read_mesh_text(
        "obj",
        "v 0 0\nv 0 0 nan\nv 1 0 zero\nv 0 1 0\nf 1 2\nf 1 2 5\nf 0 1 2\nf -5 1 2\nf 1 2 a\n"
        "f 1 2 99999999999999999999\nface 1 2 3\nf 1 2 3 /\ng \xff\n");
    EXPECT_TRUE(mentions(read.faults, "file:1: a vertex with less than three numbers"));
    EXPECT_TRUE(mentions(read.faults, "file:2: 'nan' is not a finite number"));
    EXPECT_TRUE(mentions(read.faults, "file:3: 'zero' is not a finite number"));
    EXPECT_TRUE(mentions(read.faults, "file:5: a face with 2 corners"));
    EXPECT_TRUE(
        mentions(read.faults, "file:6: '5' is not a vertex (there are 4 vertices above it"));
    EXPECT_TRUE(mentions(read.faults, "file:7: '0' is not a vertex"));
    EXPECT_TRUE(mentions(read.faults, "file:8: '-5' is not a vertex"));
    EXPECT_TRUE(mentions(read.faults, "file:9: 'a' is not a vertex"));
    EXPECT_TRUE(mentions(read.faults, "file:10: '99999999999999999999' is not a vertex"));
    EXPECT_TRUE(mentions(read.faults, "file:11: 'face' is not an OBJ statement"));
    EXPECT_TRUE(mentions(read.faults, "file:12: '/' is not a vertex"));
    EXPECT_TRUE(mentions(read.faults, "file:13: the name '?' is not UTF-8"));
    EXPECT_EQ(read.faults.size(), 12U);
}

TEST(ReadObj, CutsFacesWhoseSidesCrossIntoFansAndCountsThem) {
    const ReadMesh read = read_mesh_text(
        "obj", "v 0 0 0\nv 2 0 0\nv 0.5 1 0\nv 1 1.5 0\nf 1 2 3 4\nf 1 2 4 3\nf 1 4 2 3\n");
    EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
    ASSERT_EQ(read.warnings.size(), 1U);
    EXPECT_TRUE(read.warnings[0].starts_with(
        "file: 2 faces have sides that intersect, the first is of line 5; "))
        << read.warnings[0];
    EXPECT_EQ(triangles_of(read.mesh).size(), 6U);
}

TEST(ReadObj, WarnsOnceOfSurfacesThatItCanNotRead) {
    const ReadMesh read = read_mesh_text("obj", kSquare + "surf 0 1\nsurf 0 1\nf 1 2 3\n");
    EXPECT_TRUE(read.faults.empty());
    EXPECT_EQ(read.warnings.size(), 1U);
}

TEST(ReadObj, RefusesAFaceOfTooManyCorners) {
    std::string face = "f";
    for (int i = 0; i < 5000; ++i) {
        face += " 1";
    }
    EXPECT_TRUE(mentions(read_mesh_text("obj", kSquare + face).faults, "a face with 5000 corners"));
}

TEST(ReadObj, TakesMaterialsFromItsLibrary) {
    const ReadMesh read = read_mesh_text(
        "obj", "mtllib a.mtl\n" + kSquare + "usemtl green leaf\nf 1 2 3\n",
        {{"a.mtl", "# x\nnewmtl green leaf\nKa 1 1 1\nKd 0.1 0.2 0.3\nnewmtl other\n"}});
    ASSERT_EQ(read.mesh.materials.size(), 2U);
    EXPECT_EQ(read.mesh.materials[0].name, "green leaf");
    EXPECT_NEAR(read.mesh.materials[0].reflectance, 0.2, 1e-15);
}

TEST(ReadObj, TakesColoursOfOneNumberAndLeavesSpectraToTheRunFile) {
    const ReadMesh read = read_mesh_text(
        "obj", "mtllib a.mtl\n" + kSquare + "f 1 2 3\n",
        {{"a.mtl",
          "newmtl grey\nKd 0.3\nnewmtl measured\nKd spectral a.rfl\nnewmtl grey\nKd 0.7 0.7 "
          "0.7\n"}});
    EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
    ASSERT_EQ(read.mesh.materials.size(), 2U);
    EXPECT_NEAR(read.mesh.materials[0].reflectance, 0.3, 1e-15);
    EXPECT_FALSE(read.mesh.materials[1].has_optics);
    EXPECT_TRUE(mentions(read.warnings, "material 'grey' is given twice; the first is used"));
}

TEST(ReadObj, OnlyWarnsOfAMissingLibrary) {
    const ReadMesh read = read_mesh_text("obj", "mtllib none.mtl\n" + kSquare + "f 1 2 3\n");
    EXPECT_TRUE(read.faults.empty());
    EXPECT_TRUE(mentions(read.warnings, "'none.mtl' can't be read"));
}

TEST(ReadObj, RefusesALibraryWithColoursOutOfRange) {
    const ReadMesh read = read_mesh_text(
        "obj", "mtllib a.mtl\n" + kSquare + "f 1 2 3\n", {{"a.mtl", "newmtl a\nKd 0.1 2 0\n"}});
    EXPECT_TRUE(mentions(read.faults, "a.mtl:2: Kd '2' is not a number from 0 to 1"));
}

}  // namespace
}  // namespace quasimc::test
