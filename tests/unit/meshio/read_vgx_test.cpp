#include <numbers>

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// The columns that PlantGL writes.
const std::string kVgxHead =
    "Obj\tEchX\tEchY\tEchZ\tTransX\tTransY\tTransZ\tRotX\tRotY\tRotZ\tR\tG\tB\tX1\tY1\tZ1\tX2\tY2"
    "\tZ2\tX3\tY3\tZ3\n";
const std::string kNoCorners = "\t0\t0\t0\t0\t0\t0\t0\t0\t0\n";

/// A row of an object that is green.
std::string vgx_row(const std::string& object, const std::string& corners = kNoCorners) {
    return object + "\t30\t90\t60" + corners;
}

std::vector<Triangle> triangles_of_vgx(const std::string& object) {
    const ReadMesh read = read_mesh_text("vgx", kVgxHead + vgx_row(object));
    EXPECT_EQ(read.faults, Texts{});
    return triangles_of(read.mesh);
}

Bounds bounds_of_all(const std::vector<Triangle>& triangles) {
    Bounds bounds;
    for (const Triangle& triangle : triangles) {
        bounds.add(bounds_of(triangle).low);
        bounds.add(bounds_of(triangle).high);
    }
    return bounds;
}

TEST(ReadVgx, TakesTriangles) {
    const std::string null = "0\t0\t0\t0\t0\t0\t0\t0\t0\t0";
    const ReadMesh read = read_mesh_text(
        "vgx", kVgxHead + vgx_row(null, "\t0\t0\t1\t2\t0\t1\t0\t2\t1\n") +
                   vgx_row(null, "\t0\t0\t3\t2\t0\t3\t0\t2\t3\n"));
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 1U) << "nothing tells them apart";
    EXPECT_EQ(read.mesh.groups[0].labels, (Labels{{"Obj", "0"}}));
    EXPECT_EQ(read.mesh.groups[0].parts[0].material, "color 30 90 60");
    ASSERT_EQ(read.mesh.materials.size(), 1U);
    EXPECT_DOUBLE_EQ(read.mesh.materials[0].reflectance, 60.0 / 255);
    EXPECT_TRUE(read.mesh.materials[0].is_color);
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    ASSERT_EQ(triangles.size(), 2U);
    EXPECT_EQ(triangles[1], (Triangle{Vec3{0, 0, 3}, Vec3{2, 0, 3}, Vec3{0, 2, 3}}));
}

TEST(ReadVgx, MakesAnOrganOfTrianglesAlikeAndOfEachOtherObject) {
    const ReadMesh read = read_mesh_text(
        "vgx",
        "Obj;X1;Y1;Z1;X2;Y2;Z2;X3;Y3;Z3;Grp1;EchX;EchY;EchZ;TransX;TransY;TransZ;RotX;RotY;RotZ\n"
        "0;0;0;0;1;0;0;0;1;0;7;0;0;0;0;0;0;0;0;0\n"
        "0;0;0;1;1;0;1;0;1;1;7;0;0;0;0;0;0;0;0;0\n"
        "0;0;0;2;1;0;2;0;1;2;8;0;0;0;0;0;0;0;0;0\r\n\n"
        "21;0;0;0;0;0;0;0;0;0;8;1;1;0;0;0;0;0;0;0\n"
        "21;0;0;0;0;0;0;0;0;0;8;1;1;0;0;0;3;0;0;0\n");
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 4U);
    EXPECT_EQ(read.mesh.groups[0].parts[0].faces.size(), 2U);
    EXPECT_EQ(read.mesh.groups[1].labels, (Labels{{"Obj", "0"}, {"Grp1", "8"}}));
    EXPECT_EQ(read.mesh.groups[3].labels, (Labels{{"Obj", "21"}, {"Grp1", "8"}}));
    EXPECT_EQ(read.mesh.groups[3].parts[0].material, "");
    EXPECT_TRUE(read.mesh.materials.empty());
}

TEST(ReadVgx, ScalesTurnsAboutXThenYThenZAndMoves) {
    // A disk 4 long and 2 wide, on its edge, then turned so that its length goes along y.
    const auto disk = triangles_of_vgx("21\t4\t2\t1\t10\t20\t30\t90\t0\t90");
    EXPECT_NEAR(area(disk), 2 * std::numbers::pi, 1e-12) << "an ellipse of diameters 4 and 2";
    const Bounds bounds = bounds_of_all(disk);
    EXPECT_NEAR(bounds.low.x, 10, 1e-12);
    EXPECT_NEAR(bounds.high.x, 10, 1e-12);
    EXPECT_NEAR((bounds.low.y + bounds.high.y) / 2, 22, 1e-12) << "its base is at 20";
    EXPECT_NEAR((bounds.low.z + bounds.high.z) / 2, 30, 1e-12);
    // About y: a part along x points down.
    const auto turned = triangles_of_vgx("32\t5\t1\t1\t0\t0\t0\t0\t90\t0");
    EXPECT_NEAR(bounds_of_all(turned).low.z, -5, 1e-12);
    EXPECT_NEAR(bounds_of_all(turned).high.z, 0, 1e-12);
}

TEST(ReadVgx, DrawsRoundObjects) {
    const auto cylinder = triangles_of_vgx("32\t5\t2\t2\t0\t0\t0\t0\t0\t0");
    EXPECT_NEAR(area(cylinder), std::numbers::pi * 2 * 5, 1e-12) << "open at both ends";
    EXPECT_GT(dot(area_vector(cylinder[0]), cylinder[0][0] - Vec3{2.5, 0, 0}), 0) << "outward";
    EXPECT_NEAR(bounds_of_all(cylinder).low.x, 0, 1e-12);
    EXPECT_NEAR(bounds_of_all(cylinder).high.x, 5, 1e-12);
    const auto sphere = triangles_of_vgx("31\t2\t2\t2\t0\t0\t7\t0\t0\t0");
    EXPECT_NEAR(area(sphere), 4 * std::numbers::pi, 1e-12);
    EXPECT_NEAR((bounds_of_all(sphere).low.z + bounds_of_all(sphere).high.z) / 2, 7, 1e-12);
    const auto cone = triangles_of_vgx("33\t4\t2\t1\t0\t0\t0\t0\t0\t0");
    double widest_base = 0, widest_top = 0;
    for (const Triangle& triangle : cone) {
        for (const Vec3& corner : triangle) {
            (corner.x < 2 ? widest_base : widest_top) =
                std::max(corner.x < 2 ? widest_base : widest_top, std::abs(corner.y));
        }
    }
    EXPECT_NEAR(widest_base / widest_top, 2, 1e-12) << "EchY at the base, EchZ at the end";
}

TEST(ReadVgx, WarnsOfLeavesWithoutAnOutlineAndOfPoints) {
    const ReadMesh read = read_mesh_text(
        "vgx", kVgxHead + vgx_row("11\t6\t2\t1\t0\t0\t0\t0\t0\t0") +
                   vgx_row("40\t0\t0\t0\t0\t0\t0\t0\t0\t0") +
                   vgx_row("13\t3\t1\t1\t0\t0\t0\t0\t0\t0"));
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_NEAR(area(triangles_of(read.mesh)), 2.0 / 3 * (12 + 3), 1e-12);
    EXPECT_EQ(
        read.warnings, (Texts{
                           "file:2: 2 leaves (Obj 11, 12, 13), whose outline is not in the file; "
                           "hexagons as in PlantGL are used, with 2/3 of length x width",
                           "file:3: 1 points (Obj 40), which have no area and are left out"}));
}

TEST(ReadVgx, WarnsOfColoursThatAreNone) {
    const auto read = [](const std::string& colors) {
        return read_mesh_text(
            "vgx", kVgxHead + "21\t1\t1\t1\t0\t0\t0\t0\t0\t0\t" + colors + kNoCorners);
    };
    EXPECT_EQ(read("255\t0\t30").warnings, Texts{});
    for (const char* const bad : {"300\t0\t0", "20\t30\t-1"}) {
        EXPECT_TRUE(
            mentions(read(bad).warnings, "file:2: 1 colours (R, G, B) are not from 0 to 255"))
            << bad;
    }
}

TEST(ReadVgx, ReportsEveryBadLine) {
    const std::string rest = "\t1\t0\t0\t0\t0\t0\t0";
    const ReadMesh read = read_mesh_text(
        "vgx", kVgxHead + vgx_row("22\t1\t1" + rest) + "21\t1\n" + vgx_row("21\t0\t1" + rest) +
                   vgx_row("31\tx\t1" + rest));
    EXPECT_EQ(
        read.faults,
        (Texts{
            "file:2: Obj 22 is not read (only 0, 11 to 13, 21, 31, 32 and 33 are); let PlantGL "
            "make triangles of it: Scene('in.vgx').save('out.obj')",
            "file:3: 2 numbers (the first line has 22 columns)",
            "file:4: EchX 0, EchY 1, EchZ 1 (lengths must be positive)",
            "file:5: EchX is 'x' (it must be a finite number)"}));
    EXPECT_EQ(
        read_mesh_text("vgx", "1 2 3\n").faults,
        (Texts{"file:1: the first line does not contain the columns of a .vgx file (Obj, and EchX "
               "EchY EchZ TransX TransY TransZ RotX RotY RotZ or X1 ... Z3)"}));
    EXPECT_EQ(
        read_mesh_text("vgx", "Obj X1 Obj\n").faults,
        (Texts{"file:1: column 'Obj' is given twice"}));
    EXPECT_EQ(
        read_mesh_text("vgx", "Obj X1 Y1 Z1 X2 Y2 Z2 X3 Y3 Z3\n21 0 0 0 0 0 0 0 0 0\n").faults,
        (Texts{"file:2: Obj 21 is not read (the columns of its position are missing)"}));
}

}  // namespace
}  // namespace quasimc::test
