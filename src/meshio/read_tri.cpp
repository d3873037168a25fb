#include "meshio/formats.h"
#include "meshio/number_line.h"

namespace quasimc {

MeshFile read_tri(std::string_view bytes, FormatContext& context) {
    constexpr std::size_t kShortestLine = 18;
    MeshPart part;
    Mesh mesh;
    mesh.faces.reserve(bytes.size() / (4 * kShortestLine));
    part.lines.reserve(mesh.faces.capacity());
    take_number_lines(
        bytes, 9, "a line contains nine numbers: x y z of three corners", context.reporter,
        [&](const std::vector<double>& numbers, std::uint32_t line) {
            mesh.push_back({point_at(numbers, 0), point_at(numbers, 3), point_at(numbers, 6)});
            part.lines.push_back(line);
        });
    part.faces = std::move(mesh.faces);
    return {{{"", {}, {std::move(part)}}}, {}, "line", std::move(mesh.vertices)};
}

}  // namespace quasimc
