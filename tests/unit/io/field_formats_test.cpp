#include "io/results/field_formats.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "io_testing.h"

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
    field_format_of_path(path)->write(
        field_run().scene, kFields, [&](std::string_view piece) { bytes += piece; });
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

}  // namespace
}  // namespace quasimc::test
