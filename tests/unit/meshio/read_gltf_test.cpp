#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "text/base64.h"
#include "text/little_endian.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

using Texts = std::vector<std::string>;

template <typename T>
std::string bytes_of(const std::vector<T>& numbers) {
    std::string bytes;
    for (const T number : numbers) {
        append_little_endian(bytes, number);
    }
    return bytes;
}

/// A square in the plane z = 1 of glTF, whose y points up.
const std::vector<float> kGltfSquare{0, 0, 1, 2, 0, 1, 0, 2, 1, 2, 2, 1};

/// glTF in a few words: a buffer "a.bin" of one view, that of points alone unless it is said.
struct GltfText {
    std::string scene = R"("nodes":[{"mesh":0,"name":"leaf"}],)";
    std::string primitive = R"({"attributes":{"POSITION":0}})";
    std::string accessors = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":3})";
    std::string views = R"({"buffer":0,"byteLength":48})";
    std::string buffer = R"({"uri":"a.bin","byteLength":48})";
    std::string more;

    [[nodiscard]] std::string text() const {
        return R"({"asset":{"version":"2.0"},)" + scene + more +
               R"("meshes":[{"name":"blade","primitives":[)" + primitive + R"(]}],"accessors":[)" +
               accessors + R"(],"bufferViews":[)" + views + R"(],"buffers":[)" + buffer + "]}";
    }
};

ReadMesh read_gltf_text(const GltfText& gltf, const std::string& bytes = bytes_of(kGltfSquare)) {
    return read_mesh_text("gltf", gltf.text(), {{"a.bin", bytes}});
}

std::string glb_of(const std::string& json, const std::string& binary) {
    std::string padded = json;
    padded.resize((json.size() + 3) / 4 * 4, ' ');
    std::string bytes = "glTF";
    for (const std::size_t number :
         {std::size_t{2}, 28 + padded.size() + binary.size(), padded.size()}) {
        append_little_endian(bytes, static_cast<std::uint32_t>(number));
    }
    bytes += "JSON" + padded;
    append_little_endian(bytes, static_cast<std::uint32_t>(binary.size()));
    return bytes + std::string("BIN\0", 4) + binary;
}

// What the square's first triangle is where z points up.
const Triangle kFirstOfSquare{Vec3{0, -1, 0}, Vec3{2, -1, 0}, Vec3{0, -1, 2}};

TEST(ReadGltf, TurnsWhatPointsUp) {
    const ReadMesh read = read_gltf_text({});
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(triangles_of(read.mesh), std::vector<Triangle>{kFirstOfSquare});
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    EXPECT_EQ(read.mesh.groups[0].name, "leaf");
    EXPECT_EQ(read.mesh.groups[0].id, std::nullopt);
    EXPECT_EQ(read.mesh.groups[0].labels, (Labels{{"mesh", "blade"}}));
}

TEST(ReadGltf, TakesBytesFromFilesFromTextAndFromGlb) {
    GltfText file;
    file.buffer = R"({"uri":"b%20c.bin"})";
    const ReadMesh beside =
        read_mesh_text("gltf", file.text(), {{"b c.bin", bytes_of(kGltfSquare)}});
    EXPECT_EQ(beside.faults, Texts{});
    EXPECT_EQ(triangles_of(beside.mesh), std::vector<Triangle>{kFirstOfSquare});

    GltfText embedded;
    embedded.views = R"({"buffer":0,"byteLength":36})";
    embedded.buffer = R"({"uri":"data:application/octet-stream;base64,)"
                      R"(AAAAAAAAAAAAAIA/AAAAQAAAAAAAAIA/AAAAAAAAAEAAAIA/"})";
    const ReadMesh inside = read_mesh_text("gltf", embedded.text());
    EXPECT_EQ(inside.faults, Texts{});
    EXPECT_EQ(triangles_of(inside.mesh), std::vector<Triangle>{kFirstOfSquare});

    GltfText binary;
    binary.buffer = R"({"byteLength":48})";
    const ReadMesh glb = read_mesh_text("glb", glb_of(binary.text(), bytes_of(kGltfSquare)));
    EXPECT_EQ(glb.faults, Texts{});
    EXPECT_EQ(triangles_of(glb.mesh), std::vector<Triangle>{kFirstOfSquare});
}

TEST(ReadGltf, FollowsNodesAndPlacesOneMeshManyTimes) {
    GltfText gltf;
    gltf.scene =
        R"("scene":1,"scenes":[{"nodes":[3]},{"nodes":[0]}],"nodes":[
        {"name":"plant","translation":[10,0,0],"children":[1,2]},
        {"name":"left","mesh":0,"scale":[2,2,2]},
        {"mesh":0,"rotation":[0,0.7071067811865476,0,0.7071067811865476]},
        {"name":"of another scene","mesh":0}],)";
    const ReadMesh read = read_gltf_text(gltf);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].name, "left");
    EXPECT_EQ(read.mesh.groups[0].labels, (Labels{{"parent", "plant"}, {"mesh", "blade"}}));
    EXPECT_EQ(read.mesh.groups[1].name, "blade") << "a node without a name has that of its mesh";
    const std::vector<Triangle> triangles = triangles_of(read.mesh);
    EXPECT_EQ(triangles[0][1], (Vec3{14, -2, 0}));
    // A quarter of a turn about what points up: (2, 0, 1) comes to (1, 0, -2).
    EXPECT_NEAR(triangles[1][1].x, 11, 1e-12);
    EXPECT_NEAR(triangles[1][1].y, 2, 1e-12);
    EXPECT_NEAR(triangles[1][1].z, 0, 1e-12);
}

TEST(ReadGltf, KeepsTheFrontOfMirrorImages) {
    GltfText gltf;
    gltf.scene = R"("nodes":[{"mesh":0,"matrix":[-1,0,0,0, 0,1,0,0, 0,0,1,0, 5,0,0,1]}],)";
    const ReadMesh read = read_gltf_text(gltf);
    EXPECT_EQ(read.faults, Texts{});
    // The front of the square faces along z of glTF, -y here, and so does that of its image.
    EXPECT_LT(area_vector(kFirstOfSquare).y, 0);
    EXPECT_LT(area_vector(triangles_of(read.mesh)[0]).y, 0);
    EXPECT_EQ(triangles_of(read.mesh)[0][0], (Vec3{5, -1, 0}));
}

TEST(ReadGltf, TakesStripsFansAndIndicesOfEveryType) {
    struct Case {
        const char* name;
        int mode;
        int type;
        std::string indices;
        std::size_t triangles;
        double area;
    };
    const std::vector<Case> cases{
        {"strip of bytes", 5, 5121, bytes_of<std::uint8_t>({0, 1, 2, 3}), 2, 4},
        {"strip over a line", 5, 5123, bytes_of<std::uint16_t>({0, 1, 2, 2, 2, 1, 3}), 2, 4},
        {"fan of shorts", 6, 5123, bytes_of<std::uint16_t>({0, 1, 3, 2}), 2, 4},
        {"list of ints", 4, 5125, bytes_of<std::uint32_t>({0, 1, 3, 0, 3, 2}), 2, 4}};
    for (const Case& c : cases) {
        GltfText gltf;
        const std::size_t count = c.indices.size() / (c.type == 5121 ? 1 : c.type == 5123 ? 2 : 4);
        gltf.primitive =
            R"({"attributes":{"POSITION":0},"indices":1,"mode":)" + std::to_string(c.mode) + "}";
        gltf.accessors = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":4},)"
                         R"({"bufferView":1,"type":"SCALAR","componentType":)" +
                         std::to_string(c.type) + R"(,"count":)" + std::to_string(count) + "}";
        gltf.views += R"(,{"buffer":0,"byteOffset":48,"byteLength":)" +
                      std::to_string(c.indices.size()) + "}";
        const ReadMesh read = read_gltf_text(gltf, bytes_of(kGltfSquare) + c.indices);
        EXPECT_EQ(read.faults, Texts{}) << c.name;
        const std::vector<Triangle> triangles = triangles_of(read.mesh);
        EXPECT_EQ(triangles.size(), c.triangles) << c.name;
        EXPECT_DOUBLE_EQ(area(triangles), c.area) << c.name;
        for (const Triangle& triangle : triangles) {
            EXPECT_LT(area_vector(triangle).y, 0) << c.name << ": all fronts look one way";
        }
    }
}

TEST(ReadGltf, TakesShortNumbersThatStandForFractionsApartByAStride) {
    GltfText gltf;
    gltf.accessors =
        R"({"bufferView":0,"byteOffset":2,"componentType":5122,"normalized":true,"type":"VEC3","count":3})";
    gltf.views = R"({"buffer":0,"byteOffset":4,"byteLength":24,"byteStride":8})";
    const std::string bytes = bytes_of<std::int16_t>(
        {9, 9, /**/ 9, 32767, -32768, 0, /**/ 9, 0, 32767, 0, /**/ 9, 0, 0, -32767});
    const ReadMesh read = read_gltf_text(gltf, bytes);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(
        triangles_of(read.mesh),
        (std::vector<Triangle>{{Vec3{1, 0, -1}, Vec3{0, 0, 1}, Vec3{0, 1, 0}}}));
}

TEST(ReadGltf, TakesMaterialsByNameAndExtrasAsLabels) {
    GltfText gltf;
    gltf.scene =
        R"("nodes":[{"mesh":0,"name":"a","extras":{"id":17,"kind":"leaf","age":3,"list":[1],"length":0.5,"old":true}}],)";
    gltf.primitive = R"({"attributes":{"POSITION":0},"material":1})";
    gltf.more =
        R"("materials":[{"pbrMetallicRoughness":{}},{"name":"lamina","alphaMode":"MASK","pbrMetallicRoughness":{"baseColorFactor":[0.1,0.2,0.3,1]}}],)";
    const ReadMesh read = read_gltf_text(gltf);
    EXPECT_EQ(read.faults, Texts{});
    ASSERT_EQ(read.mesh.groups.size(), 1U);
    const MeshGroup& group = read.mesh.groups[0];
    EXPECT_EQ(group.id, 17);
    EXPECT_EQ(
        group.labels, (Labels{
                          {"kind", "leaf"},
                          {"age", "3"},
                          {"length", "0.5"},
                          {"old", "true"},
                          {"mesh", "blade"}}));
    EXPECT_EQ(group.parts[0].material, "lamina");
    ASSERT_EQ(read.mesh.materials.size(), 1U) << "white that nobody stated is no reflectance";
    EXPECT_DOUBLE_EQ(read.mesh.materials[0].reflectance, 0.2);
    EXPECT_TRUE(mentions(
        read.warnings, "1 material has textures that may mask parts of a face (alphaMode)"));
}

TEST(ReadGltf, KeepsMaterialsOfOneNameApart) {
    GltfText gltf;
    gltf.primitive =
        R"({"attributes":{"POSITION":0},"material":0},{"attributes":{"POSITION":0},"material":1},{"attributes":{"POSITION":0},"material":2})";
    const auto color = [](const char* value) {
        return fmt::format(
            R"({{"name":"M","pbrMetallicRoughness":{{"baseColorFactor":[{0},{0},{0},1]}}}})",
            value);
    };
    gltf.more = R"("materials":[)" + color("0.1") + "," + color("0.9") + "," + color("0.1") + "],";
    const ReadMesh read = read_gltf_text(gltf);
    EXPECT_EQ(read.faults, Texts{});
    const std::vector<MeshPart>& parts = read.mesh.groups[0].parts;
    ASSERT_EQ(parts.size(), 3U);
    EXPECT_EQ(parts[0].material, "M");
    EXPECT_EQ(parts[1].material, "M (2)");
    EXPECT_EQ(parts[2].material, "M");
    EXPECT_EQ(read.mesh.aliases.at("M (2)"), "M");
    EXPECT_DOUBLE_EQ(read.mesh.materials[1].reflectance, 0.9);
}

TEST(ReadGltf, CountsOrgansWhoseIdsWereCopied) {
    GltfText gltf;
    gltf.scene = R"("nodes":[{"mesh":0,"extras":{"id":1}},{"mesh":0,"extras":{"id":1}}],)";
    const ReadMesh read = read_gltf_text(gltf);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(read.mesh.groups[0].id, std::nullopt);
    EXPECT_TRUE(mentions(read.warnings, "1 node with the id of another"));
}

TEST(ReadGltf, LeavesLinesAndPointsOutAndSaysSo) {
    GltfText gltf;
    gltf.primitive += R"(,{"attributes":{"POSITION":0},"mode":1})";
    const ReadMesh read = read_gltf_text(gltf);
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_EQ(triangles_of(read.mesh).size(), 1U);
    EXPECT_TRUE(mentions(read.warnings, "1 primitive of lines or points left out"));
}

/// A file with one change, and the fault it must give.
void expect_gltf_fault(
    const std::string& find, const std::string& replacement, const Texts& faults) {
    std::string text = GltfText().text();
    const std::size_t at = text.find(find);
    ASSERT_NE(at, std::string::npos) << find;
    text.replace(at, find.size(), replacement);
    EXPECT_EQ(read_mesh_text("gltf", text, {{"a.bin", bytes_of(kGltfSquare)}}).faults, faults)
        << text;
}

TEST(ReadGltf, RefusesByNameWhatItDoesNotRead) {
    expect_gltf_fault(
        "\"meshes\"", R"("extensionsRequired":["KHR_draco_mesh_compression"],"meshes")",
        {"file: it requires the extension 'KHR_draco_mesh_compression' (it is not supported); "
         "export without it, or without compression"});
    expect_gltf_fault(
        "\"meshes\"", R"("extensionsRequired":["KHR_mesh_quantization"],"meshes")", {});
    expect_gltf_fault(
        R"("count":3)", R"("count":3,"sparse":{})",
        {"file: accessor 0 is sparse (sparse accessors are not supported); export without sparse "
         "accessors"});
    expect_gltf_fault(
        R"("mesh":0,)", R"("mesh":0,"skin":0,)",
        {"file: node 0 has a skin (skinned meshes are not supported); apply the armature and "
         "export again"});
    expect_gltf_fault(
        R"("mesh":0,)", R"("mesh":0,"weights":[0,0.5],)",
        {"file: node 0 has morph targets (weights) (they are not supported); apply the shape keys "
         "and export again"});
    expect_gltf_fault(
        R"("mesh":0,)", R"("mesh":0,"extensions":{"EXT_mesh_gpu_instancing":{}},)",
        {"file: node 0 has the extension 'EXT_mesh_gpu_instancing' (it is not supported); export "
         "each copy as a node"});
    expect_gltf_fault(
        R"("2.0")", R"("1.0")",
        {"file: it is not glTF 2.0 (its version is 1.0); export it as glTF 2.0"});
}

TEST(ReadGltf, TellsWhatIsWrong) {
    expect_gltf_fault(
        R"("mesh":0)", R"("mesh":1)",
        {"file: node 0: mesh refers to a missing item (there are 1, counted from 0)"});
    expect_gltf_fault(
        R"("count":3)", R"("count":6)",
        {"file: accessor 0: 6 elements do not fit in its bufferView (it has 48 bytes after the "
         "offset)"});
    expect_gltf_fault(
        R"("byteLength":48})", R"("byteLength":49})",
        {"file: accessor 0: its bytes are missing (buffer 0 has 48)"});
    expect_gltf_fault(
        "a.bin", "b.bin",
        {"file: buffer 0 'b.bin' can't be read (No such file or directory)",
         "file: accessor 0: buffer 0 has no bytes (they are neither in the file nor beside it)"});
    expect_gltf_fault(
        R"("a.bin")", R"("data:;base64,AA=A")",
        {"file: buffer 0 can't be read (its data are not base64)",
         "file: accessor 0: buffer 0 has no bytes (they are neither in the file nor beside it)"});
    expect_gltf_fault(R"("mesh":0,)", R"("children":[0],"mesh":0,)", {});
    expect_gltf_fault(
        R"("nodes":[)", R"("scenes":[{"nodes":[1,1]}],"nodes":[{},)",
        {"file: node 1 has two parents, or appears twice in the scene (nodes must form trees)"});
    expect_gltf_fault(
        R"("mesh":0,)", R"("rotation":[0,0,0,0],"mesh":0,)",
        {"file: node 0: its rotation is not a unit quaternion"});
    expect_gltf_fault(
        R"("mesh":0,)", R"("scale":[1,1],"mesh":0,)",
        {"file: node 0: scale is not a list of 3 finite numbers"});
    expect_gltf_fault("{\"asset\"", "{asset", {"file: byte 2 is not JSON"});
    expect_gltf_fault(
        R"("count":3)", R"("count":2)",
        {"file: a primitive with 2 vertices (it must be a multiple of 3)"});
}

TEST(ReadGltf, TellsOfNumbersThatAreNone) {
    std::vector<float> points = kGltfSquare;
    points[4] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(
        read_gltf_text({}, bytes_of(points)).faults,
        Texts{"file: accessor 0: point 1 is not finite"});
    GltfText gltf;
    gltf.primitive = R"({"attributes":{"POSITION":0},"indices":1})";
    gltf.accessors += R"(,{"bufferView":1,"type":"SCALAR","componentType":5121,"count":3})";
    gltf.views += R"(,{"buffer":0,"byteOffset":48,"byteLength":3})";
    EXPECT_EQ(
        read_gltf_text(gltf, bytes_of(kGltfSquare) + std::string("\x01\x02\x03", 3)).faults,
        Texts{"file: accessor 1: index 2 refers to vertex 3 (there are 3, counted from 0)"});
}

TEST(ReadGltf, TellsOfGlbThatIsCutShort) {
    GltfText text;
    text.buffer = R"({"byteLength":48})";
    const std::string whole = glb_of(text.text(), bytes_of(kGltfSquare));
    for (std::size_t size = 4; size < whole.size(); ++size) {
        EXPECT_EQ(read_mesh_text("glb", whole.substr(0, size)).faults.size(), 1U) << size;
    }
}

TEST(DecodeBase64, TakesWhatItWasMadeFromAndNothingElse) {
    EXPECT_EQ(decode_base64(""), "");
    EXPECT_EQ(decode_base64("Zg=="), "f");
    EXPECT_EQ(decode_base64("Zm8="), "fo");
    EXPECT_EQ(decode_base64("Zm9vYmFy"), "foobar");
    EXPECT_EQ(decode_base64("Zm8"), "fo");
    for (const char* text : {"Z", "Zm9vY", "Zm-v", "Zm 9"}) {
        EXPECT_EQ(decode_base64(text), std::nullopt) << text;
    }
}

TEST(ReadGltf, SaysWhatDoesNotFit) {
    const auto warning = [](const GltfText& gltf) {
        const ReadMesh read = read_gltf_text(gltf);
        EXPECT_EQ(read.faults, Texts{});
        return read.warnings.empty() ? "" : read.warnings.front();
    };
    GltfText length;
    length.buffer = R"({"uri":"a.bin","byteLength":1000000000000000})";
    EXPECT_EQ(
        warning(length),
        "file: buffer 0 has 48 bytes, its byteLength is 1000000000000000: the file may be "
        "incomplete or damaged");
    GltfText bounds;
    bounds.accessors = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":3,)"
                       R"("min":[0,0,0],"max":[2,2,1]})";
    EXPECT_NE(warning(bounds).find("outside the min and max"), std::string::npos);
    bounds.accessors = R"({"bufferView":0,"componentType":5126,"type":"VEC3","count":3,)"
                       R"("min":[0,0,1],"max":[2,2,1]})";
    EXPECT_EQ(warning(bounds), "");
    GltfText key;
    key.scene = R"("nodes":[{"mesh":0,"name":"leaf","translatoin":[0,0,5]}],)";
    EXPECT_EQ(
        warning(key),
        "file: keys that glTF 2.0 does not have are ignored: 1 in total, the first is "
        "'translatoin' in node 0; did you mean 'translation'?");
}

TEST(ReadGltf, RefusesIndicesAndPointsOfAnotherKind) {
    GltfText gltf;
    gltf.primitive = R"({"attributes":{"POSITION":0},"indices":1})";
    const std::string points = gltf.accessors;
    for (const char* kind :
         {R"("SCALAR","componentType":5126)", R"("VEC3","componentType":5121)"}) {
        gltf.accessors = points + R"(,{"bufferView":0,"count":3,"type":)" + std::string(kind) + "}";
        EXPECT_EQ(
            read_gltf_text(gltf).faults,
            Texts{"file: accessor 1 is not a list of indices (it must be SCALAR of integers)"})
            << kind;
    }
    expect_gltf_fault(
        "5126", "5125",
        {"file: accessor 0 is not a list of points (it must be VEC3 of float, or of quantized 8 or "
         "16 bits)"});
    expect_gltf_fault(
        R"("version":"2.0")", R"("version":"2.1","minVersion":"2.1")",
        {"file: it needs a reader of glTF 2.1 (minVersion; version 2.0 is supported); export it as "
         "glTF 2.0"});
}

TEST(ReadGltf, WarnsOfPointsThatAreTooCoarseForTheirTriangles) {
    const std::vector<float> points{600000.0625F, 0, 1, 600000.1875F, 0, 1, 600000.125F, 0.1F, 1};
    GltfText gltf;
    gltf.buffer = R"({"uri":"a.bin","byteLength":36})";
    gltf.views = R"({"buffer":0,"byteLength":36})";
    EXPECT_TRUE(mentions(
        read_gltf_text(gltf, bytes_of(points)).warnings,
        "single precision, with steps of 0.062 near x = 600000.1"));
    EXPECT_TRUE(read_gltf_text({}).warnings.empty());
}

TEST(ReadGltf, WarnsOfBytesBehindTheEnd) {
    GltfText text;
    text.buffer = R"({"byteLength":48})";
    const ReadMesh read =
        read_mesh_text("glb", glb_of(text.text(), bytes_of(kGltfSquare)) + "more");
    EXPECT_EQ(read.faults, Texts{});
    EXPECT_TRUE(mentions(read.warnings, "the rest is not read"));
}

}  // namespace
}  // namespace quasimc::test
