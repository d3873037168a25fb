#include "resultio/field_formats.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "text/document.h"
#include "text/little_endian.h"
#include "unit/runfile/io_testing.h"

namespace quasimc::test {
namespace {

/// Two organs of three triangles together, and a number of each.
RunFile field_run() {
    RunText text;
    text.organs =
        "[[organ]]\nid = 12345678901\nname = 'a <leaf>'\nmaterial = 'leaf'\nshape = "
        "'parallelogram'\n"
        "corner = [0, 0, 1]\nedge_a = [1, 0, 0]\nedge_b = [0, 1, 0]\n"
        "[[organ]]\nid = 3\nmaterial = 'leaf'\nshape = 'triangle'\n"
        "corners = [[0, 0, 2], [1, 0, 2], [0, 1, 2]]\n";
    return read_text(text.text());
}

const std::vector<OrganField> kFields{
    {"absorbed_flux_PAR", "W", {0.1, 2.5}}, {"sunlit_fraction", "", {1, std::nan("")}}};

std::string field_bytes(const char* path) {
    std::string bytes;
    const RunFile run = field_run();
    field_format_of_path(path)->write(
        {.scene = run.scene,
         .fields = kFields,
         .colors = {{255, 0, 128}, {200, 200, 200}},
         .colors_of = "light"},
        [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

/// The numbers of an appended array, read by what its element says.
template <typename T>
std::vector<T> vtp_array(const std::string& bytes, const std::string& name) {
    const std::size_t element = bytes.find("Name=\"" + name + "\"");
    if (element == std::string::npos) {
        ADD_FAILURE() << "there is no " << name;
        return {};
    }
    const std::string key = "offset=\"";
    const std::size_t offset = std::stoul(bytes.substr(bytes.find(key, element) + key.size(), 20));
    const std::size_t start = bytes.find("encoding=\"raw\">\n_") + 17 + offset;
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + start, sizeof(size));
    std::vector<T> numbers(size / sizeof(T));
    std::memcpy(numbers.data(), bytes.data() + start + sizeof(size), size);
    return numbers;
}

TEST(FieldFormats, VtpHasANumberForEachTriangle) {
    const std::string bytes = field_bytes("a.VTP");
    EXPECT_NE(bytes.find("NumberOfPoints=\"9\" NumberOfPolys=\"3\""), std::string::npos);
    EXPECT_EQ(
        vtp_array<std::int64_t>(bytes, "organ"),
        (std::vector<std::int64_t>{12345678901, 12345678901, 3}));
    EXPECT_EQ(
        vtp_array<double>(bytes, "absorbed_flux_PAR [W]"), (std::vector<double>{0.1, 0.1, 2.5}));
    const std::vector<double> fractions = vtp_array<double>(bytes, "sunlit_fraction");
    ASSERT_EQ(fractions.size(), 3U);
    EXPECT_EQ(fractions[0], 1);
    EXPECT_TRUE(std::isnan(fractions[2]));
    EXPECT_EQ(vtp_array<std::int64_t>(bytes, "offsets"), (std::vector<std::int64_t>{3, 6, 9}));
    EXPECT_EQ(vtp_array<double>(bytes, "points").size(), 27U);
}

TEST(FieldFormats, PlyIsReadBackWithItsOrgans) {
    const std::string bytes = field_bytes("a.ply");
    EXPECT_NE(bytes.find("comment absorbed_flux_PAR [W]\n"), std::string::npos);
    EXPECT_NE(bytes.find("property double sunlit_fraction\n"), std::string::npos);
    const ReadMesh read = read_mesh_text("ply", bytes);
    EXPECT_EQ(read.faults, std::vector<std::string>{});
    ASSERT_EQ(read.mesh.groups.size(), 2U);
    EXPECT_EQ(read.mesh.groups[0].id, 12345678901);
    EXPECT_EQ(triangles_of(read.mesh).size(), 3U);
    EXPECT_EQ(field_format_of_path("a.txt"), nullptr);
}

/// The part of a GLB file that an accessor names, as numbers.
template <typename T>
std::vector<T> glb_numbers(const std::string& bytes, const char* attribute) {
    const std::size_t json_size = little_endian_at<std::uint32_t>(bytes, 12);
    const Node json = read_json(bytes.substr(20, json_size), "file");
    const Node& primitive = json.find("meshes")->as<Node::List>()->front();
    const Node& attributes =
        *primitive.find("primitives")->as<Node::List>()->front().find("attributes");
    const auto whole = [](const Node& node, const char* key) {
        return static_cast<std::size_t>(*node.find(key)->as<std::int64_t>());
    };
    const Node& accessor =
        (*json.find("accessors")->as<Node::List>())[whole(attributes, attribute)];
    const Node& view = (*json.find("bufferViews")->as<Node::List>())[whole(accessor, "bufferView")];
    const std::size_t first = 20 + json_size + 8 + whole(view, "byteOffset");
    std::vector<T> numbers;
    for (std::size_t at = 0; at < whole(view, "byteLength"); at += sizeof(T)) {
        numbers.push_back(little_endian_at<T>(bytes, first + at));
    }
    return numbers;
}

TEST(FieldFormats, GlbHasNumbersAndColoursOfEachVertex) {
    const std::string bytes = field_bytes("a.glb");
    // Two triangles of an organ share two vertices; two organs share none.
    EXPECT_EQ(
        glb_numbers<float>(bytes, "_ABSORBED_FLUX_PAR"),
        (std::vector<float>{0.1F, 0.1F, 0.1F, 0.1F, 2.5F, 2.5F, 2.5F}));
    EXPECT_EQ(glb_numbers<float>(bytes, "_SUNLIT_FRACTION").back(), -1) << "glTF has no NaN";
    EXPECT_EQ(glb_numbers<float>(bytes, "_ORGAN").back(), 1);
    const auto colors = glb_numbers<std::uint16_t>(bytes, "COLOR_0");
    ASSERT_EQ(colors.size(), 28U);
    EXPECT_EQ(colors[0], 65535);
    EXPECT_EQ(colors[1], 0);
    EXPECT_NEAR(colors[2], 0.2158605 * 65535, 1)
        << "half of the way on a screen is a fifth of light";
    EXPECT_EQ(colors[3], 65535);
    EXPECT_NE(bytes.find("\"_ABSORBED_FLUX_PAR\":\"W\""), std::string::npos);
    EXPECT_NE(bytes.find("{\"id\":12345678901,\"name\":\"a <leaf>\"}"), std::string::npos);
    const ReadMesh read = read_mesh_text("glb", bytes);
    EXPECT_EQ(read.faults, std::vector<std::string>{});
    EXPECT_DOUBLE_EQ(area(triangles_of(read.mesh)), 1.5);
}

}  // namespace
}  // namespace quasimc::test
