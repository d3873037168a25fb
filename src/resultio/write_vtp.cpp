#include <cstdint>

#include <fmt/format.h>

#include "resultio/field_formats.h"
#include "scene/scene.h"
#include "text/line_scanner.h"
#include "text/little_endian.h"

namespace quasimc {
namespace {

std::string xml_escaped(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        switch (c) {
            case '&':
                escaped += "&amp;";
                break;
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            default:
                escaped += c;
        }
    }
    return escaped;
}

/// The arrays of the file: declared in its XML, and appended to it in the same order.
class AppendedArrays {
  public:
    /// The element of an array of `bytes` bytes.
    std::string element(
        std::string_view type, const std::string& name, int components, std::uint64_t bytes) {
        std::string text = fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" "
            "offset=\"{}\"/>\n",
            type, xml_escaped(name), components, offset_);
        offset_ += sizeof(std::uint64_t) + bytes;
        return text;
    }

  private:
    std::uint64_t offset_ = 0;
};

/// The names of the organs: VTK wants the bytes of strings as numbers, each ended by 0.
std::string names_of_organs(const Scene& scene) {
    std::string text = fmt::format(
        "<DataArray type=\"String\" Name=\"organ_names\" NumberOfTuples=\"{}\" "
        "format=\"ascii\">\n",
        scene.organs().size());
    for (const Organ& organ : scene.organs()) {
        for (const char c : one_line(organ.name)) {
            text += fmt::format("{} ", static_cast<unsigned char>(c));
        }
        text += "0\n";
    }
    return text + "</DataArray>\n";
}

std::string vtp_head(const Scene& scene, std::span<const OrganField> fields) {
    const std::uint64_t n = scene.triangle_count();
    constexpr std::uint64_t kNumber = sizeof(double);
    AppendedArrays arrays;
    std::string text =
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
        "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n<FieldData>\n" +
        names_of_organs(scene) + "</FieldData>\n" +
        fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n<Points>\n", 3 * n, n);
    text += arrays.element("Float64", "points", 3, 9 * n * kNumber) + "</Points>\n<Polys>\n";
    text += arrays.element("Int64", "connectivity", 1, 3 * n * kNumber);
    text += arrays.element("Int64", "offsets", 1, n * kNumber) + "</Polys>\n<CellData>\n";
    text += arrays.element("Int64", "organ", 1, n * kNumber);
    for (const OrganField& field : fields) {
        const std::string name =
            field.unit.empty() ? field.name : fmt::format("{} [{}]", field.name, field.unit);
        text += arrays.element("Float64", name, 1, n * kNumber);
    }
    return text + "</CellData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
}

/// One array: how many bytes it has, and then of each triangle what `append(bytes, triangle)` adds.
template <typename Append>
void write_array(
    std::size_t triangles, std::size_t numbers, const TextSink& sink, const Append& append) {
    constexpr std::size_t kChunk = 1 << 16;
    std::string bytes;
    append_little_endian(bytes, std::uint64_t{triangles * numbers * sizeof(double)});
    for (std::size_t i = 0; i < triangles; ++i) {
        append(bytes, i);
        if (bytes.size() >= kChunk) {
            sink(bytes);
            bytes.clear();
        }
    }
    sink(bytes);
}

}  // namespace

void write_vtp(const FieldScene& shown, const TextSink& sink) {
    const Scene& scene = shown.scene;
    const std::vector<OrganField>& fields = shown.fields;
    const std::size_t n = scene.triangle_count();
    const auto organ_of = [&scene](std::size_t triangle) {
        return scene.regions()[data_of(scene).region_of(static_cast<std::uint32_t>(triangle)).value]
            .organ.value;
    };
    sink(vtp_head(scene, fields));
    write_array(n, 9, sink, [&](std::string& bytes, std::size_t i) {
        for (const Vec3& corner : data_of(scene).triangles()[static_cast<std::uint32_t>(i)]) {
            const Vec3 p = scene.orientation().outward(corner);
            append_little_endian(bytes, p.x);
            append_little_endian(bytes, p.y);
            append_little_endian(bytes, p.z);
        }
    });
    write_array(3 * n, 1, sink, [](std::string& bytes, std::size_t i) {
        append_little_endian(bytes, static_cast<std::int64_t>(i));
    });
    write_array(n, 1, sink, [](std::string& bytes, std::size_t i) {
        append_little_endian(bytes, static_cast<std::int64_t>(3 * (i + 1)));
    });
    write_array(n, 1, sink, [&](std::string& bytes, std::size_t i) {
        append_little_endian(bytes, scene.organs()[organ_of(i)].id);
    });
    for (const OrganField& field : fields) {
        write_array(n, 1, sink, [&](std::string& bytes, std::size_t i) {
            append_little_endian(bytes, field.values[organ_of(i)]);
        });
    }
    sink("\n</AppendedData>\n</VTKFile>\n");
}

}  // namespace quasimc
