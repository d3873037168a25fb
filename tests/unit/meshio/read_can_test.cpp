#include <gtest/gtest.h>

#include "meshio/can_label.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

const std::string kCanRule = " (a line contains p 1 LABEL 3 and x y z of three corners)";

TEST(CanLabel, IsSpeciesPlantLeafElement) {
    const CanLabel label = can_label(110010000001);
    EXPECT_EQ(label, (CanLabel{.species = 1, .plant = 10010, .leaf = 0, .element = 1}));
    EXPECT_EQ(label.number(), 110010000001);
    EXPECT_EQ(label.material(), "stem 1");
    EXPECT_EQ(can_label(1).material(), "soil");
    EXPECT_EQ(
        (CanLabel{.species = 12, .plant = 3, .leaf = 45, .element = 6}).number(), 1200003045006);
    EXPECT_EQ(can_label(1200003045006).material(), "leaf 12");
    for (const char* word : {"", "1.5", "-1", "a", "1234567890123456"}) {
        EXPECT_FALSE(can_label_number(word)) << word;
    }
}

TEST(ReadCan, MakesAnOrganOfEachLabel) {
    const ReadMesh read = read_mesh_text(
        "can",
        "#1 a stand\r\n"
        "p  1 100007002001 3 \t 0 0 1 1 0 1 0 1 1\n"
        "p 1 100007000001 3  0 0 2 1 0 2 0 1 2 # stem\n"
        "p 2 100007002001 99 4  0 0 3  1 0 3  1 1 3  0 1 3\n");
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    const MeshGroup& leaf = read.mesh.groups[0];
    EXPECT_EQ(leaf.id, 100007002001);
    EXPECT_EQ(leaf.name, "100007002001");
    EXPECT_EQ(
        leaf.labels, (Labels{{"species", "1"}, {"plant", "7"}, {"leaf", "2"}, {"element", "1"}}));
    EXPECT_EQ(leaf.parts[0].material, "leaf 1");
    EXPECT_EQ(leaf.parts[0].faces.size(), 3U) << "a triangle, and a square cut in two";
    EXPECT_EQ(leaf.parts[0].lines, (std::vector<std::uint32_t>{2, 4, 4}));
    EXPECT_EQ(read.mesh.groups[1].parts[0].material, "stem 1");
}

TEST(ReadCan, LabelsReachTheScene) {
    RunText text;
    text.organs =
        "[[geometry]]\nfile = 'a.can'\nlabels = { plant = 'mine', plot = 4 }\nmaterials = { 'leaf "
        "1' = 'leaf' }\n";
    const Scene scene =
        read_text(text.text(), {{"a.can", "p 1 100007002001 3 0 0 1 1 0 1 0 1 1\n"}}).scene;
    ASSERT_EQ(scene.organs().size(), 1U);
    EXPECT_EQ(scene.organs()[0].id, 100007002001);
    EXPECT_EQ(
        scene.organs()[0].labels,
        (Labels{
            {"plant", "mine"}, {"plot", "4"}, {"species", "1"}, {"leaf", "2"}, {"element", "1"}}));
}

TEST(ReadCan, ReportsEveryBadLine) {
    const ReadMesh read = read_mesh_text(
        "can",
        "q 1 1 3 0 0 1 1 0 1 0 1 1\np 1 1 3 0 0 1 1 0 1 0 1\np 1 leaf 3 0 0 1 1 0 1 0 1 1\n"
        "p 1 1 3 0 0 1 1 0 1 0 1 x\np 0 1 3 0 0 1 1 0 1 0 1 1\np 1 1 2 0 0 1 1 0 1\n");
    EXPECT_EQ(
        read.faults, (Texts{
                         "file:1: 'q' is not a polygon with a label" + kCanRule,
                         "file:2: 8 coordinates of 3 corners" + kCanRule,
                         "file:3: 'leaf' is not a label (a label has up to 15 digits: species, "
                         "plant (5), leaf (3), element (3))",
                         "file:4: 'x' is not a finite number" + kCanRule,
                         "file:5: 'p' is not a polygon with a label" + kCanRule,
                         "file:6: 6 coordinates of 2 corners" + kCanRule}));
}

}  // namespace
}  // namespace quasimc::test
