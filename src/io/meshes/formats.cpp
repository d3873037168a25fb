#include "io/meshes/formats.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "geometry/shapes/shapes.h"

namespace quasimc {

// To add a format of geometry, tools/new.py format NAME makes read_name.cpp, its test and
// docs/formats/name.md, and enters the format here, the only place where one is entered: the
// `format` key of the run file, the choice by extension, `quasimc list formats`, `quasimc export`
// (of a format that has a writer), the messages and the fuzz target all follow from the row
// (tests/fuzz/CMakeLists.txt reads the names). Files that once broke a reader go to
// tests/fuzz/corpus/name/.

// (tools/new.py declares a format above this line)

std::span<const FormatEntry> format_table() {
    static constexpr std::array kTable{
        FormatEntry{
            .name = "tri",
            .extensions = ".tri .txt",
            .summary = "nine numbers a line: the corners of a triangle",
            .organs = "each",
            .read = read_tri,
            .write = write_tri},
        FormatEntry{
            .name = "obj",
            .extensions = ".obj",
            .summary = "Wavefront OBJ with MTL; objects and groups are organs",
            .organs = "groups",
            .read = read_obj,
            .write = write_obj},
        FormatEntry{
            .name = "ply",
            .extensions = ".ply",
            .summary = "Stanford PLY, text or binary; faces may have an organ and a material",
            .organs = "groups",
            .read = read_ply,
            .write = write_ply},
        // (tools/new.py enters a format above this line)
    };
    return kTable;
}

void write_geometry(const FormatEntry& format, const Scene& scene, const TextSink& sink) {
    if (format.write == nullptr) {
        std::vector<std::string_view> writable;
        for (const FormatEntry& entry : format_table()) {
            if (entry.write != nullptr) {
                writable.push_back(entry.name);
            }
        }
        throw InputError(
            {{"", fmt::format("format {} can be read, not written", format.name), "",
              fmt::format("use {}", fmt::join(writable, ", "))}});
    }
    format.write(scene, sink);
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
