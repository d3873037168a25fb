#include "bad_inputs.h"
#include "program.h"

namespace quasimc::test {
namespace {

/// The good run file with another geometry file.
BadInput bad_file(std::string name, std::string file, std::string bytes, std::string message) {
    return {std::move(name), "leaves.tri", file, std::move(message), file, std::move(bytes)};
}

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
    "float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
const std::string kLyingPly =
    "ply\nformat binary_little_endian 1.0\nelement vertex 4000000000\nproperty float "
    "x\nproperty float y\n"
    "property float z\nelement face 4000000000\nproperty list uint int "
    "vertex_indices\nend_header\n";

const std::vector<BadInput> kBadGeometryFiles{
    bad_file("TriEmpty", "a.tri", "", "file 'a.tri' contains no triangle"),
    bad_file("TriOnlyComments", "a.tri", "# nothing\n", "file 'a.tri' contains no triangle"),
    bad_file("TriTruncated", "a.tri", "0 0 1 1 0 1 0 1 1\n0 0 1 1 0 1 0", "a.tri:2: 7 numbers"),
    bad_file("TriTooMany", "a.tri", "0 0 1 1 0 1 0 1 1 1\n", "a.tri:1: 10 numbers"),
    bad_file("TriText", "a.tri", "0 0 1 1 0 1 0 1 one\n", "a.tri:1: 'one' is not a finite number"),
    bad_file("TriCommas", "a.tri", "0,0,1,1,0,1,0,1,1\n", "a.tri:1: "),
    bad_file("TriNan", "a.tri", "0 0 1 1 0 1 0 1 nan\n", "a.tri:1: 'nan' is not a finite number"),
    bad_file(
        "TriInfinite", "a.tri", "0 0 1 1 0 1 0 1 -inf\n", "a.tri:1: '-inf' is not a finite number"),
    bad_file(
        "TriOverflow",
        "a.tri",
        "0 0 1 1 0 1 0 1 1e400\n",
        "a.tri:1: '1e400' is not a finite number"),
    bad_file("TriHuge", "a.tri", "0 0 1 1 0 1 0 1 1e300\n", "a.tri:1"),
    bad_file(
        "TriBinary",
        "a.tri",
        std::string("\x7F\x45LF\x02\0\0\0\xff\xfe\n\n\n\x01", 14),
        "a.tri:1: "),
    bad_file("TriLongLine", "a.tri", std::string(1 << 20, '1'), "a.tri:1: "),
    bad_file("ObjEmpty", "a.obj", "", "file 'a.obj' contains no triangle"),
    bad_file(
        "ObjVertexMissing", "a.obj", "v 0 0 0\nv 1 0 0\nf 1 2 3\n", "a.obj:3: '3' is not a vertex"),
    bad_file(
        "ObjVertexZero",
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n",
        "a.obj:4: '0' is not a vertex"),
    bad_file(
        "ObjVertexBefore",
        "a.obj",
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -4 1 2\n",
        "a.obj:4: '-4' is not a vertex"),
    bad_file("ObjVertexHuge", "a.obj", "v 0 0 0\nf 1 1 9223372036854775807\n", "a.obj:2: "),
    bad_file(
        "ObjVertexNan",
        "a.obj",
        "v 0 0 nan\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "a.obj:1: 'nan' is not a finite number"),
    bad_file(
        "ObjVertexShort",
        "a.obj",
        "v 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
        "a.obj:1: a vertex with less than three numbers"),
    bad_file(
        "ObjFaceOfTwo", "a.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n", "a.obj:3: a face with 2 corners"),
    bad_file(
        "ObjUnknownStatement",
        "a.obj",
        "vertex 0 0 0\n",
        "a.obj:1: 'vertex' is not an OBJ statement"),
    bad_file(
        "ObjNameNotUtf8", "a.obj", "g Bl\xE4tter\n", "a.obj:1: the name 'Bl?tter' is not UTF-8"),
    bad_file("PlyEmpty", "a.ply", "", "a.ply:1: the first line is not 'ply'"),
    bad_file("PlyHeaderOnly", "a.ply", "ply\nformat ascii 1.0\n", "the header has no end"),
    bad_file("PlyTruncated", "a.ply", kPly + "0 0 0\n1 0 0\n", "a.ply: vertex 3 is incomplete"),
    bad_file(
        "PlyVertexMissing",
        "a.ply",
        kPly + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
        "a.ply: face 1 refers to vertex 3"),
    bad_file(
        "PlyVertexNan",
        "a.ply",
        kPly + "0 0 nan\n1 0 0\n0 1 0\n3 0 1 2\n",
        "a.ply: vertex 1 is not finite"),
    bad_file(
        "PlyLyingHeader",
        "a.ply",
        kLyingPly + std::string(100, '\0'),
        "a.ply: vertex 9 is incomplete"),
    bad_file(
        "PlyLyingList",
        "a.ply",
        replaced(kLyingPly, "vertex 4000000000", "vertex 1") + std::string(12, '\0') +
            "\xff\xff\xff\xff",
        "a.ply: face 1 has a list of 4294967295"),
    bad_file(
        "PlyUnknownFormat",
        "a.ply",
        "ply\nformat zip 1.0\nend_header\n",
        "a.ply:2: 'zip' is not a known format"),
};

}  // namespace

std::vector<BadInput> bad_geometry_files() {
    return kBadGeometryFiles;
}

}  // namespace quasimc::test
