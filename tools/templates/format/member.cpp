// @Words@: geometry of what program, in what version. docs/formats/@page@.md
//
// Here: nine numbers a line, the corners of a triangle; `//` begins a comment.

#include <array>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/meshes/formats.h"
#include "io/line_scanner.h"
#include "io/numbers.h"

namespace quasimc {
namespace {

/// The numbers of a line; fewer than nine if one of them is none.
std::array<std::optional<double>, 9> numbers_of(std::string_view line) {
    std::array<std::optional<double>, 9> numbers;
    for (std::optional<double>& number : numbers) {
        const std::string_view word = take_word(line);
        number = word.empty() ? std::nullopt : parse_real(word);
        if (!number || !std::isfinite(*number)) {
            return {};
        }
    }
    return take_word(line).empty() ? numbers : std::array<std::optional<double>, 9>{};
}

}  // namespace

/// Reads the format `@name@` of the table.
MeshFile read_@name@(std::string_view bytes, FormatContext& context) {
    MeshPart part;
    LineScanner scanner(bytes);
    while (scanner.next() && !context.reporter.is_full()) {
        const std::string_view line = scanner.line().substr(0, scanner.line().find("//"));
        std::string_view probe = line;
        if (take_word(probe).empty()) {
            continue;
        }
        const auto v = numbers_of(line);
        if (!v[0]) {
            context.reporter.fault(
                scanner.number(), "it does not hold nine finite numbers",
                "a line holds x y z of three corners");
            continue;
        }
        part.triangles.push_back(
            {Vec3{*v[0], *v[1], *v[2]}, Vec3{*v[3], *v[4], *v[5]}, Vec3{*v[6], *v[7], *v[8]}});
        part.lines.push_back(scanner.number());
    }
    return {{{"", {}, {std::move(part)}}}, {}, "line"};
}

}  // namespace quasimc
