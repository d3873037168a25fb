#pragma once

#include <string>
#include <string_view>

#include "files/input_files.h"
#include "meshio/formats.h"
#include "quasimc/error.h"

namespace quasimc::fuzz {

/// A folder that holds one small file of each format and nothing else, so that a fuzzer never
/// reaches the disk.
inline std::string read_small_file(const std::filesystem::path& path) {
    constexpr std::string_view kPly =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
        "0 0 0 1 0 0 0 1 0 3 0 1 2\n";
    const std::string name = path.filename().string();
    if (name == "a.tri") {
        return "0 0 0 1 0 0 0 1 0\n0 0 1 1 0 1 0 1 1\n";
    }
    if (name == "a.obj") {
        return "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\ng b\nusemtl c\nf 1 2 3\n";
    }
    if (name == "a.opf") {
        return "<opf><meshBDD><mesh Id=\"0\"><points>0 0 1 1 0 1 0 1 1</points><faces><face>0 1 "
               "2</face>"
               "</faces></mesh></meshBDD><shapeBDD><shape Id=\"0\"><meshIndex>0</meshIndex></shape>"
               "</shapeBDD><topology id=\"1\"><geometry><shapeIndex>0</shapeIndex></geometry>"
               "</topology></opf>";
    }
    if (name == "a.bin") {
        return std::string(48, '\0');
    }
    if (name == "a.mtl") {
        return "newmtl c\nKd 0.1 0.2 0.3\n";
    }
    if (name == "sky.txt") {
        return "2 2\n0 0 1\n0 0 2\n0 0 3\n0 0 4\n";
    }
    if (name == "a.ply") {
        return std::string(kPly);
    }
    if (name == "a.csv") {
        return "time,global\n2024-06-21T12:00Z,500\n2024-06-21T13:00Z,400\n";
    }
    if (name == "a.ies") {
        return "TILT=NONE\n1 1 1 2 1 1 2 0 0 0\n1 1 1\n0 90\n0\n1 0\n";
    }
    throw InputError({{path.string(), "can't be read", "", ""}});
}

/// Gives bytes to the reader of a format.
inline void read_geometry_bytes(std::string_view format, const std::string& bytes) {
    Reporter reporter{"file", {}, {}};
    InputFiles files("/fuzz", read_small_file);
    FormatContext context{reporter, files, ""};
    static_cast<void>(read_mesh(*find_format(format), bytes, context));
}

}  // namespace quasimc::fuzz
