// What is special to the format @words@; formats_test.cpp tries it like every format.

#include <gtest/gtest.h>

#include "unit/io/io_testing.h"

namespace quasimc::test {
namespace {

TEST(Read@Name@, TakesATriangleALine) {
    const ReadMesh read = read_mesh_text("@name@", "0 0 1 1 0 1 0 1 1 // first\n\n");
    EXPECT_TRUE(read.faults.empty());
    ASSERT_EQ(triangles_of(read.mesh).size(), 1U);
    EXPECT_EQ(triangles_of(read.mesh)[0], (Triangle{Vec3{0, 0, 1}, Vec3{1, 0, 1}, Vec3{0, 1, 1}}));
}

TEST(Read@Name@, ReportsEveryBadLine) {
    const ReadMesh read = read_mesh_text("@name@", "0 0 1 1 0 1 0 1\n0 0 1 1 0 1 0 1 x\n");
    ASSERT_EQ(read.faults.size(), 2U);
    EXPECT_EQ(
        read.faults[1],
        "file:2: it does not hold nine finite numbers (a line holds x y z of three corners)");
}

}  // namespace
}  // namespace quasimc::test
