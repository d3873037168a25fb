#pragma once

#include <map>
#include <string>
#include <vector>

#include "meshio/formats.h"
#include "runfile/run_file.h"

namespace quasimc::test {

/// Files that are not on any disk, by name.
using FakeFiles = std::map<std::string, std::string>;

/// The parts of a run file that has no fault: a band PAR, a sun, a black material "leaf", a
/// triangle.
struct RunText {
    std::string top = "bands = ['PAR']\n";
    std::string run;
    std::string sources =
        "[[source]]\ntype = 'directional'\ndirection = [0, 0, -1]\nirradiance_facing = 1\n";
    std::string materials = "[[material]]\nname = 'leaf'\nreflectance = 0\n";
    std::string organs =
        "[[organ]]\nmaterial = 'leaf'\nshape = 'triangle'\n"
        "corners = [[0, 0, 1], [1, 0, 1], [0, 1, 1]]\n";
    std::string rest;

    [[nodiscard]] std::string text() const {
        return top + run + sources + materials + organs + rest;
    }
};

/// Reads a run file "run.toml" in the folder "/run" of fake files.
[[nodiscard]] RunFile read_text(
    const std::string& text,
    const FakeFiles& files = {},
    const std::vector<Override>& overrides = {});

/// Its faults, as printed; empty if it has none.
[[nodiscard]] std::vector<std::string> faults_of(
    const std::string& text,
    const FakeFiles& files = {},
    const std::vector<Override>& overrides = {});

/// What a reader makes of bytes, and what it says of them.
struct ReadMesh {
    MeshFile mesh;
    std::vector<std::string> faults, warnings;
};
[[nodiscard]] ReadMesh read_mesh_text(
    std::string_view format, std::string_view bytes, const FakeFiles& files = {});

/// All triangles of a file, in order.
[[nodiscard]] std::vector<Triangle> triangles_of(const MeshFile& mesh);

/// The texts of warnings, without their locations.
[[nodiscard]] std::vector<std::string> warning_texts(const std::vector<Warning>& warnings);

/// Whether one of the texts holds `part`.
[[nodiscard]] bool mentions(const std::vector<std::string>& texts, std::string_view part);

/// A file of the repository.
[[nodiscard]] std::string repository_file(const std::string& path);

}  // namespace quasimc::test
