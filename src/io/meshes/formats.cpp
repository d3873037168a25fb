#include "io/meshes/formats.h"

#include <algorithm>
#include <array>
#include <cctype>

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
