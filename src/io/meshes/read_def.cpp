#include <fmt/format.h>

#include "geometry/shapes/shapes.h"
#include "io/meshes/formats.h"
#include "io/meshes/number_line.h"

namespace quasimc {

MeshFile read_def(std::string_view bytes, FormatContext& context) {
    constexpr std::size_t kNumbers = 7;
    constexpr int kSides = 12;
    const std::string rule = "a line holds the radius of a leaf, its centre and its normal";
    MeshFile mesh{{}, {}, "line", {}};
    LineScanner scanner(bytes);
    while (scanner.next() && !context.reporter.is_full()) {
        const std::string_view line = scanner.line().substr(0, scanner.line().find('#'));
        const std::uint32_t number = scanner.number();
        const auto numbers = numbers_of_line(line, number, rule, context.reporter);
        if (!numbers || numbers->empty()) {
            continue;
        }
        if (numbers->size() != kNumbers) {
            context.reporter.fault(number, fmt::format("{} numbers", numbers->size()), rule);
            continue;
        }
        const Vec3 normal = point_at(*numbers, 4);
        const double across = length(normal);
        if (!((*numbers)[0] > 0) || !(across > 0) || !std::isfinite(across)) {
            context.reporter.fault(number, "the radius or the normal is not more than 0", rule);
            continue;
        }
        const Mesh disk =
            Mesh(make_disk(point_at(*numbers, 1), normal / across, (*numbers)[0], kSides));
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        MeshPart part;
        for (const Face& face : disk.faces) {
            part.faces.push_back({first + face[0], first + face[1], first + face[2]});
        }
        part.lines.assign(part.faces.size(), number);
        mesh.vertices.insert(mesh.vertices.end(), disk.vertices.begin(), disk.vertices.end());
        mesh.groups.push_back({"", {}, {std::move(part)}});
    }
    return mesh;
}

}  // namespace quasimc
