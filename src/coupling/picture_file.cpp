// The organs of a step as a PLY file, coloured by the light they absorb.

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "coupling/step_files.h"
#include "files/atomic_file.h"
#include "scene/scene.h"

namespace quasimc {
namespace {

using Colour = std::array<int, 3>;

/// A colour from dark blue over green to yellow; grey where nothing was computed (NaN).
/// @param light  0 to 1; values beyond are clamped
Colour colour_of(double light) {
    if (std::isnan(light)) {
        return {128, 128, 128};
    }
    constexpr std::array<std::array<double, 3>, 4> kColours{
        {{48, 18, 110}, {33, 110, 140}, {80, 170, 70}, {250, 230, 60}}};
    const double position = std::clamp(light, 0.0, 1.0) * (kColours.size() - 1);
    const auto low = std::min<std::size_t>(static_cast<std::size_t>(position), kColours.size() - 2);
    const double part = position - static_cast<double>(low);
    Colour colour{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
        colour[i] = static_cast<int>(
            std::lround((1 - part) * kColours[low][i] + part * kColours[low + 1][i]));
    }
    return colour;
}

std::string ply_header(std::size_t triangles) {
    return fmt::format(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
        "property float z\nelement face {}\nproperty list uchar int vertex_index\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float light\n"
        "property int query\nend_header\n",
        3 * triangles, triangles);
}

}  // namespace

void write_picture_file(const StepView& view) {
    AtomicFile file(numbered_name(*view.spec.picture_file, view.step));
    if (!view.light.scene) {
        file.write(ply_header(0));
        file.commit();
        return;
    }
    const Scene& scene = *view.light.scene;
    std::string text = ply_header(scene.triangle_count());
    for (const Triangle triangle : data_of(scene).triangles()) {
        for (const Vec3& corner : triangle) {
            const Vec3 p = scene.orientation().outward(corner);
            text += fmt::format("{:.7g} {:.7g} {:.7g}\n", p.x, p.y, p.z);
        }
    }
    const double full = std::max(view.spec.irradiance.front(), 0.0);
    for (std::uint32_t i = 0; i < scene.triangle_count(); ++i) {
        const std::uint32_t organ = scene.regions()[data_of(scene).region_of(i).value].organ.value;
        const double light = view.light.at(organ, Quantity::absorbed_flux_density, 0).mean;
        const Colour c = colour_of(full > 0 ? light / full : 0);
        text += fmt::format(
            "3 {} {} {} {} {} {} {:.7g} {}\n", 3 * i, 3 * i + 1, 3 * i + 2, c[0], c[1], c[2], light,
            scene.organs()[organ].id - 1);
    }
    file.write(text);
    file.commit();
}

}  // namespace quasimc
