// The cost of a cross-section's points, and of its construction.

#include <benchmark/benchmark.h>

#include "raster/scene_projection.h"
#include "scenes.h"

namespace quasimc::bench {

namespace {

const Vec3 beam = normalized(Vec3{0.3, 0.2, -1});

void points(benchmark::State& state, const Cell& cell, StartArea shape) {
    const LocalMesh mesh = make_local_mesh(random_leaves(10000, 2.5));
    const SceneProjection projection(mesh, cell, shape);
    const auto region = projection.cross_section(beam);
    double u0 = 0.5, u1 = 0.5;
    for (auto _ : state) {
        u0 += 0.7548776662466927;
        u0 -= u0 >= 1 ? 1 : 0;
        u1 += 0.5698402909980532;
        u1 -= u1 >= 1 ? 1 : 0;
        benchmark::DoNotOptimize(region->point(u0, u1));
    }
    state.SetItemsProcessed(state.iterations());
}

void make_silhouette(benchmark::State& state) {
    const auto triangles = random_leaves(static_cast<std::size_t>(state.range(0)), 2.5);
    const LocalMesh mesh = make_local_mesh(triangles);
    const SceneProjection projection(mesh, Cell{}, StartArea::silhouette);
    for (auto _ : state) {
        benchmark::DoNotOptimize(projection.cross_section(beam));
    }
}

BENCHMARK_CAPTURE(points, silhouette, Cell{}, StartArea::silhouette);
BENCHMARK_CAPTURE(points, sphere, Cell{}, StartArea::bounding_sphere);
BENCHMARK_CAPTURE(points, layer, Cell{true, true}, StartArea::silhouette);
BENCHMARK(make_silhouette)->Arg(500)->Arg(10000)->Arg(1000000)->Unit(benchmark::kMillisecond);

}  // namespace

}  // namespace quasimc::bench
