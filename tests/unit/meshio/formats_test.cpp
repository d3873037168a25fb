#include "meshio/formats.h"

#include <algorithm>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meshio/geometry_scene.h"
#include "scene/scene.h"
#include "text/line_scanner.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// Two materials, three organs (two of one name), up y, numbers with many digits, a ground.
std::string scene_text() {
    RunText text;
    text.top = "bands = ['PAR']\nup = 'y'\n";
    text.materials += "[[material]]\nname = 'soil'\nreflectance = 0.2\n";
    text.organs =
        "[[organ]]\nid = 5\nname = 'leaf'\nmaterial = 'leaf'\nshape = 'disk'\ncenter = [0.1, 2, "
        "0.3]\n"
        "normal = [0.3, 1, 0.2]\nradius = 0.7\n"
        "[[organ]]\nid = 3\nname = 'leaf'\nmaterial = 'soil'\nshape = 'triangle'\n"
        "corners = [[0, 1, 0], [0, 1, 1e-7], [1e7, 1, 0]]\n";
    text.rest = "[ground]\nmaterial = 'soil'\n";
    return text.text();
}

std::string written(const FormatEntry& format, const Scene& scene) {
    std::string bytes;
    write_geometry(format, scene, [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

/// The same scene read back from a file, as "each", "groups" or "one".
RunFile read_back(const FormatEntry& format, const std::string& bytes) {
    RunText text;
    text.top = "bands = ['PAR']\nup = 'y'\n";
    text.materials += "[[material]]\nname = 'soil'\nreflectance = 0.2\n";
    text.organs =
        "[[geometry]]\nfile = 'a'\nmaterials = { '0' = 'leaf', '1' = 'soil' }\nmaterial = "
        "'leaf'\nformat = '" +
        std::string(format.name) + "'\n";
    return read_text(text.text(), {{"a", bytes}});
}

TEST(Formats, EveryOneReadsBackTheTrianglesItWrote) {
    const Scene scene = read_text(scene_text()).scene;
    for (const FormatEntry& format : format_table()) {
        if (format.write == nullptr) {
            continue;
        }
        const RunFile run = read_back(format, written(format, scene));
        if (format.precision == 0) {
            EXPECT_EQ(data_of(run.scene).triangles(), data_of(scene).triangles()) << format.name;
            continue;
        }
        for (const Organ& organ : scene.organs()) {
            Bounds bounds;
            for (const Triangle& triangle : scene.triangles_of(organ)) {
                bounds.include(bounds_of(triangle));
            }
            for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
                const std::uint32_t number = organ.first_triangle + i;
                for (std::size_t corner = 0; corner < 3; ++corner) {
                    const Vec3 apart = data_of(run.scene).triangles()[number][corner] -
                                       data_of(scene).triangles()[number][corner];
                    EXPECT_LE(length(apart), format.precision * bounds.radius()) << format.name;
                }
            }
        }
    }
}

TEST(Formats, ThoseWithGroupsReadBackOrgansAndMaterials) {
    const Scene scene = read_text(scene_text()).scene;
    for (const FormatEntry& format : format_table()) {
        if (format.organs != "groups" || format.write == nullptr) {
            continue;
        }
        const Scene back = read_back(format, written(format, scene)).scene;
        ASSERT_EQ(back.organs().size(), scene.organs().size()) << format.name;
        for (std::size_t i = 0; i < scene.organs().size(); ++i) {
            const double area = scene.organs()[i].area;
            EXPECT_NEAR(back.organs()[i].area, area, area * std::max(format.precision, 1e-15))
                << format.name;
            if (format.keeps.find("material") == format.keeps.npos) {
                continue;
            }
            EXPECT_EQ(
                back.material_name(back.regions()[i]), scene.material_name(scene.regions()[i]))
                << format.name;
        }
    }
}

TEST(Formats, OneWithoutAWriterSaysSo) {
    const FormatEntry reader_only{
        .name = "scan", .extensions = ".scan", .summary = "", .organs = "one", .read = read_tri};
    const Scene scene = read_text(scene_text()).scene;
    try {
        (void)written(reader_only, scene);
        FAIL() << "it was written";
    } catch (const InputError& error) {
        EXPECT_NE(
            std::string(error.what())
                .find("format scan can be read, not written; use tri, obj, ply"),
            std::string::npos)
            << error.what();
    }
}

/// Whatever the bytes: what a fuzzer tries for long, every reader of the table must do at once.
TEST(Formats, EveryReaderReportsRubbishAndNothingElse) {
    for (const FormatEntry& format : format_table()) {
        for (const std::string_view bytes :
             {"", "\n", "\x7F\x45LF\x01\x02", "1 2 3 4\nf 1 2 3 9\n"}) {
            const ReadMesh read = read_mesh_text(format.name, bytes);
            for (const std::string& fault : read.faults) {
                EXPECT_EQ(fault.rfind("file", 0), 0U) << format.name << ": " << fault;
            }
        }
    }
}

/// An organ's triangles stand below their materials, whatever the order they came in.
TEST(Formats, ObjPutsTheTrianglesOfAMaterialTogether) {
    RunText text;
    text.materials += "[[material]]\nname = 'soil'\nreflectance = 0.2\n";
    text.organs =
        "[[geometry]]\nfile = 'a.obj'\nmaterials = { a = 'leaf', b = 'soil' }\norgans = 'one'\n";
    const std::string corners = "v 0 0 1\nv 1 0 1\nv 0 1 1\nv 0 2 2\n";
    const std::string faces = "usemtl a\nf 1 2 3\nusemtl b\nf 1 2 4\nusemtl a\nf 2 3 4\n";
    const Scene scene = read_text(text.text(), {{"a.obj", corners + faces}}).scene;
    ASSERT_EQ(scene.organs().size(), 1U);
    std::string obj = written(*find_format("obj"), scene);
    std::erase_if(obj, [](char c) { return c == '\n'; });
    const std::string face = "f -3 -2 -1";
    EXPECT_NE(
        obj.find(
            "usemtl leafv 0 0 1v 1 0 1v 0 1 1" + face + "v 1 0 1v 0 1 1v 0 2 2" + face +
            "usemtl soilv 0 0 1v 1 0 1v 0 2 2" + face),
        std::string::npos)
        << obj;
}

TEST(Formats, PlyKeepsIds) {
    const Scene scene = read_text(scene_text()).scene;
    const Scene back = read_back(*find_format("ply"), written(*find_format("ply"), scene)).scene;
    EXPECT_EQ(back.organs()[0].id, 5);
    EXPECT_EQ(back.organs()[1].id, 3);
}

TEST(Formats, PlyKeepsTheNamesOfMaterials) {
    const Scene scene = read_text(scene_text()).scene;
    const std::string ply = written(*find_format("ply"), scene);
    const MeshFile mesh = read_mesh_text("ply", ply).mesh;
    EXPECT_EQ(mesh.groups[0].parts[0].material, "leaf");
    EXPECT_EQ(mesh.groups[1].parts[0].material, "soil");
    // A run file may give the number or the name.
    for (const char* const keys :
         {"materials = { '0' = 'green', '1' = 'green' }\n",
          "materials = { leaf = 'green', soil = "
          "'green' }\n"}) {
        RunText text;
        text.materials = "[[material]]\nname = 'green'\nreflectance = 0.1\n";
        text.organs = std::string("[[geometry]]\nfile = 'a.ply'\n") + keys;
        EXPECT_EQ(faults_of(text.text(), {{"a.ply", ply}}), std::vector<std::string>{}) << keys;
    }
}

TEST(Formats, ObjKeepsLabels) {
    RunText text;
    text.organs +=
        "labels = { plant = '3', 'leaf rank' = 'a = b' }\n[[organ]]\nname = 'stem'\nmaterial = "
        "'leaf'\nshape = 'triangle'\ncorners = [[0, 0, 2], [1, 0, 2], [0, 1, 2]]\n"
        "labels = { plant = '4', 'leaf rank' = '' }\n";
    const std::string obj = written(*find_format("obj"), read_text(text.text()).scene);
    const MeshFile mesh = read_mesh_text("obj", obj).mesh;
    ASSERT_EQ(mesh.groups.size(), 2U);
    EXPECT_EQ(mesh.groups[0].labels, (Labels{{"plant", "3"}, {"leaf rank", "a = b"}}));
    EXPECT_EQ(mesh.groups[1].labels, (Labels{{"plant", "4"}, {"leaf rank", ""}}));
}

TEST(Formats, WarnOfWhatAWriterDoesNotKeep) {
    RunText text;
    text.materials += "[[material]]\nname = 'soil'\nreflectance = 0.2\n";
    text.organs += "labels = { plant = '3' }\n";
    text.rest = "[ground]\nmaterial = 'soil'\n";
    const Scene scene = read_text(text.text()).scene;
    const auto lost = [&](std::string_view format) {
        std::vector<std::string> texts;
        for (const Warning& warning : lost_when_written(*find_format(format), scene)) {
            texts.push_back(warning.where + ": " + warning.text);
        }
        return texts;
    };
    using Texts = std::vector<std::string>;
    EXPECT_EQ(
        lost("tri"), (Texts{
                         "tri: names of 2 materials are not written: this format does not support "
                         "them; obj, ply, glb do",
                         "tri: labels of 1 organ are not written: this format does not support "
                         "them; obj, glb do"}));
    EXPECT_EQ(lost("ply").size(), 1U);
    EXPECT_EQ(lost("obj"), Texts{});
    EXPECT_EQ(lost("glb"), Texts{});
}

TEST(Formats, WarnOfTexturesThatCanBeMasks) {
    const ReadMesh ply = read_mesh_text(
        "ply",
        "ply\nformat ascii 1.0\ncomment TextureFile leaf.png\nelement vertex 3\nproperty float x\n"
        "property float y\nproperty float z\nelement face 1\nproperty list uchar int "
        "vertex_indices\nend_header\n0 0 1\n1 0 1\n0 1 1\n3 0 1 2\n");
    EXPECT_EQ(ply.faults, std::vector<std::string>{});
    EXPECT_TRUE(mentions(
        ply.warnings,
        "1 material has textures that may mask parts of a face (TextureFile): masks are not read; "
        "faces are opaque, 0.5 of the area of 0.5"));
}

TEST(Formats, AreToldByTheExtensionWhateverItsCase) {
    EXPECT_EQ(format_of_path("a/b.OBJ")->name, "obj");
    EXPECT_EQ(format_of_path("a.b.tri")->name, "tri");
    EXPECT_EQ(format_of_path("a.xyz"), nullptr);
    EXPECT_EQ(format_of_path("obj"), nullptr);
    EXPECT_EQ(format_of_path("a."), nullptr);
}

TEST(Formats, HaveNamesAndExtensionsOfTheirOwn) {
    std::set<std::string_view> names, extensions;
    for (const FormatEntry& format : format_table()) {
        EXPECT_TRUE(names.insert(format.name).second);
        EXPECT_EQ(find_format(format.name), &format);
        std::string_view rest = format.extensions;
        for (std::string_view e = take_word(rest); !e.empty(); e = take_word(rest)) {
            EXPECT_TRUE(extensions.insert(e).second) << e;
        }
    }
}

TEST(LineScanner, TakesLinesWithAndWithoutCarriageReturns) {
    LineScanner scanner(
        "\xEF\xBB\xBF"
        "a\r\n\nb");
    ASSERT_TRUE(scanner.next());
    EXPECT_EQ(scanner.line(), "a");
    ASSERT_TRUE(scanner.next());
    EXPECT_EQ(scanner.line(), "");
    ASSERT_TRUE(scanner.next());
    EXPECT_EQ(scanner.line(), "b");
    EXPECT_EQ(scanner.number(), 3U);
    EXPECT_FALSE(scanner.next());
}

TEST(IsUtf8, TellsTextFromBytes) {
    EXPECT_TRUE(is_utf8("leaf"));
    EXPECT_TRUE(is_utf8("Bl\xC3\xA4tter \xE2\x82\xAC \xF0\x9F\x8C\xBF"));
    for (const char* bytes : {"Bl\xE4tter", "\xC3", "\xC0\x80", "\xF5\x80\x80\x80", "\x80"}) {
        EXPECT_FALSE(is_utf8(bytes));
    }
}

/// Leaves of 0.1 m, 2 triangles each, at a position of a map; each number rounded by `store`.
template <typename Store>
std::string leaves_on_a_map(double x, double y, const Store& store) {
    std::string text;
    for (int i = 0; i < 60; ++i) {
        const double a = x + 0.37 * i, b = y + 0.23 * i, z = 1 + 0.01 * i;
        for (const double side : {1.0, -1.0}) {
            for (const double number :
                 {a, b, z, a + 0.07 * side, b + 0.05, z, a + 0.01 * side, b + 0.11 * side, z}) {
                text += fmt::format("{} ", store(number));
            }
            text += "\n";
        }
    }
    return text;
}

double as_float(double number) {
    return static_cast<double>(static_cast<float>(number));
}

TEST(Formats, WarnOfSinglePrecisionThatIsTooCoarseForTheTriangles) {
    const auto exact = [](double number) { return number; };
    const auto warnings = [](const std::string& text) {
        return read_mesh_text("tri", text).warnings;
    };
    const std::vector<std::string> coarse = warnings(leaves_on_a_map(6e5, 4.265e6, as_float));
    ASSERT_EQ(coarse.size(), 1U);
    EXPECT_TRUE(mentions(coarse, "single precision, with steps of 0.5 near y = 4265000"))
        << coarse[0];
    EXPECT_TRUE(warnings(leaves_on_a_map(6e5, 4.265e6, exact)).empty());
    EXPECT_TRUE(warnings(leaves_on_a_map(0, 0, as_float)).empty());
    EXPECT_TRUE(warnings(leaves_on_a_map(3, 400, as_float)).empty());
    EXPECT_TRUE(warnings("600000 4265000 1 600001 4265000 1 600000 4265001 1\n").empty())
        << "whole numbers are exact";
}

TEST(Formats, OfEveryKindRefuseNamesThatAreNotUtf8) {
    const std::string bad = "bl\xE4tt";
    const std::map<std::string, std::string> files{
        {"obj", "o " + bad + "\nv 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n"},
        {"stl", "solid " + bad +
                    "\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 1 0 1\nvertex 0 1 1\n"
                    "endloop\nendfacet\nendsolid\n"},
        {"vgx", "Obj X1 Y1 Z1 X2 Y2 Z2 X3 Y3 Z3 " + bad + "\n0 0 0 1 1 0 1 0 1 1 5\n"},
        {"gltf", R"({"asset":{"version":"2.0","generator":")" + bad + R"("}})"}};
    for (const auto& [format, text] : files) {
        EXPECT_FALSE(read_mesh_text(format, text).faults.empty()) << format;
    }
    EXPECT_TRUE(
        mentions(read_mesh_text("vgx", files.at("vgx")).faults, "the label 'bl?tt' is not UTF-8"));
}

TEST(Formats, NameTheOnesThatAreNotRead) {
    const auto faults = [](const std::string& file) {
        RunText text;
        text.organs = "[[geometry]]\nfile = '" + file + "'\nmaterial = 'leaf'\n";
        return faults_of(text.text());
    };
    const std::string way =
        ", which is not supported; load it in Python with PlantGL, and give the Scene to "
        "quasimc.compat.caribu.CaribuScene or let it write triangles: "
        "Scene(\"plant.geom\").save(\"plant.obj\")";
    EXPECT_TRUE(mentions(faults("tree.geom"), "'tree.geom' is a scene of PlantGL" + way));
    EXPECT_TRUE(mentions(faults("t.bgeom"), "'t.bgeom' is a binary scene of PlantGL" + way));
    EXPECT_TRUE(mentions(
        faults("tree.dae"),
        "'tree.dae' is a COLLADA file, which is not supported; make glTF of it, with Blender or by "
        "`assimp export plant.dae plant.glb`"));
}

}  // namespace
}  // namespace quasimc::test
