#include <bit>

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

const std::string kStlText =
    "solid a leaf\nfacet normal 0 0 1\n outer loop\n  vertex 0 0 1\n  vertex 1 0 1\n"
    "  vertex 0 1e0 1\n endloop\nendfacet\nendsolid a leaf\n"
    "solid b\r\nfacet normal 0 0 0\r\nouter loop\r\nvertex 0 0 2\r\nvertex 1 0 2\r\nvertex 0 1 "
    "2\r\nendloop\r\nendfacet\r\nendsolid\r\n";

template <typename T>
void put_stl(std::string& bytes, T value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes.append(raw.begin(), raw.end());
}

/// Triangles that lie in planes z = 1, 2, ...
std::string binary_stl(std::uint32_t count) {
    std::string bytes(80, ' ');
    bytes.replace(0, 5, "solid");  // as some programs write it
    put_stl(bytes, count);
    for (std::uint32_t i = 0; i < count; ++i) {
        const float z = static_cast<float>(i + 1);
        for (const float x : {0.F, 0.F, 1.F, 0.F, 0.F, z, 1.F, 0.F, z, 0.F, 1.F, z}) {
            put_stl(bytes, x);
        }
        put_stl(bytes, std::uint16_t{7});
    }
    return bytes;
}

TEST(ReadStl, TakesSolidsOfATextAsGroups) {
    const ReadMesh read = read_mesh_text("stl", kStlText);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].name, "a leaf");
    EXPECT_EQ(read.mesh.groups[1].name, "b");
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    ASSERT_EQ(triangles.size(), 2U);
    EXPECT_EQ(triangles[0], (Triangle{Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}));
    EXPECT_EQ(triangles[1], (Triangle{Vec3{0, 0, 2}, Vec3{1, 0, 2}, Vec3{0, 1, 2}}));
}

TEST(ReadStl, TakesBinaryFilesEvenIfTheyBeginWithSolid) {
    const ReadMesh read = read_mesh_text("stl", binary_stl(3));
    EXPECT_EQ(read.faults, Texts{});
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    ASSERT_EQ(triangles.size(), 3U);
    EXPECT_EQ(triangles[2], (Triangle{Vec3{0, 0, 3}, Vec3{1, 0, 3}, Vec3{0, 1, 3}}));
}

TEST(ReadStl, RefusesBinaryFilesThatAreCutShort) {
    const std::string whole = binary_stl(3);
    const ReadMesh read = read_mesh_text("stl", whole.substr(0, whole.size() - 1));
    EXPECT_EQ(
        read.faults, (Texts{"file: is not an STL file (a binary one has 50 bytes for each triangle "
                            "counted at byte 81)"}));
}

TEST(ReadStl, ReportsEveryFault) {
    const std::string rule = " (a facet must have one loop of three vertices)";
    const ReadMesh read = read_mesh_text(
        "stl",
        "solid\nouter loop\nvertex 0 0\nvertex 0 0 x\nvertex 1 1 1\nendloop\nwhat\nouter loop\n");
    EXPECT_EQ(
        read.faults, (Texts{
                         "file:3: a vertex with 2 numbers" + rule,
                         "file:4: 'x' is not a finite number (a vertex is x y z)",
                         "file:6: a loop with 1 vertices" + rule,
                         "file:7: 'what' is not an STL statement" + rule,
                         "file:8: the file ends within a loop" + rule}));
    std::string bytes = binary_stl(1);
    bytes.replace(84 + 12, 4, "\xff\xff\xff\xff");
    EXPECT_EQ(
        read_mesh_text("stl", bytes).faults, (Texts{"file: triangle 1: a corner is not finite"}));
}

TEST(ReadStl, SaysWhereATextIsCutShort) {
    const std::string solid = "solid a\n";
    const std::string facet =
        "facet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 1 1\nendloop\n"
        "endfacet\n";
    const ReadMesh cut = read_mesh_text("stl", solid + facet);
    EXPECT_EQ(cut.faults, Texts{});
    EXPECT_TRUE(mentions(cut.warnings, "file:8: the file ends without endsolid"));
    EXPECT_EQ(read_mesh_text("stl", solid + facet + "endsolid a\n\n").warnings, Texts{});
    std::string open = facet;
    open.replace(open.find("endloop\n"), 8, "");
    EXPECT_TRUE(mentions(
        read_mesh_text("stl", solid + open + facet + "endsolid\n").faults,
        "file:9: a loop begins before the previous one ends"));
}

}  // namespace
}  // namespace quasimc::test
