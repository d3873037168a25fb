// COLLADA: what Blender, SketchUp and assimp write, and what is broken in it.

#include <gtest/gtest.h>

#include "io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

/// COLLADA in a few words: a geometry "blade" of the square (0, 0) to (2, 2) at z = 1.
struct DaeText {
    std::string asset = "<asset><unit name=\"meter\" meter=\"1\"/><up_axis>Z_UP</up_axis></asset>";
    std::string array = "0 0 1 2 0 1 0 2 1 2 2 1";
    std::string primitive =
        "<triangles count=\"1\" material=\"m\">\n<input semantic=\"VERTEX\" source=\"#v\" "
        "offset=\"0\"/>\n<input semantic=\"NORMAL\" source=\"#n\" offset=\"1\"/>\n"
        "<p>0 0 1 0 2 0</p></triangles>";
    std::string nodes =
        "<node id=\"leaf-node\" name=\"leaf\"><instance_geometry url=\"#g\"/></node>";
    std::string more;

    [[nodiscard]] std::string text() const {
        return "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<COLLADA version=\"1.4.1\">\n" + asset +
               "\n<library_geometries><geometry id=\"g\" name=\"blade\"><mesh>\n"
               "<source id=\"s\"><float_array id=\"a\" count=\"12\">" +
               array +
               "</float_array>\n<technique_common><accessor source=\"#a\" count=\"4\" "
               "stride=\"3\"/></technique_common></source>\n<vertices id=\"v\"><input "
               "semantic=\"POSITION\" source=\"#s\"/></vertices>\n" +
               primitive + "\n</mesh></geometry></library_geometries>\n" + more +
               "\n<library_visual_scenes><visual_scene id=\"x\">" + nodes +
               "</visual_scene></library_visual_scenes>\n"
               "<scene><instance_visual_scene url=\"#x\"/></scene>\n</COLLADA>\n";
    }
};

ReadMesh read_dae_text(const DaeText& dae) {
    return read_mesh_text("dae", dae.text());
}

const Triangle kDaeFirst{Vec3{0, 0, 1}, Vec3{2, 0, 1}, Vec3{0, 2, 1}};

TEST(ReadDae, MakesAnOrganOfANodeWithAGeometry) {
    const ReadMesh read = read_dae_text({});
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(read.warnings, Texts{});
    EXPECT_EQ(triangles_of(read.mesh), std::vector<Triangle>{kDaeFirst});
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    EXPECT_EQ(read.mesh.groups[0].name, "leaf");
    EXPECT_EQ(read.mesh.groups[0].labels, (Labels{{"mesh", "blade"}}));
    EXPECT_EQ(read.mesh.groups[0].parts[0].material, "m");
}

TEST(ReadDae, TakesEveryKindOfFaces) {
    const auto triangles = [](const std::string& primitive) {
        DaeText dae;
        dae.primitive = primitive;
        const ReadMesh read = read_dae_text(dae);
        EXPECT_EQ(read.faults, Texts{}) << primitive;
        return triangles_of(read.mesh);
    };
    const std::string input = "<input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/>";
    const Triangle second{Vec3{2, 0, 1}, Vec3{2, 2, 1}, Vec3{0, 2, 1}};
    const std::vector<Triangle> both{kDaeFirst, second};
    EXPECT_EQ(triangles("<triangles>" + input + "<p>0 1 2 1 3 2</p></triangles>"), both);
    EXPECT_EQ(triangles("<tristrips>" + input + "<p>0 1 2 3</p></tristrips>").size(), 2U);
    EXPECT_EQ(triangles("<trifans>" + input + "<p>0 1 3 2</p></trifans>").size(), 2U);
    EXPECT_EQ(
        triangles("<polylist>" + input + "<vcount>3 3</vcount><p>0 1 2 1 3 2</p></polylist>"),
        both);
    EXPECT_EQ(triangles("<polygons>" + input + "<p>0 1 2</p><p>1 3 2</p></polygons>"), both);
    EXPECT_EQ(
        triangles("<polylist>" + input + "<vcount>4</vcount><p>0 1 3 2</p></polylist>").size(), 2U);
}

TEST(ReadDae, PlacesNodesByAllThatIsAboveThem) {
    DaeText dae;
    dae.nodes =
        "<node id=\"plant\"><translate>10 0 0</translate><rotate>0 0 1 90</rotate>"
        "<scale>1 2 1</scale><node name=\"leaf\"><matrix>1 0 0 5 0 1 0 0 0 0 1 0 0 0 0 1</matrix>"
        "<instance_geometry url=\"#g\"/></node><instance_node url=\"#spare\"/></node>";
    dae.more =
        "<library_nodes><node id=\"spare\"><instance_geometry url=\"#g\"/></node></library_nodes>";
    const ReadMesh read = read_dae_text(dae);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].labels, (Labels{{"parent", "plant"}, {"mesh", "blade"}}));
    EXPECT_EQ(read.mesh.groups[1].name, "spare");
    // (0, 0, 1) moved by 5, stretched, turned from x to y, and moved again.
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    EXPECT_LT(length(triangles[0][0] - Vec3{10, 5, 1}), 1e-12);
    EXPECT_LT(length(triangles[0][2] - Vec3{6, 5, 1}), 1e-12);
    EXPECT_LT(length(triangles[1][1] - Vec3{10, 2, 1}), 1e-12);
}

TEST(ReadDae, LooksWhereACameraLooks) {
    DaeText dae;
    dae.nodes =
        "<node name=\"a\"><lookat>1 2 3 1 2 0 0 1 0</lookat><instance_geometry "
        "url=\"#g\"/></node>";
    const ReadMesh read = read_dae_text(dae);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_LT(length(triangles_of(read.mesh)[0][1] - Vec3{3, 2, 4}), 1e-12);
}

TEST(ReadDae, KeepsTheFrontOfAMirroredNode) {
    DaeText dae;
    dae.nodes = "<node name=\"a\"><scale>-1 1 1</scale><instance_geometry url=\"#g\"/></node>";
    EXPECT_EQ(
        triangles_of(read_dae_text(dae).mesh)[0],
        (Triangle{Vec3{0, 0, 1}, Vec3{0, 2, 1}, Vec3{-2, 0, 1}}));
}

TEST(ReadDae, TurnsAxesAndUnitsIntoThoseOfTheScene) {
    const auto corner = [](const std::string& asset, const std::string& top) {
        DaeText dae;
        dae.asset = asset;
        dae.array = "1 2 3 2 0 1 0 2 1 2 2 1";
        RunText text;
        text.top += top;
        text.organs = "[[geometry]]\nfile = 'a.dae'\nmaterial = 'leaf'\n";
        return read_text(text.text(), {{"a.dae", dae.text()}}).scene.triangles()[0][0];
    };
    const std::string cm = "<asset><unit meter=\"0.01\"/><up_axis>Z_UP</up_axis></asset>";
    EXPECT_LT(length(corner(cm, "") - Vec3{.01, .02, .03}), 1e-12);
    EXPECT_LT(length(corner(cm, "length_unit = 'cm'\n") - Vec3{1, 2, 3}), 1e-12);
    EXPECT_LT(length(corner("<asset/>", "") - Vec3{1, -3, 2}), 1e-12);
    EXPECT_LT(length(corner("", "up = 'y'\n") - corner("<asset/>", "up = 'y'\n")), 1e-12);
    // What is up stays up: z, x and y of the file.
    EXPECT_DOUBLE_EQ(corner("<asset><up_axis>X_UP</up_axis></asset>", "").z, 1);
    EXPECT_DOUBLE_EQ(corner("<asset/>", "").z, 2);
}

TEST(ReadDae, BindsMaterialsWithTheMeanOfTheirColour) {
    DaeText dae;
    dae.nodes =
        "<node name=\"leaf\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
        "<instance_material symbol=\"m\" target=\"#green-material\"/></technique_common>"
        "</bind_material></instance_geometry></node>";
    dae.more =
        "<library_effects><effect id=\"green-effect\"><profile_COMMON><technique sid=\"common\">"
        "<lambert><diffuse><color sid=\"diffuse\">0.1 0.5 0.3 1</color></diffuse></lambert>"
        "</technique></profile_COMMON></effect></library_effects><library_materials><material "
        "id=\"green-material\" name=\"green &amp; soft\"><instance_effect "
        "url=\"#green-effect\"/></material></library_materials>";
    const ReadMesh read = read_dae_text(dae);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(read.mesh.groups[0].parts[0].material, "green & soft");
    ASSERT_EQ(read.mesh.materials.size(), 1U);
    EXPECT_EQ(read.mesh.materials[0].name, "green & soft");
    EXPECT_NEAR(read.mesh.materials[0].reflectance, 0.3, 1e-15);
}

TEST(ReadDae, WarnsOfTexturesThatCanBeMasks) {
    const auto warnings = [](const std::string& image) {
        DaeText dae;
        dae.nodes =
            "<node name=\"leaf\"><instance_geometry url=\"#g\"><bind_material><technique_common>"
            "<instance_material symbol=\"m\" target=\"#leaf-material\"/></technique_common>"
            "</bind_material></instance_geometry></node>";
        dae.more = "<library_images><image id=\"i\"><init_from>" + image +
                   "</init_from></image></library_images><library_effects><effect id=\"e\">"
                   "<profile_COMMON><technique sid=\"common\"><lambert><diffuse><texture "
                   "texture=\"i\"/></diffuse></lambert></technique></profile_COMMON></effect>"
                   "</library_effects><library_materials><material id=\"leaf-material\"><"
                   "instance_effect url=\"#e\"/></material></library_materials>";
        const ReadMesh read = read_dae_text(dae);
        EXPECT_EQ(read.faults, Texts{});
        return read.warnings;
    };
    EXPECT_TRUE(mentions(
        warnings("leaf.png"),
        "1 material has textures that can cut out parts of a face (texture)"));
    EXPECT_EQ(warnings("leaf.JPG"), Texts{});
}

TEST(ReadDae, TellsWhatItLeavesOut) {
    DaeText dae;
    dae.primitive += "<lines><p>0 1</p></lines>";
    dae.nodes += "<node name=\"b\"><instance_controller url=\"#c\"/></node>";
    const ReadMesh read = read_dae_text(dae);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_TRUE(mentions(read.warnings, "1 parts are lines: left out"));
    EXPECT_TRUE(mentions(read.warnings, "1 shapes with a skin or a morph are left out"));
}

TEST(ReadDae, TellsFaultsWithTheirLines) {
    const auto expect = [](const DaeText& dae, const char* part) {
        const Texts faults = read_dae_text(dae).faults;
        EXPECT_TRUE(mentions(faults, part)) << part << "\n" << (faults.empty() ? "" : faults[0]);
    };
    const DaeText whole;
    DaeText dae = whole;
    dae.array = "0 0 x";
    expect(dae, ":5: <float_array>: 'x' is not a finite number");
    dae = whole;
    dae.primitive =
        "<triangles><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1 "
        "4</p></triangles>";
    expect(dae, "a face names point '4'");
    dae.primitive =
        "<triangles><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><p>0 1</p></triangles>";
    expect(dae, "<p> has 2 corners");
    dae.primitive =
        "<triangles><input semantic=\"VERTEX\" source=\"#v\" offset=\"1\"/><p>0 1 "
        "2</p></triangles>";
    expect(dae, "<p> holds 3 numbers");
    dae.primitive =
        "<triangles><input semantic=\"VERTEX\" source=\"#w\" offset=\"0\"/></triangles>";
    expect(dae, "<input> names '#w'");
    dae.primitive = "<triangles><p>0 1 2</p></triangles>";
    expect(dae, "<triangles> has no <input> of VERTEX");
    dae.primitive =
        "<polylist><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>5</vcount><p>0 1 "
        "2</p></polylist>";
    expect(dae, "<vcount> has 5");
    dae.primitive =
        "<polylist><input semantic=\"VERTEX\" source=\"#v\" offset=\"0\"/><vcount>2</vcount><p>0 "
        "1</p></polylist>";
    expect(dae, "a face of 2 corners");
    dae = whole;
    dae.nodes = "<node><skew>45 0 1 0 1 0 0</skew><instance_geometry url=\"#g\"/></node>";
    expect(dae, "<skew> is not read");
    dae.nodes = "<node><translate>1 2</translate></node>";
    expect(dae, "<translate> holds 2 numbers");
    dae.nodes = "<node><rotate>0 0 0 1</rotate></node>";
    expect(dae, "<rotate> has no direction");
    dae.nodes = "<node><instance_geometry url=\"other.dae#g\"/></node>";
    expect(dae, "export everything into one file");
    dae = whole;
    dae.asset = "<asset><unit meter=\"0\"/></asset>";
    expect(dae, "the meter of <unit> is no positive number");
    dae.asset = "<asset><up_axis>UP</up_axis></asset>";
    expect(dae, "it is X_UP, Y_UP or Z_UP");
    dae = whole;
    dae.more = "<library_nodes>";
    expect(dae, "closes what is not open");
    EXPECT_TRUE(mentions(read_mesh_text("dae", "<opf/>").faults, "it is no COLLADA file"));
    EXPECT_TRUE(mentions(read_mesh_text("dae", "").faults, "it is no COLLADA file"));
    EXPECT_TRUE(mentions(read_mesh_text("dae", "<COLLADA/>").faults, "it has no <visual_scene>"));
}

/// Nodes that name each other, or are named ever more often, come to an end.
TEST(ReadDae, EndsWhereNodesNameEachOther) {
    DaeText dae;
    dae.nodes = "<node id=\"n\"><instance_node url=\"#n\"/><instance_node url=\"#n\"/></node>";
    EXPECT_TRUE(mentions(read_dae_text(dae).faults, "it places more than 1000000 nodes"));
}

TEST(ReadDae, AnAccessorMayCoverAPartOfItsArray) {
    std::string text = DaeText().text();
    const std::string count = "source=\"#a\" count=\"4\"";
    text.replace(text.find(count), count.size(), "source=\"#a\" count=\"3\"");
    EXPECT_EQ(read_mesh_text("dae", text).warnings, Texts{});
    text.replace(text.find(" count=\"3\""), 10, " count=\"5\"");
    EXPECT_TRUE(mentions(read_mesh_text("dae", text).warnings, "states '5' and has 4"));
}

TEST(ReadDae, WarnsOfCountsThatAreNotWhatIsThere) {
    const auto first = [](const DaeText& dae) {
        const ReadMesh read = read_dae_text(dae);
        EXPECT_EQ(read.faults, Texts{});
        return read.warnings.empty() ? "" : read.warnings.front();
    };
    DaeText faces;
    faces.primitive.replace(faces.primitive.find("\"1\""), 3, "\"5\"");
    EXPECT_EQ(
        first(faces),
        "file: counts differ from what is there (1 in all; the first: <triangles> of line 8 states "
        "'5' and has 1): the file may be cut short or damaged");
    DaeText points;
    points.array += " 7 7 7";
    EXPECT_NE(
        first(points).find("<float_array> of line 5 states '12' and has 15"), std::string::npos)
        << first(points);
    DaeText ids;
    ids.more = "<library_geometries><geometry id=\"g\"><mesh/></geometry></library_geometries>";
    EXPECT_NE(
        first(ids).find("ids occur twice (1 in all, the first is 'g' in line"), std::string::npos)
        << first(ids);
    DaeText kind;
    kind.primitive += "<trianglez count=\"1\"/>";
    EXPECT_NE(first(kind).find("'trianglez' in line"), std::string::npos) << first(kind);
    DaeText moved;
    moved.nodes.insert(moved.nodes.find("<instance"), "<translat>1 0 0</translat>");
    EXPECT_NE(first(moved).find("did you mean 'translate'?"), std::string::npos) << first(moved);
}

TEST(ReadDae, RefusesNamesThatAreNotUtf8AndReadsLatin1ThatSaysSo) {
    DaeText dae;
    dae.nodes = "<node name=\"bl\xE4tt\"><instance_geometry url=\"#g\"/></node>";
    EXPECT_EQ(
        read_dae_text(dae).faults,
        Texts{"file:14: the name 'bl?tt' is not UTF-8; save the file as UTF-8"});
    std::string latin = dae.text();
    latin.replace(latin.find("utf-8"), 5, "ISO-8859-1");
    const ReadMesh read = read_mesh_text("dae", latin);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    EXPECT_EQ(read.mesh.groups[0].name, "bl\xC3\xA4tt");
}

}  // namespace
}  // namespace quasimc::test
