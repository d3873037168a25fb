#include <algorithm>
#include <bit>

#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

std::string header(
    const std::string& format, int vertices, int faces, const std::string& more = {}) {
    return "ply\nformat " + format + " 1.0\ncomment by hand\nelement vertex " +
           std::to_string(vertices) +
           "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
           std::to_string(faces) + "\nproperty list uchar int vertex_indices\n" + more +
           "end_header\n";
}

const std::string kCorners = "0 0 1\n1 0 1\n1 1 1\n0 1 1\n";

template <typename T>
std::string raw(T value, bool little) {
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (little != (std::endian::native == std::endian::little)) {
        std::reverse(bytes.begin(), bytes.end());
    }
    return {bytes.begin(), bytes.end()};
}

std::string binary_square(bool little) {
    std::string bytes = header(little ? "binary_little_endian" : "binary_big_endian", 4, 1);
    for (const float x : {0.F, 0.F, 1.F, 1.F, 0.F, 1.F, 1.F, 1.F, 1.F, 0.F, 1.F, 1.F}) {
        bytes += raw(x, little);
    }
    bytes += '\4';
    for (const std::int32_t i : {0, 1, 2, 3}) {
        bytes += raw(i, little);
    }
    return bytes;
}

TEST(ReadPly, TakesTextAndBothKindsOfBinary) {
    for (const std::string& bytes :
         {header("ascii", 4, 1) + kCorners + "4 0 1 2 3\n", binary_square(true),
          binary_square(false)}) {
        const ReadMesh read = read_mesh_text("ply", bytes);
        EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
        const std::vector<Triangle> triangles = triangles_of(read.mesh);
        ASSERT_EQ(triangles.size(), 2U);
        EXPECT_DOUBLE_EQ(area(triangles), 1);
        EXPECT_EQ(triangles[0][0].z, 1);
    }
}

TEST(ReadPly, FacesOfOneNumberAreOneOrgan) {
    const ReadMesh read = read_mesh_text(
        "ply", header("ascii", 4, 3, "property int organ\nproperty uchar material\n") + kCorners +
                   "3 0 1 2 7 0\n3 0 2 3 9 0\n3 0 1 3 7 1\n");
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].id, 7);
    ASSERT_EQ(read.mesh.groups[0].parts.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].parts[1].material, "1");
    EXPECT_EQ(read.mesh.groups[0].parts[1].lines, (std::vector<std::uint32_t>{3}));
    EXPECT_EQ(read.mesh.groups[1].id, 9);
}

/// The materials of two faces of the numbers 0 and 1, after these comments.
std::vector<std::string> named_materials(const std::string& comments) {
    std::string bytes =
        header("ascii", 4, 2, "property uchar material\n") + kCorners + "3 0 1 2 0\n3 0 2 3 1\n";
    bytes.insert(bytes.find("element"), comments);
    const ReadMesh read = read_mesh_text("ply", bytes);
    EXPECT_TRUE(read.faults.empty());
    std::vector<std::string> names;
    for (const MeshPart& part : read.mesh.groups.at(0).parts) {
        names.push_back(part.material);
    }
    return names;
}

TEST(ReadPly, TellsMaterialsApartByTheirNumbers) {
    using Names = std::vector<std::string>;
    EXPECT_EQ(
        named_materials("comment material 0 = leaf\ncomment material 1 = stem\n"),
        (Names{"leaf", "stem"}));
    EXPECT_EQ(
        named_materials("comment material 0 = leaf\ncomment material 1 = leaf\n"),
        (Names{"0", "1"}));
    EXPECT_EQ(named_materials("comment material 0 = 1\n"), (Names{"0", "1"}));
    EXPECT_EQ(
        named_materials("comment material 0 = 1\ncomment material 1 = 0\n"), (Names{"1", "0"}));
}

TEST(ReadPly, ASharedNameGivesAllItsMaterials) {
    std::string bytes =
        header("ascii", 4, 2, "property uchar material\n") + kCorners + "3 0 1 2 0\n3 0 2 3 1\n";
    bytes.insert(bytes.find("element"), "comment material 0 = leaf\ncomment material 1 = leaf\n");
    RunText text;
    text.organs = "[[geometry]]\nfile = 'a.ply'\n";
    EXPECT_EQ(read_text(text.text(), {{"a.ply", bytes}}).scene.regions().size(), 1U);
    text.materials += "[[material]]\nname = 'white'\nreflectance = 1\n";
    text.organs += "materials = { '0' = 'white', '1' = 'leaf' }\n";
    const Scene scene = read_text(text.text(), {{"a.ply", bytes}}).scene;
    ASSERT_EQ(scene.regions().size(), 2U);
    EXPECT_EQ(scene.material_name(scene.regions()[0]), "white");
    EXPECT_EQ(scene.material_name(scene.regions()[1]), "leaf");
}

TEST(ReadPly, PassesOverWhatItDoesNotKnow) {
    const ReadMesh read = read_mesh_text(
        "ply",
        "ply\r\nformat ascii 1.0\r\nelement vertex 3\r\nproperty uchar red\r\nproperty double x\r\n"
        "property double y\r\nproperty list uchar float more\r\nproperty double z\r\nelement edge "
        "1\r\n"
        "property int a\r\nelement face 1\r\nproperty list uchar uint "
        "vertex_index\r\nend_header\r\n"
        "255 0 0 2 8 8 1\r\n255 1 0 0 1\r\n255 0 1 1 9 1\r\n5\r\n3 0 1 2\r\n");
    EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
    ASSERT_EQ(triangles_of(read.mesh).size(), 1U);
    EXPECT_EQ(triangles_of(read.mesh)[0][2], (Vec3{0, 1, 1}));
}

struct BadPly {
    std::string bytes, problem;
};

TEST(ReadPly, RefusesWhatIsWrong) {
    const std::string binary = binary_square(true);
    const std::vector<BadPly> table{
        {"", "file:1: the first line is not 'ply'"},
        {"plyx\n", "the first line is not 'ply'"},
        {"ply\nformat ascii 1.0\n", "the header has no end"},
        {"ply\nformat ascii 2.0\nend_header\n", "file:2: 'ascii' is not a known format"},
        {"ply\nformat text 1.0\nend_header\n", "'text' is not a known format"},
        {"ply\nend_header\n", "its header has no vertex with x, y and z"},
        {"ply\nproperty float x\nend_header\n", "a property comes before any element"},
        {"ply\nelement vertex -3\nend_header\n", "'-3' is not a number of elements"},
        {"ply\nelement vertex many\nend_header\n", "'many' is not a number of elements"},
        {"ply\nelement vertex 99999999999999999999\nend_header\n", "is not a number of elements"},
        {"ply\nelement vertex 3\nproperty real x\nend_header\n", "'real' is not a PLY type"},
        {"ply\nelement vertex 3\nproperty list int real x\nend_header\n",
         "'real' is not a PLY type"},
        {"ply\nelephant\nend_header\n", "'elephant' is not a line of a PLY header"},
        {"ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty "
         "float z\nend_header\n",
         "its header has no face with vertex_indices"},
        {"ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_indices\nelement "
         "vertex 0\n"
         "property float x\nproperty float y\nproperty float z\nend_header\n",
         "faces come before vertices"},
        {header("ascii", 4, 2) + kCorners + "4 0 1 2 3\n", "face 2 is incomplete or not a number"},
        {header("ascii", 5, 1) + kCorners, "vertex 5 is incomplete or not a number"},
        {header("ascii", 4, 1) + "0 0 1\n1 0 one\n", "vertex 2 is incomplete or not a number"},
        {header("ascii", 4, 1) + "0 0 nan\n1 0 1\n1 1 1\n0 1 1\n3 0 1 2\n",
         "vertex 1 is not finite"},
        {header("ascii", 4, 1) + kCorners + "2 0 1\n", "face 1 has 2 corners"},
        {header("ascii", 4, 1) + kCorners + "3 0 1 4\n",
         "face 1 refers to vertex 4 (there are 4, counted from 0)"},
        {header("ascii", 4, 1) + kCorners + "3 0 1 -1\n", "face 1 refers to vertex -1"},
        {header("ascii", 4, 1) + kCorners + "3 0 1 1.5\n", "face 1 refers to vertex 1.5"},
        {header("ascii", 4, 1) + kCorners + "-3 0 1 2\n", "face 1 has a list of -3"},
        {header("ascii", 4, 1) + kCorners + "1000000000 0 1 2\n",
         "face 1 has a list of 1000000000"},
        {header("ascii", 4, 1, "property float organ\n") + kCorners + "3 0 1 2 0.5\n",
         "organ is 0.5"},
        {binary.substr(0, binary.size() - 1), "face 1 is incomplete"},
        {binary.substr(0, binary.size() - 20), "vertex 4 is incomplete"},
    };
    for (const BadPly& bad : table) {
        const ReadMesh read = read_mesh_text("ply", bad.bytes);
        EXPECT_TRUE(mentions(read.faults, bad.problem)) << bad.problem << "\n"
                                                        << ::testing::PrintToString(read.faults);
        EXPECT_EQ(read.faults.size(), 1U) << bad.problem;
    }
}

TEST(ReadPly, DoesNotTrustTheCountsOfItsHeader) {
    const std::string lies =
        "ply\nformat binary_little_endian 1.0\nelement ghost 9223372036854775807\n"
        "element vertex 9000000000000000000\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 9000000000000000000\nproperty list uchar int vertex_indices\nend_header\n";
    EXPECT_TRUE(mentions(
        read_mesh_text("ply", lies + std::string(24, '\0')).faults, "vertex 3 is incomplete"));
}

TEST(ReadPly, WarnsOfWhatFollowsTheLastElement) {
    const std::string square = header("ascii", 4, 1) + kCorners;
    const auto warnings = [](const std::string& bytes) {
        const ReadMesh read = read_mesh_text("ply", bytes);
        EXPECT_TRUE(read.faults.empty()) << ::testing::PrintToString(read.faults);
        return read.warnings;
    };
    EXPECT_TRUE(mentions(
        warnings(square + "3 0 1 2\n3 0 2 3\n"),
        "there is more data after the last element of the header (4 words)"));
    EXPECT_TRUE(mentions(
        warnings(square + "3 0 1 2 3\n"),
        "there is more data after the last element of the header (1 word)"));
    EXPECT_TRUE(mentions(
        warnings(binary_square(true) + "more"),
        "there is more data after the last element of the header (4 bytes)"));
    for (const std::string end : {"", "\n\n", " \t\r\n", "comment by hand\n"}) {
        EXPECT_TRUE(warnings(square + "4 0 1 2 3\n" + end).empty()) << end;
    }
    EXPECT_TRUE(warnings(binary_square(false) + std::string("\n\0\0", 3)).empty());
    const std::string strips =
        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    std::string with_strips = header("ascii", 4, 1);
    with_strips.replace(with_strips.find("end_header\n"), 11, strips);
    EXPECT_TRUE(mentions(
        warnings(with_strips + kCorners + "3 0 1 2\n4 0 1 2 3\n"),
        "elements 'tristrips' have corners and are left out (1 in total)"));
}

TEST(ReadPly, RefusesAHeaderThatSaysTheSameTwice) {
    const std::string text = header("ascii", 4, 1);
    const std::string vertex = "element vertex 4\nproperty float x\n";
    std::string twice = text;
    twice.insert(twice.find("element face"), vertex);
    EXPECT_TRUE(mentions(
        read_mesh_text("ply", twice + kCorners + kCorners + "4 0 1 2 3\n").faults,
        "file:8: element 'vertex' is given twice"));
    std::string two_x = text;
    two_x.insert(two_x.find("property float y"), "property double x\n");
    EXPECT_TRUE(mentions(read_mesh_text("ply", two_x).faults, "'vertex' has property 'x' twice"));
}

}  // namespace
}  // namespace quasimc::test
