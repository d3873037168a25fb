#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "base/text.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

const Triangle kFirst{Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}};

TEST(ReadTri, TakesNineNumbersALine) {
    const ReadMesh read = read_mesh_text("tri", "0 0 1 1 0 1 0 1 1\n1 2 3 4 5 6 7 8 9.5\n");
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(triangles_of(read.mesh).size(), 2U);
    EXPECT_EQ(triangles_of(read.mesh)[0], kFirst);
    EXPECT_EQ(triangles_of(read.mesh)[1][2], (Vec3{7, 8, 9.5}));
}

TEST(ReadTri, PassesOverCommentsBlankLinesAndCarriageReturns) {
    const ReadMesh read = read_mesh_text(
        "tri", "\xEF\xBB\xBF# made by hand\r\n\r\n \t 0 0 1  1 0 1\t0 1 1 # first\r\n\n");
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(triangles_of(read.mesh).size(), 1U);
    EXPECT_EQ(triangles_of(read.mesh)[0], kFirst);
    EXPECT_EQ(read.mesh.groups[0].parts[0].lines, (std::vector<std::uint32_t>{3}));
}

TEST(ReadTri, NeedsNoLineBreakAtTheEnd) {
    EXPECT_EQ(triangles_of(read_mesh_text("tri", "0 0 1 1 0 1 0 1 1").mesh).size(), 1U);
}

TEST(ReadTri, ReportsEveryBadLine) {
    const ReadMesh read = read_mesh_text(
        "tri",
        "0 0 1 1 0 1 0 1\n0 0 1 1 0 1 0 1 1\n0 0 1 1 0 1 0 1 x\n0 0 1 1 0 1 0 1 nan\n"
        "0 0 1 1 0 1 0 1 1 1\n0 0 1 1 0 1 0 1 1e999\n");
    const std::string rule = " (a line contains nine numbers: x y z of three corners)";
    EXPECT_EQ(
        read.faults, (Texts{
                         "file:1: 8 numbers" + rule, "file:3: 'x' is not a finite number" + rule,
                         "file:4: 'nan' is not a finite number" + rule, "file:5: 10 numbers" + rule,
                         "file:6: '1e999' is not a finite number" + rule}));
}

TEST(ReadTri, StopsAfterAHundredFaults) {
    std::string bytes;
    for (int i = 0; i < 100000; ++i) {
        bytes += "what?\n";
    }
    EXPECT_EQ(read_mesh_text("tri", bytes).faults.size(), 100U);
}

TEST(ReadTri, ShowsBinaryRubbishHarmlessly) {
    const ReadMesh read = read_mesh_text("tri", std::string("\x7F\x45LF\x00\x1b[2J", 8));
    ASSERT_EQ(read.faults.size(), 1U);
    EXPECT_EQ(read.faults[0].substr(0, 8), "file:1: ");
    EXPECT_EQ(read.faults[0].find('\x1b'), std::string::npos);
}

RC_GTEST_PROP(ReadTri, ReadsBackEveryDigit, (const std::vector<std::array<double, 9>>& rows)) {
    std::string bytes;
    for (const auto& row : rows) {
        for (const double x : row) {
            bytes += shortest(x) + " ";
        }
        bytes += "\n";
    }
    const ReadMesh read = read_mesh_text("tri", bytes);
    RC_ASSERT(read.faults.empty());
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    RC_ASSERT(triangles.size() == rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        RC_ASSERT(triangles[i][2] == (Vec3{rows[i][6], rows[i][7], rows[i][8]}));
    }
}

}  // namespace
}  // namespace quasimc::test
