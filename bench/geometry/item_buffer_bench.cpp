// The cost of a beam of a sky: a scene drawn into an item buffer.

#include "raster/item_buffer.h"

#include <cmath>

#include <benchmark/benchmark.h>

#include "scenes.h"

namespace quasimc::bench {

namespace {

void draw_items(benchmark::State& state) {
    const LocalMesh mesh =
        make_local_mesh(random_leaves(static_cast<std::size_t>(state.range(0)), 2.5));
    const ProjectedScene scene{&mesh, {}};
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

BENCHMARK(draw_items)
    ->Args({500, 2048})
    ->Args({500, 32768})
    ->Args({500, 1 << 20})
    ->Args({10000, 32768})
    ->Unit(benchmark::kMicrosecond);

}  // namespace

}  // namespace quasimc::bench
