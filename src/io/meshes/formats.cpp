#include "io/meshes/formats.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <utility>

#include "geometry/shapes/shapes.h"

namespace quasimc {

// To add a format of geometry: write read_x.cpp and write_x.cpp with functions as below, declare
// them in formats.h, add a row here, a page in docs/formats, a test in tests/unit/io and a target
// with a corpus in tests/fuzz. The `format` key of the run file, the choice by extension, `quasimc
// list formats`, `quasimc export` and the messages follow from the row.
std::span<const FormatEntry> format_table() {
    static constexpr std::array kTable{
        FormatEntry{
            "tri", ".tri .txt", "nine numbers a line: the corners of a triangle", "each", read_tri,
            write_tri},
        FormatEntry{
            "obj", ".obj", "Wavefront OBJ with MTL; objects and groups are organs", "groups",
            read_obj, write_obj},
        FormatEntry{
            "ply", ".ply", "Stanford PLY, text or binary; faces may have an organ and a material",
            "groups", read_ply, write_ply},
    };
    return kTable;
}

std::vector<Triangle> face_triangles(std::span<const Vec3> corners) {
    constexpr std::size_t kTriangle = 3;
    return corners.size() == kTriangle ? make_triangle(corners[0], corners[1], corners[2])
                                       : make_polygon(corners);
}

void MeshPart::add_face(
    std::span<const Vec3> corners, std::span<const std::uint32_t> numbers, std::uint32_t line) {
    constexpr std::size_t kTriangle = 3;
    if (corners.size() == kTriangle) {
        faces.push_back({numbers[0], numbers[1], numbers[2]});
    } else {
        for (const auto& [a, b, c] : make_polygon_faces(corners)) {
            faces.push_back({numbers[a], numbers[b], numbers[c]});
        }
    }
    lines.resize(faces.size(), line);
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

const FormatEntry* find_format(std::string_view name) {
    const std::span<const FormatEntry> table = format_table();
    const auto found = std::find_if(table.begin(), table.end(), [name](const FormatEntry& entry) {
        return entry.name == name;
    });
    return found == table.end() ? nullptr : &*found;
}

const FormatEntry* format_of_path(std::string_view path) {
    const std::size_t dot = path.rfind('.');
    if (dot == std::string_view::npos) {
        return nullptr;
    }
    std::string extension(path.substr(dot));
    std::transform(extension.begin(), extension.end(), extension.begin(), [](unsigned char c) {
        return static_cast<char>(std::tolower(c));
    });
    for (const FormatEntry& entry : format_table()) {
        std::string_view rest = entry.extensions;
        while (!rest.empty()) {
            const std::size_t end = std::min(rest.find(' '), rest.size());
            if (rest.substr(0, end) == extension) {
                return &entry;
            }
            rest.remove_prefix(std::min(end + 1, rest.size()));
        }
    }
    return nullptr;
}

}  // namespace quasimc
