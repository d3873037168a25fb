#include <cmath>
#include <map>
#include <string>

#include "stress/reference.h"

namespace quasimc::stress {
namespace {

bool is_plain_model(const std::string& model) {
    return model == "lambertian" || model == "mirror";
}

/// A side of a material, by its own keys, or else those for both sides.
std::optional<PlainSide> plain_side(const Node& material, const char* name, std::size_t bands) {
    const Node* own = material.find(name);
    const Node& side = own == nullptr ? material : *own;
    const std::string reflection = text_at(side, "reflection_model", "lambertian");
    const std::string transmission = text_at(side, "transmission_model", "lambertian");
    if (!is_plain_model(reflection) || !is_plain_model(transmission)) {
        return std::nullopt;
    }
    return PlainSide{
        per_band_at(side, "reflectance", bands, 0), per_band_at(side, "transmittance", bands, 0),
        reflection == "mirror", transmission == "mirror"};
}

using Materials = std::map<std::string, std::array<PlainSide, 2>>;

std::optional<Materials> plain_materials(const Node& document, std::size_t bands) {
    Materials materials;
    for (const Node* material : tables_at(document, "material")) {
        const auto upper = plain_side(*material, "upper", bands);
        const auto lower = plain_side(*material, "lower", bands);
        if (!upper || !lower) {
            return std::nullopt;
        }
        materials[text_at(*material, "name", "")] = {*upper, *lower};
    }
    return materials;
}

void add_triangle(PlainScene& plain, const Triangle& t, std::uint32_t organ) {
    const Vec3 a = t[1] - t[0];
    const Vec3 b = t[2] - t[0];
    const Vec3 n = cross(a, b);
    if (length(n) > 0) {
        plain.triangles.push_back({t[0], a, b, normalized(n), organ});
    }
}

/// Adds all periodic copies of a triangle that may touch the cell, seen from above.
void add_images(PlainScene& plain, const Triangle& t, std::uint32_t organ) {
    const Cell& cell = plain.cell;
    const Bounds box = bounds_of(t);
    const auto first = [](double high, double low, double size) {
        return static_cast<int>(std::ceil((low - high) / size - 1e-9));
    };
    const auto last = [](double low, double high, double size) {
        return static_cast<int>(std::floor((high - low) / size + 1e-9));
    };
    const double end_x = cell.low_x + cell.size_x;
    const double end_y = cell.low_y + cell.size_y;
    for (int i = first(box.high.x, cell.low_x, cell.size_x);
         i <= last(box.low.x, end_x, cell.size_x); ++i) {
        for (int k = first(box.high.y, cell.low_y, cell.size_y);
             k <= last(box.low.y, end_y, cell.size_y); ++k) {
            const Vec3 shift{i * cell.size_x, k * cell.size_y, 0};
            add_triangle(plain, {t[0] + shift, t[1] + shift, t[2] + shift}, organ);
        }
    }
}

void add_organ_triangles(PlainScene& plain, const Scene& scene, std::uint32_t index) {
    const Organ& organ = scene.organs()[index];
    for (const Triangle& t : scene.triangles_of(organ)) {
        for (const Vec3& corner : t) {
            plain.bounds.add(corner);
        }
        if (plain.cell.periodic()) {
            add_images(plain, t, index);
        } else {
            add_triangle(plain, t, index);
        }
    }
}

}  // namespace

std::optional<PlainScene> plain_scene(const Node& document, const Scene& scene) {
    constexpr std::size_t kMaxTriangles = 150;
    PlainScene plain;
    plain.bands = scene.bands().size();
    plain.cell = scene.cell();
    const auto materials = plain_materials(document, plain.bands);
    auto emitters = emitters_of(document, scene);
    if (!materials || !emitters || plain.cell.along_x != plain.cell.along_y) {
        return std::nullopt;
    }
    plain.emitters = std::move(*emitters);
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        const Organ& organ = scene.organs()[i];
        add_organ_triangles(plain, scene, i);
        plain.materials.push_back(
            materials->at(scene.material_name(scene.regions()[organ.first_region])));
        plain.least_cosine.push_back(organ.least_cosine);
    }
    if (const Node* run = document.find("run")) {
        plain.ignores_direct = text_at(*run, "direct_light", "included") == "excluded";
        plain.max_depth = static_cast<std::uint32_t>(number_at(*run, "max_depth", 0));
    }
    const bool has_sensors = scene.material_names().back() == "sensor";
    if (plain.triangles.size() > kMaxTriangles || (has_sensors && plain.max_depth > 0)) {
        return std::nullopt;
    }
    return plain;
}

}  // namespace quasimc::stress
