#include "resultio/field_formats.h"

#include <array>

#include "base/text.h"

namespace quasimc {

// To add a format of scenes with numbers, write write_NAME.cpp and its test, and enter it here:
// `quasimc convert` and `quasimc list formats` follow from the row.
std::span<const FieldFormat> field_format_table() {
    static constexpr std::array kTable{
        FieldFormat{
            .name = "vtp",
            .extension = ".vtp",
            .summary = "VTK PolyData for ParaView and pyvista",
            .write = write_vtp},
        FieldFormat{
            .name = "ply",
            .extension = ".ply",
            .summary = "Stanford PLY with numbers as properties of faces",
            .write = write_field_ply},
        FieldFormat{
            .name = "glb",
            .extension = ".glb",
            .summary = "binary glTF for Blender and others, with numbers and colours of vertices",
            .write = write_field_glb},
    };
    return kTable;
}

const FieldFormat* find_field_format(std::string_view name) {
    for (const FieldFormat& format : field_format_table()) {
        if (format.name == name) {
            return &format;
        }
    }
    return nullptr;
}

const FieldFormat* field_format_of_path(std::string_view path) {
    const std::size_t dot = path.rfind('.');
    const std::string extension =
        lower_case(dot == std::string_view::npos ? std::string_view() : path.substr(dot));
    for (const FieldFormat& format : field_format_table()) {
        if (format.extension == extension) {
            return &format;
        }
    }
    return nullptr;
}

}  // namespace quasimc
