#include "format_texts.h"

#include <cmath>
#include <cstdint>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "files/input_files.h"
#include "meshio/formats.h"
#include "runfile/run_file.h"

namespace quasimc::bench {
namespace {

constexpr std::size_t kColumns = 25, kRows = 20;

/// A leaf as OBJ, with points numbered from its own first.
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

std::string opf_text(const Scene& scene) {
    std::string meshes, shapes, nodes;
    for (const Organ& organ : scene.organs()) {
        std::string points, faces;
        std::size_t number = 0;
        for (const Triangle& triangle : scene.triangles_of(organ)) {
            for (const Vec3& p : triangle) {
                fmt::format_to(std::back_inserter(points), "{} {} {} ", p.x, p.y, p.z);
            }
            fmt::format_to(
                std::back_inserter(faces), "<face>{} {} {}</face>", number, number + 1, number + 2);
            number += 3;
        }
        fmt::format_to(
            std::back_inserter(meshes),
            "<mesh Id=\"{}\"><points>{}</points><faces>{}</faces></mesh>\n", organ.id, points,
            faces);
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
    std::string bytes;
    write_geometry(*find_format(format), scene, [&](std::string_view piece) { bytes += piece; });
    return bytes;
}

}  // namespace quasimc::bench
