#include <gtest/gtest.h>

#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

std::string gwa_with(const std::string& find, const std::string& replacement) {
    std::string text = repository_file("tests/fuzz/corpus/gwa/pavement.gwa");
    const std::size_t at = text.find(find);
    EXPECT_NE(at, std::string::npos) << find;
    return text.replace(at, find.size(), replacement);
}

TEST(ReadGwa, MakesAnOrganOfEachMesh) {
    const ReadMesh read = read_mesh_text("gwa", gwa_with("", ""));
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(read.warnings, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    EXPECT_EQ(read.mesh.groups[0].name, "pave");
    EXPECT_EQ(read.mesh.groups[0].id, 2);
    EXPECT_DOUBLE_EQ(area(triangles_of(read.mesh)), 1e4);
    EXPECT_EQ(read.mesh.groups[0].parts[0].material, "color 120 100 50");
    ASSERT_EQ(read.mesh.materials.size(), 1U);
    EXPECT_DOUBLE_EQ(read.mesh.materials[0].reflectance, 270.0 / 3 / 255);
    EXPECT_EQ(
        read_mesh_text("gwa", gwa_with("<Color>Color 120 100 50</Color>", ""))
            .mesh.groups[0]
            .parts[0]
            .material,
        "");
}

TEST(ReadGwa, TellsWhatIsWrong) {
    const auto faults = [](const std::string& find, const std::string& replacement) {
        return read_mesh_text("gwa", gwa_with(find, replacement)).faults;
    };
    EXPECT_EQ(
        faults("0	2	3<", "0	2	4<"),
        Texts{"file:11: a face refers to point 4 (its mesh has 4, counted from 0)"});
    EXPECT_EQ(faults("0	2	3<", "0	2<"), Texts{"file:11: a face with 2 corners"});
    EXPECT_EQ(
        faults("100	0	0	100", "100	x	0	100"),
        Texts{"file:5: 'x' is not a finite number"});
    EXPECT_EQ(
        faults("100	0	0	100", "100	0	100"),
        Texts{"file:5: <points> has 11 numbers (a point is x y z)"});
    EXPECT_EQ(
        read_mesh_text("gwa", "<opf></opf>").faults,
        Texts{"file: it is not a GWA file (its outermost element is not <gwa>)"});
    EXPECT_EQ(read_mesh_text("gwa", "<gwa").faults.size(), 1U);
}

TEST(ReadGwa, TakesLatin1ThatSaysSo) {
    const std::string bad = gwa_with("label=\"pave\"", "label=\"pav\xE9\"");
    EXPECT_TRUE(mentions(read_mesh_text("gwa", bad).faults, "the name 'pav?' is not UTF-8"));
    std::string text =
        "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n" + bad.substr(bad.find("<gwa"));
    const ReadMesh read = read_mesh_text("gwa", text);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    EXPECT_EQ(read.mesh.groups[0].name, "pav\xC3\xA9");
    text.replace(text.find("</faces>"), 0, "<face>0 1</face>");
    EXPECT_TRUE(mentions(read_mesh_text("gwa", text).faults, "a face with 2 corners"));
}

}  // namespace
}  // namespace quasimc::test
