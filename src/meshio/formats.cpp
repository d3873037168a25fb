#include "meshio/formats.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "base/length_units.h"
#include "geometry/shapes/shapes.h"
#include "text/line_scanner.h"

namespace quasimc {

// To add a format of geometry, tools/new.py format NAME makes read_name.cpp, its test and
// docs/reference/name.md, and enters the format in this table, the only list of formats: the
// `format` key of the run file, the choice by extension, `quasimc list formats`, `quasimc convert`
// (of a format that has a writer), the messages and the fuzz target all follow from the row
// (tests/fuzz/CMakeLists.txt reads the names). Files that once broke a reader go to
// tests/fuzz/corpus/name/.

// (tools/new.py declares a format above this line)

// NOLINTNEXTLINE(readability-function-size): a table
std::span<const FormatEntry> format_table() {
    constexpr double kCentimetre = 0.01;
    static constexpr std::array kTable{
        FormatEntry{
            .name = "tri",
            .extensions = ".tri .txt",
            .summary = "nine numbers in a line: the corners of a triangle",
            .organs = "each",
            .read = read_tri,
            .write = write_tri},
        FormatEntry{
            .name = "obj",
            .extensions = ".obj",
            .summary = "Wavefront OBJ with MTL; objects and groups are organs",
            .keeps = "names, materials, labels",
            .read = read_obj,
            .write = write_obj},
        FormatEntry{
            .name = "ply",
            .extensions = ".ply",
            .summary = "Stanford PLY, text or binary; faces may have an organ and a material",
            .keeps = "ids, materials",
            .read = read_ply,
            .write = write_ply},
        FormatEntry{
            .name = "stl",
            .extensions = ".stl",
            .summary = "STL, text or binary; solids are organs",
            .keeps = "names",
            .read = read_stl,
            .write = write_stl},
        FormatEntry{
            .name = "can",
            .extensions = ".can",
            .summary = "Caribu; polygons with one label are an organ",
            .keeps = "Caribu ids, optical species",
            .read = read_can,
            .write = write_can},
        FormatEntry{
            .name = "opf",
            .extensions = ".opf",
            .summary = "AMAP's open plant format; nodes with a shape are organs",
            .keeps = "ids, names, materials, labels",
            .read = read_opf,
            .plant_metres = kCentimetre},
        FormatEntry{
            .name = "gwa",
            .extensions = ".gwa",
            .summary = "AMAP's meshes of pavements and other objects; each is an organ",
            .keeps = "ids, names, colours as materials",
            .read = read_gwa,
            .plant_metres = kCentimetre},
        FormatEntry{
            .name = "ops",
            .extensions = ".ops",
            .summary = "AMAP's open plant scene: plants and their positions",
            .keeps = "names, materials, labels",
            .read = read_ops,
            .has_units = true},
        FormatEntry{
            .name = "fasttracer",
            .extensions = ".fasttracer",
            .summary = "fastTracer's 17 columns; triangles with the same five ids are an organ",
            .keeps = "names, materials, labels",
            .read = read_fasttracer},
        FormatEntry{
            .name = "def",
            .extensions = ".def",
            .summary = "RAMI's leaves: radius, centre and normal of a disk on each line",
            .read = read_def},
        FormatEntry{
            .name = "glb",
            .extensions = ".glb",
            .summary = "binary glTF 2.0; nodes with a mesh are organs",
            .keeps = "ids, names, materials, labels",
            .read = read_gltf,
            .write = write_glb,
            .has_units = true,
            .precision = 0x1p-23},
        FormatEntry{
            .name = "gltf",
            .extensions = ".gltf",
            .summary = "glTF 2.0 with files beside it or embedded; nodes with a mesh are organs",
            .keeps = "ids, names, materials, labels",
            .read = read_gltf,
            .has_units = true},
        FormatEntry{
            .name = "vgx",
            .extensions = ".vgx .vgs",
            .summary = "VegeSTAR's and RATP's table of objects; each is an organ",
            .keeps = "labels, colours as materials",
            .read = read_vgx},
        // (tools/new.py enters a format above this line)
    };
    return kTable;
}

void write_geometry(const FormatEntry& format, const Scene& scene, const TextSink& sink) {
    if (format.write == nullptr) {
        throw InputError(
            {{"", fmt::format("format {} can be read, not written", format.name), "",
              fmt::format("use {}", fmt::join(writable_formats(), ", "))}});
    }
    format.write(scene, sink);
}

double FormatContext::units_per_metre() {
    const std::optional<double> metres = metres_per(length_unit);
    if (!metres) {
        reporter.warn(fmt::format(
            "its lengths are in metres, and the length of the scene's unit '{}' is unknown: they "
            "are not converted",
            one_line(length_unit)));
    }
    return 1 / metres.value_or(1);
}

std::vector<Triangle> face_triangles(std::span<const Vec3> corners) {
    constexpr std::size_t kTriangle = 3;
    return corners.size() == kTriangle ? make_triangle(corners[0], corners[1], corners[2])
                                       : make_polygon(corners);
}

void CrossedFaces::add(std::string_view word, std::uint64_t number) {
    first = count++ == 0 ? fmt::format("{} {}", word, number) : first;
}

void CrossedFaces::warn(Reporter& reporter) const {
    if (count > 0) {
        reporter.warn(fmt::format(
            "{} faces have sides that intersect, the first is {}; each is divided into triangles "
            "from its first corner",
            count, first));
    }
}

bool MeshPart::add_face(
    std::span<const Vec3> corners, std::span<const std::uint32_t> numbers, std::uint32_t line) {
    constexpr std::size_t kTriangle = 3;
    bool sides_cross = false;
    if (corners.size() == kTriangle) {
        faces.push_back({numbers[0], numbers[1], numbers[2]});
    } else {
        const CutPolygon cut = cut_polygon(corners);
        sides_cross = cut.sides_cross;
        for (const auto& [a, b, c] : cut.faces) {
            faces.push_back({numbers[a], numbers[b], numbers[c]});
        }
    }
    lines.resize(faces.size(), line);
    return sides_cross;
}

MeshPart& MeshGroup::part(const std::string& material) {
    const auto known = std::find_if(parts.begin(), parts.end(), [&](const MeshPart& part) {
        return part.material == material;
    });
    return known != parts.end() ? *known : parts.emplace_back(MeshPart{material, {}, {}});
}

namespace {

/// Takes the vertices that a few faces name out of many.
class VertexPicker {
  public:
    explicit VertexPicker(const std::vector<Vec3>& vertices)
        : vertices_(vertices), numbers_(vertices.size(), kNone) {}

    Mesh pick(std::vector<Face> faces) {
        Mesh mesh;
        taken_.clear();
        for (Face& face : faces) {
            for (std::uint32_t& vertex : face) {
                if (numbers_[vertex] == kNone) {
                    numbers_[vertex] = static_cast<std::uint32_t>(taken_.size());
                    taken_.push_back(vertex);
                }
                vertex = numbers_[vertex];
            }
        }
        mesh.faces = std::move(faces);
        mesh.vertices.reserve(taken_.size());
        for (const std::uint32_t vertex : taken_) {
            mesh.vertices.push_back(vertices_[vertex]);
            numbers_[vertex] = kNone;
        }
        return mesh;
    }

  private:
    static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

    const std::vector<Vec3>& vertices_;
    std::vector<std::uint32_t> numbers_;  // in the mesh being made
    std::vector<std::uint32_t> taken_;
};

}  // namespace

std::vector<Mesh> MeshFile::take_meshes() {
    std::vector<Mesh> meshes;
    if (groups.size() == 1 && groups.front().parts.size() == 1) {
        Mesh& mesh = meshes.emplace_back();
        mesh.vertices = std::move(vertices);
        mesh.faces = std::move(groups.front().parts.front().faces);
        return meshes;
    }
    VertexPicker picker(vertices);
    for (MeshGroup& group : groups) {
        for (MeshPart& part : group.parts) {
            meshes.push_back(picker.pick(std::move(part.faces)));
        }
    }
    vertices = {};
    return meshes;
}

}  // namespace quasimc
