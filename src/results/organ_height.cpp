#include "results/organ_height.h"

#include <algorithm>

#include "base/vec3.h"
#include "results/groups.h"

namespace quasimc {
namespace {

std::vector<double> equal_layers(const Scene& scene, std::uint32_t layers) {
    OrganHeight all;
    for (const Organ& organ : scene.organs()) {
        if (!organ.is_ground && !is_plant(scene, organ)) {
            continue;
        }
        const OrganHeight own = height_of(scene, organ);
        all.low = std::min(all.low, organ.is_ground ? own.centroid : own.low);
        all.high = std::max(all.high, organ.is_ground ? all.high : own.high);
    }
    std::vector<double> heights;
    for (std::uint32_t i = 0; i <= layers; ++i) {
        const double part = static_cast<double>(i) / layers;
        heights.push_back(i == layers ? all.high : all.low + part * (all.high - all.low));
    }
    return heights;
}

}  // namespace

bool is_counted(const Organ& organ) {
    return organ.measured && !organ.is_ground;
}

bool is_plant(const Scene& scene, const Organ& organ) {
    return is_counted(organ) && !is_sensor(scene, organ);
}

OrganHeight height_of(const Scene& scene, const Organ& organ) {
    OrganHeight height;
    double area_sum = 0;
    double weighted = 0;
    double plain = 0;  // for an organ of no area
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        const Triangle triangle = data_of(scene).triangles()[std::size_t{organ.first_triangle} + i];
        const auto& [a, b, c] = triangle;
        const double middle = (a.z + b.z + c.z) / 3;
        const double own = area(triangle);
        area_sum += own;
        weighted += own * middle;
        plain += middle / organ.triangle_count;
        height.low = std::min({height.low, a.z, b.z, c.z});
        height.high = std::max({height.high, a.z, b.z, c.z});
    }
    height.centroid = area_sum > 0 ? weighted / area_sum : plain;
    return height;
}

std::vector<double> layer_boundaries(const Scene& scene, const GroupSpec& spec) {
    return spec.layers > 0 ? equal_layers(scene, spec.layers) : spec.layer_heights;
}

std::optional<std::size_t> layer_at(const std::vector<double>& boundaries, double height) {
    if (boundaries.size() < 2 || !(boundaries.front() <= height && height <= boundaries.back())) {
        return std::nullopt;
    }
    const auto above = std::upper_bound(boundaries.begin() + 1, boundaries.end() - 1, height);
    return static_cast<std::size_t>(above - boundaries.begin()) - 1;
}

}  // namespace quasimc
