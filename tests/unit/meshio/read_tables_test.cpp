// Formats that are tables of numbers: fastTracer's, RAMI's.

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

TEST(ReadFastTracer, TakesSeventeenColumns) {
    const ReadMesh read = read_mesh_text(
        "fasttracer",
        "1 2 3 4 5  0 0 1 1 0 1 0 1 1  0.9 0.1 0.2\n"
        "1 2 3 4 6  0 0 2 1 0 2 0 1 2  0.9 0.1 0.2\n\n"
        "1 2 3 4 5  0 0 3 1 0 3 0 1 3  0.9 0.2 0.3\n");
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].name, "1-2-3-4-5");
    EXPECT_EQ(
        read.mesh.groups[1].labels,
        (Labels{{"id1", "1"}, {"id2", "2"}, {"id3", "3"}, {"id4", "4"}, {"id5", "6"}}));
    EXPECT_EQ(read.mesh.groups[0].parts.size(), 2U);
    ASSERT_EQ(read.mesh.materials.size(), 2U);
    EXPECT_EQ(read.mesh.materials[0].name, "reflectance 0.2 transmittance 0.1");
    EXPECT_EQ(triangles_of(read.mesh)[1][0], (Vec3{0, 0, 3})) << "group after group";
}

TEST(ReadFastTracer, GivesMaterialsToTheRun) {
    RunText text;
    text.organs = "[[geometry]]\nfile = 'a.txt'\nformat = 'fasttracer'\n";
    const RunFile run =
        read_text(text.text(), {{"a.txt", "1 2 3 4 5  0 0 1 1 0 1 0 1 1  0.9 0.1 0.2\n"}});
    EXPECT_EQ(run.scene.material_names().back(), "reflectance 0.2 transmittance 0.1");
    ASSERT_FALSE(run.warnings.empty());
    EXPECT_NE(
        run.warnings[0].text.find("that file gives reflectance 0.2, transmittance 0.1 in every"),
        std::string::npos)
        << run.warnings[0].text;
}

TEST(ReadFastTracer, ReportsEveryBadLine) {
    const ReadMesh read =
        read_mesh_text("fasttracer", "1 2 3\n1 2 3 4 5  0 0 1 1 0 1 0 1 1  0.9 0.5 0.6\n1 2 x\n");
    ASSERT_EQ(read.faults.size(), 3U);
    EXPECT_TRUE(read.faults[0].starts_with("file:1: 3 numbers (a line contains 17 numbers: "));
    EXPECT_EQ(
        read.faults[1],
        "file:2: transmittance 0.5 and reflectance 0.6 (both must be at least 0, and their sum at "
        "most 1)");
    EXPECT_TRUE(read.faults[2].starts_with("file:3: 'x' is not a finite number"));
}

TEST(ReadDef, MakesDisksOfTheStatedArea) {
    const ReadMesh read = read_mesh_text("def", "0.5 1 2 3 0 0 2\n0.1 0 0 0 1 1 0\n");
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    const std::vector<Triangle> first(
        triangles.begin(), triangles.begin() + read.mesh.groups[0].parts[0].faces.size());
    EXPECT_NEAR(area(first), 0.25 * 3.14159265358979, 1e-12);
    for (const Triangle& triangle : first) {
        EXPECT_EQ(triangle[0].z, 3);
        EXPECT_GT(area_vector(triangle).z, 0) << "its upper side is that of the normal";
    }
}

TEST(ReadDef, ReportsEveryBadLine) {
    const ReadMesh read = read_mesh_text("def", "1 2\n-1 0 0 0 0 0 1\n1 0 0 0 0 0 0\n");
    const std::string rule = " (a line contains the radius of a leaf, its centre and its normal)";
    EXPECT_EQ(
        read.faults, (Texts{
                         "file:1: 2 numbers" + rule,
                         "file:2: the radius or the length of the normal is not positive" + rule,
                         "file:3: the radius or the length of the normal is not positive" + rule}));
}

}  // namespace
}  // namespace quasimc::test
