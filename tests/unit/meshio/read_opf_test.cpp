#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// A stem that tapers from 2 to 1 and a leaf on it, as AMAP's programs write them.
std::string opf_text() {
    return R"(<?xml version="1.0" encoding="UTF-8" ?>
<opf version="2.0" editable="true">
  <meshBDD>
    <mesh name="" shape="" Id="0" enableScale="true" >
      <points> 0 1 0	0 0 1	2 1 0 </points>
      <normals> 0 0 1 0 0 1 0 0 1 </normals>
      <faces><face Id="0"> 0 1	2 </face></faces>
    </mesh>
    <mesh name="" shape="" Id="1" enableScale="false" >
      <points>0 0 0 1 0 0 1 1 0 0 1 0</points>
      <faces><face Id="0">0 1 2 3</face></faces>
    </mesh>
  </meshBDD>
  <materialBDD>
    <material Id="4"><diffuse>0.1	0.2	0.3	1.0	</diffuse></material>
  </materialBDD>
  <shapeBDD>
    <shape Id="0"><name> Stem</name><meshIndex>0</meshIndex></shape>
    <shape Id="7"><name> Leaf</name><meshIndex>1</meshIndex><materialIndex>4</materialIndex></shape>
  </shapeBDD>
  <attributeBDD><attribute name="Name" class="String"/></attributeBDD>
  <topology class="Individual" scale="1" id="1">
    <Name>tree</Name>
    <geometry class="Mesh"><mat>1 0 0 0 0 1 0 0 0 0 1 0</mat></geometry>
    <decomp class="Metamer" scale="6" id="2">
      <Name>A &amp; B</Name>
      <geometry class="Mesh"><shapeIndex>0</shapeIndex>
        <mat>0 0 1 10  0 1 0 0  -1 0 0 5</mat><dUp>1</dUp><dDwn>2</dDwn></geometry>
      <branch class="Leaf" scale="6" id="3">
        <geometry class="Mesh"><shapeIndex>7</shapeIndex>
          <mat>3 0 0 0  0 3 0 0  0 0 3 8</mat><dUp>9</dUp><dDwn>9</dDwn></geometry>
        <Area>9.0</Area>
      </branch>
    </decomp>
  </topology>
</opf>
)";
}

std::string opf_with(const std::string& find, const std::string& replacement) {
    std::string text = opf_text();
    const std::size_t at = text.find(find);
    EXPECT_NE(at, std::string::npos) << find;
    return text.replace(at, find.size(), replacement);
}

TEST(ReadOpf, MakesAnOrganOfEachNodeWithAShape) {
    const ReadMesh read = read_mesh_text("opf", opf_text());
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    const MeshGroup& stem = read.mesh.groups[0];
    EXPECT_EQ(stem.name, "A & B");
    EXPECT_EQ(stem.id, 2);
    EXPECT_EQ(stem.labels, (Labels{{"class", "Metamer"}, {"scale", "6"}, {"Name", "A & B"}}));
    EXPECT_EQ(stem.parts[0].material, "");
    const MeshGroup& leaf = read.mesh.groups[1];
    EXPECT_EQ(leaf.name, "Leaf 3");
    EXPECT_EQ(leaf.labels, (Labels{{"class", "Leaf"}, {"scale", "6"}, {"Area", "9.0"}}));
    EXPECT_EQ(leaf.parts[0].material, "material 4");
    ASSERT_EQ(read.mesh.materials.size(), 1U);
    EXPECT_DOUBLE_EQ(read.mesh.materials[0].reflectance, 0.2);
}

TEST(ReadOpf, ScalesMeshesThatDoNotSayThatTheyAreNot) {
    const auto area_with = [](const std::string& attribute) {
        return area(triangles_of(
            read_mesh_text("opf", opf_with(" enableScale=\"false\"", attribute)).mesh));
    };
    const double kept = area_with(" enableScale=\"false\"");
    // The leaf of a square of 3 by 3 has a diameter of 9.
    EXPECT_NEAR(area_with(""), kept + 8 * 9, 1e-9);
    EXPECT_NEAR(area_with(" enableScale=\"true\""), kept + 8 * 9, 1e-9);
    // Without a girth and without the attribute, a mesh keeps its size.
    std::string text = opf_with(" enableScale=\"false\"", "");
    text.replace(text.find("<dUp>9</dUp>"), 12, "<dUp>NaN</dUp>");
    const ReadMesh read = read_mesh_text("opf", text);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_NEAR(area(triangles_of(read.mesh)), kept, 1e-9);
    EXPECT_TRUE(mentions(read.warnings, "1 nodes have no finite <dDwn> and <dUp>"));
}

TEST(ReadOpf, TapersScaledMeshesAndMovesAll) {
    const std::vector<Triangle> triangles = triangles_of(read_mesh_text("opf", opf_text()).mesh);
    ASSERT_EQ(triangles.size(), 3U);
    // (0, 2, 0), (0, 0, 2), (2, 1, 0) before the matrix: girth 2 where x is least, 1 where it is
    // largest.
    EXPECT_EQ(triangles[0], (Triangle{Vec3{10, 2, 5}, Vec3{12, 0, 5}, Vec3{10, 1, 3}}));
    EXPECT_DOUBLE_EQ(area(triangles[1]) + area(triangles[2]), 9) << "a leaf is not scaled";
    EXPECT_EQ(triangles[1][0].z, 8);
}

TEST(ReadOpf, TellsFaultsByTheirLines) {
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("0 1 2 3", "0 1 2 4")).faults,
        (Texts{"file:11: a face refers to point 4 (its mesh has 4, counted from 0)"}));
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("0 0 3 8<", "0 0 3<")).faults,
        (Texts{"file:31: <mat> has 11 numbers (it must have three rows of four)"}));
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("<shapeIndex>7", "<shapeIndex>6")).faults,
        (Texts{"file:30: there is no shape 6 with a mesh (<shapeBDD> and <meshBDD> must come "
               "before <topology>)"}));
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("<dUp>1<", "<dUp>one<")).faults,
        (Texts{"file:27: <dDwn> or <dUp> is not a finite number (the shape's mesh is scaled by "
               "them (enableScale))"}));
    EXPECT_EQ(read_mesh_text("opf", opf_with("<dUp>9<", "<dUp>NaN<")).faults, Texts{});
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("id=\"3\"", "id=\"x\"")).faults,
        (Texts{"file:29: <branch> without a number as its id"}));
}

TEST(ReadOpf, RefusesTwoMeshesOfOneId) {
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("Id=\"1\" enableScale", "Id=\"0\" enableScale")).faults,
        (Texts{
            "file:9: its Id 0 is used by another mesh",
            "file:30: there is no shape 7 with a mesh (<shapeBDD> and <meshBDD> must come before "
            "<topology>)"}));
}

TEST(ReadOpf, TellsWhatIsNoXml) {
    EXPECT_EQ(
        read_mesh_text("opf", opf_with("</branch>", "</follow>")).faults,
        (Texts{"file:33: Start-end tags mismatch (it is not XML)"}));
    const std::string text = opf_text();
    EXPECT_EQ(
        read_mesh_text("opf", text.substr(0, text.find("</topology>"))).faults,
        (Texts{"file:35: Start-end tags mismatch (it is not XML)"}));
    EXPECT_EQ(
        read_mesh_text("opf", text + "<opf></opf>").faults,
        (Texts{"file:37: a second root element (it is not XML)"}));
    EXPECT_EQ(
        read_mesh_text("opf", text + std::string(1, '\0')).faults,
        (Texts{"file:37: a byte is 0 (it is not XML); save the file as UTF-8"}));
    EXPECT_EQ(
        read_mesh_text("opf", "<opf></opf>").faults,
        (Texts{"file: has no <topology> (it is not an OPF file)"}));
}

TEST(ReadOpf, ReplacesTheEntitiesOfXmlAndNoOthers) {
    const std::string declared = "<!DOCTYPE opf [<!ENTITY big \"&gt;&gt;\">]>";
    std::string text = opf_with("A &amp; B", "&lt;&#228;&big;<!-- of no meaning -->&gt;");
    text.insert(text.find("<opf"), declared);
    const ReadMesh read = read_mesh_text("opf", text);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].name, "<\xC3\xA4&big;>");
}

/// Depth is data, not stack.
TEST(ReadOpf, TakesNodesWithinNodesWithoutEnd) {
    std::string text = "<topology id=\"0\">";
    constexpr int kDepth = 100000;
    for (int i = 0; i < kDepth; ++i) {
        text += "<branch id=\"1\">";
    }
    EXPECT_EQ(read_mesh_text("opf", text).faults.size(), 1U);
    for (int i = 0; i < kDepth; ++i) {
        text += "</branch>";
    }
    EXPECT_EQ(read_mesh_text("opf", text + "</topology>").faults, Texts{});
}

}  // namespace
}  // namespace quasimc::test
