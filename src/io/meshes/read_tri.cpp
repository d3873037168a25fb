#include <array>
#include <cmath>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/meshes/formats.h"
#include "io/numbers.h"

namespace quasimc {
namespace {

/// The triangle on a line that is not blank, or what is wrong with it.
struct Parsed {
    Triangle triangle;
    std::string problem;
};

Parsed parse_triangle(std::string_view line) {
    Parsed parsed;
    std::array<double, 9> v{};
    std::size_t count = 0;
    for (std::string_view word = take_word(line); !word.empty(); word = take_word(line), ++count) {
        const std::optional<double> number = parse_real(word);
        if (!number || !std::isfinite(*number)) {
            parsed.problem = shown(word) + " is not a finite number";
            return parsed;
        }
        if (count < v.size()) {
            v[count] = *number;
        }
    }
    if (count != v.size()) {
        parsed.problem = fmt::format("{} numbers", count);
        return parsed;
    }
    parsed.triangle = {Vec3{v[0], v[1], v[2]}, Vec3{v[3], v[4], v[5]}, Vec3{v[6], v[7], v[8]}};
    return parsed;
}

}  // namespace

MeshFile read_tri(std::string_view bytes, FormatContext& context) {
    constexpr std::size_t kShortestLine = 18;
    MeshPart part;
    Mesh mesh;
    mesh.faces.reserve(bytes.size() / (4 * kShortestLine));
    part.lines.reserve(mesh.faces.capacity());
    LineScanner scanner(bytes);
    while (scanner.next() && !context.reporter.is_full()) {
        const std::string_view line = scanner.line().substr(0, scanner.line().find('#'));
        std::string_view probe = line;
        if (take_word(probe).empty()) {
            continue;
        }
        const Parsed parsed = parse_triangle(line);
        if (parsed.problem.empty()) {
            mesh.push_back(parsed.triangle);
            part.lines.push_back(scanner.number());
        } else {
            context.reporter.fault(
                scanner.number(), parsed.problem,
                "a line holds nine numbers: x y z of three corners");
        }
    }
    part.faces = std::move(mesh.faces);
    return {{{"", {}, {std::move(part)}}}, {}, "line", std::move(mesh.vertices)};
}

}  // namespace quasimc
