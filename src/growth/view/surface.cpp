#include "growth/view/surface.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/text.h"
#include "growth/view/view_lines.h"
#include "quasimc/error.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Content of a surface file.
struct SurfaceFile {
    std::array<double, 6> extents{};
    double precision = 0;  ///< the S of PRECISION
    Vec3 contact, end, heading{0, 1, 0}, up{0, 0, 1};
    std::optional<double> size;
    std::vector<BezierPatch> patches;
    /// Names of the neighbours, by the name of a patch and the label AL, A, AR, L, R, BL, B or BR;
    /// "~" or "" are none.
    std::map<std::pair<std::string, std::string>, std::string> neighbours;
};

/// Reads a line of the part before the patches. @returns whether it is one
bool read_surface_keyword(ViewLines& lines, SurfaceFile& file) {
    const std::string label = lines.take_label().value_or("");
    const auto begins = [&](std::string_view keyword) { return label.starts_with(keyword); };
    if (begins("size")) {
        file.size = lines.number("the size");
        return true;
    }
    if (begins("precision")) {
        file.precision = lines.number("the precision S");
        return true;
    }
    Vec3* const vector = begins("contact point") ? &file.contact
                         : begins("end point")   ? &file.end
                         : begins("heading")     ? &file.heading
                         : begins("up ")         ? &file.up
                                                 : nullptr;
    if (vector != nullptr) {
        for (double* const coordinate : {&vector->x, &vector->y, &vector->z}) {
            *coordinate = lines.number("a coordinate");
            lines.take_label();
        }
    }
    return vector != nullptr;
}

/// Whether the next line belongs before the patches. Old files have an unused line before such
/// ones, after PRECISION.
bool is_before_keyword(ViewLines lines, SurfaceFile ignored) {
    return lines.next() && read_surface_keyword(lines, ignored);
}

/// Reads "AL: name A: name AR: name" and the like.
void read_neighbours(ViewLines& lines, const std::string& patch, SurfaceFile& file) {
    std::string* name = nullptr;
    while (lines.has_word()) {
        const std::string word(lines.word());
        if (word.ends_with(':')) {
            name = &file.neighbours[{patch, word.substr(0, word.size() - 1)}];
            name->clear();
        } else if (name != nullptr) {
            *name += (name->empty() ? "" : " ") + word;
        } else {
            lines.fail(shown(lines.line()), "neighbours are written as 'L: name R: name'");
        }
    }
}

/// Reads a patch from its name on: a line of colours, three of neighbours, and sixteen points.
void read_surface_patch(ViewLines& lines, SurfaceFile& file) {
    const std::string name = rest_of_line(lines.line());
    for (int i = 0; i < 3; ++i) {
        do {
            lines.need("the neighbours of a patch, 'AL: name A: name AR: name',");
        } while (i == 0 && !lines.line().starts_with("AL:"));
        read_neighbours(lines, name, file);
    }
    for (Vec3& p : file.patches.emplace_back()) {
        for (double* const coordinate : {&p.x, &p.y, &p.z}) {
            while (!lines.has_word()) {
                lines.need("a control point of a patch");
            }
            *coordinate = lines.number("a coordinate of a control point");
        }
    }
}

SurfaceFile read_surface_lines(ViewLines& lines) {
    lines.separate_at(kBetweenWords);
    SurfaceFile file;
    lines.need("the extents of the surface");
    for (double& extent : file.extents) {
        extent = lines.number("an extent of the surface");
    }
    bool was_precision = false;
    while (lines.next()) {
        const bool is_after_precision =
            std::exchange(was_precision, lines.line().starts_with("PRECISION"));
        const bool is_patch =
            !file.patches.empty() || (!read_surface_keyword(lines, file) &&
                                      !(is_after_precision && is_before_keyword(lines, file)));
        if (is_patch) {
            read_surface_patch(lines, file);
        }
    }
    if (file.patches.empty()) {
        lines.fail("there is no patch", "a surface needs at least one");
    }
    return file;
}

/// Whether neighbours name each other. Sends a notice if not.
bool has_mutual_neighbours(const SurfaceFile& file, const std::string& path, Notices& notices) {
    const std::map<std::string, std::string> opposites{
        {"A", "B"}, {"B", "A"}, {"L", "R"}, {"R", "L"}};
    for (const auto& [key, wanted] : file.neighbours) {
        const auto& [patch, label] = key;
        const auto opposite = opposites.find(label);
        if (opposite == opposites.end() || wanted.empty() || wanted == "~") {
            continue;
        }
        const auto back = file.neighbours.find({wanted, opposite->second});
        if (back == file.neighbours.end() || back->second != patch) {
            notices.once(fmt::format(
                "{}: the surface is ignored (patch {} names {} as its neighbour {}, but is not its "
                "{})",
                printable(one_line(path)), shown(patch), shown(wanted), label, opposite->second));
            return false;
        }
    }
    return true;
}

/// Moves the points of a file to the coordinates of the turtle, in units of the surface's size.
/// @throws InputError  if the result is not finite
void put_in_turtle_frame(SurfaceFile& file, double factor, const std::string& path) {
    const std::array<double, 6>& e = file.extents;
    const double size = file.size.value_or(std::max({e[1] - e[0], e[3] - e[2], e[5] - e[4]}));
    const double scale = factor / std::max(size, 0.0);
    const Vec3 heading = normalized(file.heading), left = normalized(cross(file.heading, file.up));
    const Vec3 up = cross(left, heading);
    const auto moved = [&](Vec3& p) {
        const Vec3 q = (p - file.contact) * scale;
        p = q.x * left + q.y * heading + q.z * up;
        if (!is_finite(p)) {
            throw InputError(
                {{path, "the surface has no size or no axes",
                  "SIZE is greater than 0, and HEADING and UP are not parallel", ""}});
        }
    };
    moved(file.end);
    for (BezierPatch& patch : file.patches) {
        std::for_each(patch.begin(), patch.end(), moved);
    }
}

/// The divisions of the view file, or the PRECISION S of the file for both directions.
/// @throws InputError
PatchDivisions surface_divisions(
    const SurfaceFile& file, PatchDivisions given, const std::string& path) {
    const bool is_given = given.s > 0 && given.t > 0;
    const double s = is_given ? given.s : file.precision, t = is_given ? given.t : s;
    const auto patches = static_cast<double>(file.patches.size());
    if (!whole_number(s) || s < 1 || patches * 2 * s * t > double{kMaxSurfaceTriangles}) {
        throw InputError(
            {{path, fmt::format("the surface has {} patches of {} x {} divisions", patches, s, t),
              fmt::format(
                  "PRECISION or the view file gives integers from 1 on, for at most {} triangles",
                  kMaxSurfaceTriangles),
              "write 'surface: x file size s t' in the view file"}});
    }
    return {static_cast<int>(s), static_cast<int>(t)};
}

Vec3 surface_patch_point(const BezierPatch& points, double s, double t) {
    const auto bernstein = [](double x) {
        const double y = 1 - x;
        return std::array<double, 4>{y * y * y, 3 * x * y * y, 3 * x * x * y, x * x * x};
    };
    const std::array<double, 4> of_rows = bernstein(s), within_rows = bernstein(t);
    Vec3 p;
    for (std::size_t i = 0; i < points.size(); ++i) {
        p += of_rows[i / 4] * within_rows[i % 4] * points[i];
    }
    return p;
}

}  // namespace

void add_patch_triangles(const BezierPatch& points, PatchDivisions divisions, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    const auto rows = static_cast<std::uint32_t>(divisions.s);
    const auto columns = static_cast<std::uint32_t>(divisions.t);
    for (std::uint32_t i = 0; i <= rows; ++i) {
        for (std::uint32_t j = 0; j <= columns; ++j) {
            mesh.vertices.push_back(surface_patch_point(
                points, static_cast<double>(i) / rows, static_cast<double>(j) / columns));
        }
    }
    for (std::uint32_t i = 0; i < rows; ++i) {
        for (std::uint32_t j = 0; j < columns; ++j) {
            const std::uint32_t a = first + i * (columns + 1) + j, b = a + columns + 1;
            mesh.faces.push_back({a, a + 1, b});
            mesh.faces.push_back({b, a + 1, b + 1});
        }
    }
}

std::optional<BezierSurface> read_surface_file(
    const NamedFile& named, double size, PatchDivisions divisions, Notices& notices) {
    ViewLines lines(named);
    SurfaceFile file = read_surface_lines(lines);
    const PatchDivisions used = surface_divisions(file, divisions, named.path);
    put_in_turtle_frame(file, size, named.path);
    if (!has_mutual_neighbours(file, named.path, notices)) {
        return std::nullopt;
    }
    BezierSurface surface;
    Mesh mesh;
    for (const BezierPatch& patch : file.patches) {
        for (const Vec3& p : patch) {
            surface.control_bounds.add(p);
        }
        add_patch_triangles(patch, used, mesh);
    }
    surface.end_point = file.end;
    surface.mesh = std::make_shared<const Mesh>(std::move(mesh));
    return surface;
}

}  // namespace quasimc
