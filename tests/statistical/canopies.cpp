#include "statistical/canopies.h"

#include <cmath>
#include <numbers>

#include "support/random_leaves.h"

namespace quasimc::test {
namespace {

/// The edge of an equilateral triangle.
double edge_of(double area) {
    return std::sqrt(area * 4 / std::numbers::sqrt3);
}

}  // namespace

Scene make_canopy(const CanopySpec& spec, std::uint64_t seed) {
    const double edge =
        edge_of(spec.leaf_area_index * kCellArea / static_cast<double>(spec.leaves));
    SceneBuilder builder = make_builder(spec.leaf.upper.size());
    builder.add_material(spec.leaf);
    builder.add_material(spec.soil);
    builder.add_organ(organ("canopy", spec.leaf.name, random_leaves(spec.leaves, edge, 1, seed)));
    GroundSpec soil = ground(spec.soil.name);
    soil.height = -edge;  // no leaf reaches it
    builder.set_ground(soil);
    const double size = std::sqrt(kCellArea);
    builder.set_cell({.along_x = true, .along_y = true, .size_x = size, .size_y = size});
    return std::move(builder).build();
}

Scene make_crown(std::size_t leaves, double depth, std::uint64_t seed) {
    constexpr double kRadius = .5;
    const double density = 2 * (depth / (2 * kRadius));  // leaf area per volume; k = density / 2
    const double edge = edge_of(density / static_cast<double>(leaves));
    std::vector<Triangle> inside;
    for (const Triangle& leaf : random_leaves(leaves, edge, 1, seed)) {
        const Vec3 center = (leaf[0] + leaf[1] + leaf[2]) / 3;
        if (length(center - Vec3{kRadius, kRadius, kRadius}) < kRadius) {
            inside.push_back(leaf);
        }
    }
    SceneBuilder builder = make_builder();
    builder.add_material(diffuse("black", 0, 0));
    builder.add_organ(organ("crown", "black", inside));
    return std::move(builder).build();
}

Result trace_once(
    const Scene& scene,
    const Sources& sources,
    Method from,
    std::uint64_t paths,
    std::uint64_t seed) {
    RunSpec spec = spec_of(from, paths);
    spec.replicates = 1;
    spec.seed = seed;
    return run(scene, sources, spec);
}

std::vector<Measured> over_seeds(
    unsigned seeds, const std::function<std::vector<double>(std::uint64_t)>& numbers) {
    std::vector<std::vector<double>> values;  // by number, by seed
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const std::vector<double> one = numbers(seed);
        values.resize(one.size());
        for (std::size_t i = 0; i < one.size(); ++i) {
            values[i].push_back(one[i]);
        }
    }
    std::vector<Measured> means;
    for (const std::vector<double>& v : values) {
        means.push_back(measured(v));
    }
    return means;
}

}  // namespace quasimc::test
