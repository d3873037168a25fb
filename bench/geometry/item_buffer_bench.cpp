// The cost of a beam of a sky: a scene drawn into an item buffer.

#include "raster/item_buffer.h"

#include <cmath>

#include <benchmark/benchmark.h>

#include "raster/stored_blocks.h"
#include "scenes.h"

namespace quasimc::bench {

namespace {

/// Draws random leaves in the unit cube, `range(0)` of them with about `range(1)` pixels.
void draw_leaves(benchmark::State& state, const Cell& cell) {
    const LocalMesh mesh =
        make_local_mesh(random_leaves(static_cast<std::size_t>(state.range(0)), 2.5));
    const std::vector<Vec3> outline = outline_points(mesh);
    ProjectedScene scene{.mesh = &mesh, .cell = local_cell(mesh, cell), .outline = outline};
    const std::vector<StoredBlock> blocks = stored_blocks(scene);
    scene.blocks = blocks;
    ItemScratch scratch;
    double azimuth = 0;
    for (auto _ : state) {
        azimuth += 1;
        const Vec3 direction = normalized(Vec3{std::cos(azimuth), std::sin(azimuth), -1});
        const ItemBuffer buffer =
            draw(scene, {direction, .2, .3, .6, static_cast<double>(state.range(1))}, scratch);
        benchmark::DoNotOptimize(buffer.items().data());
    }
}

void draw_items(benchmark::State& state) {
    draw_leaves(state, {});
}

void draw_items_of_cell(benchmark::State& state) {
    draw_leaves(state, {.along_x = true, .along_y = true, .size_x = 1, .size_y = 1});
}

void scenes_and_pixels(benchmark::internal::Benchmark* bench) {
    bench->Args({500, 2048})
        ->Args({500, 32768})
        ->Args({500, 1 << 20})
        ->Args({1000, 2048})
        ->Args({10000, 32768})
        ->Args({160000, 1 << 18})
        ->Unit(benchmark::kMicrosecond);
}

BENCHMARK(draw_items)->Apply(scenes_and_pixels);
BENCHMARK(draw_items_of_cell)->Apply(scenes_and_pixels);

}  // namespace

}  // namespace quasimc::bench
