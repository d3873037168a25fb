#include "geometry/shapes/shapes.h"
#include "meshio/formats.h"
#include "meshio/number_line.h"

namespace quasimc {

MeshFile read_def(std::string_view bytes, FormatContext& context) {
    constexpr std::size_t kNumbers = 7;
    constexpr int kSides = 12;
    const std::string rule = "a line contains the radius of a leaf, its centre and its normal";
    MeshFile mesh{{}, {}, "line", {}};
    const auto add_leaf = [&](const std::vector<double>& numbers, std::uint32_t number) {
        const Vec3 normal = point_at(numbers, 4);
        const double across = length(normal);
        if (!(numbers[0] > 0) || !(across > 0) || !std::isfinite(across)) {
            context.reporter.fault(
                number, "the radius or the length of the normal is not positive", rule);
            return;
        }
        const Mesh disk =
            Mesh(make_disk(point_at(numbers, 1), normal / across, numbers[0], kSides));
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        MeshPart part;
        for (const Face& face : disk.faces) {
            part.faces.push_back({first + face[0], first + face[1], first + face[2]});
        }
        part.lines.assign(part.faces.size(), number);
        mesh.vertices.insert(mesh.vertices.end(), disk.vertices.begin(), disk.vertices.end());
        mesh.groups.push_back({"", {}, {std::move(part)}});
    };
    take_number_lines(bytes, kNumbers, rule, context.reporter, add_leaf);
    return mesh;
}

}  // namespace quasimc
