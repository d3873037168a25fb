#include "format_texts.h"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "io/input_files.h"
#include "io/meshes/formats.h"
#include "io/runfile/run_file.h"

namespace quasimc::bench {
namespace {

constexpr std::size_t kColumns = 25, kRows = 20;

/// A leaf as OBJ, whose points are counted from `first`.
void add_leaf(std::string& obj, std::size_t number) {
    const auto to = std::back_inserter(obj);
    const double shift = static_cast<double>(number) * 0.37;
    fmt::format_to(to, "o leaf{}\nusemtl leaf\n", number);
    for (std::size_t j = 0; j <= kRows; ++j) {
        for (std::size_t i = 0; i <= kColumns; ++i) {
            const double x = 0.012 * static_cast<double>(i), y = 0.01 * static_cast<double>(j);
            fmt::format_to(
                to, "v {} {} {}\n", x + shift, y + std::fmod(shift, 7),
                0.05 * std::sin(10 * x) + 0.03 * std::cos(15 * y));
        }
    }
    for (std::size_t j = 0; j < kRows; ++j) {
        for (std::size_t i = 0; i < kColumns; ++i) {
            const std::size_t a =
                number * (kColumns + 1) * (kRows + 1) + j * (kColumns + 1) + i + 1;
            const std::size_t b = a + kColumns + 1;
            fmt::format_to(to, "f {} {} {}\nf {} {} {}\n", a, a + 1, b + 1, a, b + 1, b);
        }
    }
}

/// Points and triangles of an organ, each between marks.
struct Marks {
    std::string_view point, between_points, face, between_faces;
};

std::string points_text(const Mesh& mesh, const Marks& marks) {
    std::string text;
    for (const Vec3& p : mesh.vertices) {
        text += text.empty() ? "" : marks.between_points;
        fmt::format_to(std::back_inserter(text), fmt::runtime(marks.point), p.x, p.y, p.z);
    }
    return text;
}

std::string faces_text(const Mesh& mesh, const Marks& marks) {
    std::string text;
    for (const auto& [a, b, c] : mesh.faces) {
        text += text.empty() ? "" : marks.between_faces;
        fmt::format_to(std::back_inserter(text), fmt::runtime(marks.face), a, b, c);
    }
    return text;
}

/// The triangles of an organ, with the points that they share.
Mesh mesh_of(const Scene& scene, const Organ& organ) {
    Mesh mesh;
    for (const Triangle& triangle : scene.triangles_of(organ)) {
        const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
        mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
        mesh.faces.push_back({first, first + 1, first + 2});
    }
    return mesh;
}

std::string opf_text(const Scene& scene) {
    const Marks marks{"{} {} {}", " ", "<face>{} {} {}</face>", ""};
    std::string meshes, shapes, nodes;
    for (const Organ& organ : scene.organs()) {
        const Mesh mesh = mesh_of(scene, organ);
        fmt::format_to(
            std::back_inserter(meshes),
            "<mesh Id=\"{}\"><points>{}</points><faces>{}</faces></mesh>\n", organ.id,
            points_text(mesh, marks), faces_text(mesh, marks));
        fmt::format_to(
            std::back_inserter(shapes), "<shape Id=\"{0}\"><meshIndex>{0}</meshIndex></shape>\n",
            organ.id);
        fmt::format_to(
            std::back_inserter(nodes),
            "<decomp class=\"Leaf\" id=\"{0}\"><geometry><shapeIndex>{0}</shapeIndex><mat>1 0 0 0 "
            "0 1 0 0 0 0 1 0</mat></geometry></decomp>\n",
            organ.id);
    }
    return "<opf><meshBDD>" + meshes + "</meshBDD><shapeBDD>" + shapes +
           "</shapeBDD><topology class=\"Plant\" id=\"0\">" + nodes + "</topology></opf>";
}

std::string fasttracer_text(const Scene& scene) {
    std::string text;
    for (const Organ& organ : scene.organs()) {
        for (const auto& [a, b, c] : scene.triangles_of(organ)) {
            fmt::format_to(
                std::back_inserter(text), "1 1 1 1 {} {} {} {} {} {} {} {} {} {} 1 0.1 0.1\n",
                organ.id, a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
        }
    }
    return text;
}

std::string vgx_text(const Scene& scene) {
    std::string text = "Obj\tR\tG\tB\tX1\tY1\tZ1\tX2\tY2\tZ2\tX3\tY3\tZ3\tGrp1\n";
    for (const Organ& organ : scene.organs()) {
        for (const auto& [a, b, c] : scene.triangles_of(organ)) {
            fmt::format_to(
                std::back_inserter(text), "0\t30\t90\t60\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\t{}\n",
                a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, organ.id);
        }
    }
    return text;
}

/// A disk of twelve triangles for every twelve.
std::string def_text(const Scene& scene) {
    constexpr std::size_t kSides = 12;
    std::string text;
    std::size_t count = 0;
    for (const Triangle& triangle : scene.triangles()) {
        if (count++ % kSides == 0) {
            fmt::format_to(
                std::back_inserter(text), "0.05 {} {} {} 0 0.6 0.8\n", triangle[0].x, triangle[0].y,
                triangle[0].z);
        }
    }
    return text;
}

}  // namespace

Scene leaves(std::size_t count) {
    std::string obj;
    for (std::size_t i = 0; i < count; ++i) {
        add_leaf(obj, i);
    }
    const std::string run =
        "bands = ['PAR']\n[[source]]\ntype = 'directional'\ndirection = [0, 0, -1]\n"
        "irradiance_facing = 1\n[[material]]\nname = 'leaf'\nreflectance = 0\n"
        "[[geometry]]\nfile = 'a.obj'\n";
    InputFiles files("/", [&](const std::filesystem::path&) { return obj; });
    return read_run_text(run, "run.toml", files).scene;
}

std::string text_of(std::string_view format, const Scene& scene) {
    if (format == "opf") {
        return opf_text(scene);
    }
    if (format == "fasttracer") {
        return fasttracer_text(scene);
    }
    if (format == "vgx") {
        return vgx_text(scene);
    }
    if (format == "def") {
        return def_text(scene);
    }
    std::string bytes;
    write_geometry(*find_format(format), scene, [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

}  // namespace quasimc::bench
