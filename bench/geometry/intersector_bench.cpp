// Rays per second of the intersector: closest hit, packets of parallel rays, any hit.

#include "geometry/cast/intersector.h"

#include <benchmark/benchmark.h>

#include "geometry/cast/ray_caster.h"
#include "scenes.h"

namespace quasimc::bench {

namespace {

constexpr std::size_t kRays = 1 << 18;
constexpr double kLeafArea = 2.5;

/// Scene and intersector of one benchmark, and its rays in local coordinates.
struct Setting {
    RayCaster caster;
    std::vector<BenchRay> rays;

    Setting(const std::vector<Triangle>& triangles, std::vector<BenchRay> world_rays)
        : caster(triangles, Cell{}, Accelerator::embree), rays(std::move(world_rays)) {
        for (BenchRay& ray : rays) {
            ray.origin = caster.mesh().to_local(ray.origin);
        }
    }
};

void build(benchmark::State& state) {
    const auto triangles = random_leaves(static_cast<std::size_t>(state.range(0)), kLeafArea);
    const LocalMesh mesh = make_local_mesh(triangles);
    for (auto _ : state) {
        benchmark::DoNotOptimize(make_embree_intersector(mesh));
    }
}

void cast_leaf_rays(benchmark::State& state) {
    const auto triangles = random_leaves(static_cast<std::size_t>(state.range(0)), kLeafArea);
    const Setting setting(triangles, leaf_rays(kRays, triangles));
    std::size_t i = 0;
    for (auto _ : state) {
        const BenchRay& ray = setting.rays[i++ % kRays];
        benchmark::DoNotOptimize(setting.caster.cast(ray.origin, ray.direction, ray.self));
    }
    state.SetItemsProcessed(state.iterations());
}

void occluded_leaf_rays(benchmark::State& state) {
    const auto triangles = random_leaves(static_cast<std::size_t>(state.range(0)), kLeafArea);
    const Setting setting(triangles, leaf_rays(kRays, triangles));
    std::size_t i = 0;
    for (auto _ : state) {
        const BenchRay& ray = setting.rays[i++ % kRays];
        benchmark::DoNotOptimize(setting.caster.occluded(ray.origin, ray.direction, ray.self));
    }
    state.SetItemsProcessed(state.iterations());
}

void cast_vertical_rays(benchmark::State& state) {
    const auto triangles = random_leaves(static_cast<std::size_t>(state.range(0)), kLeafArea);
    const Setting setting(triangles, vertical_rays(kRays, 1.5, true));
    std::size_t i = 0;
    for (auto _ : state) {
        const BenchRay& ray = setting.rays[i++ % kRays];
        benchmark::DoNotOptimize(setting.caster.cast(ray.origin, ray.direction, kNoTriangle));
    }
    state.SetItemsProcessed(state.iterations());
}

void cast_vertical_packets(benchmark::State& state) {
    const auto triangles = random_leaves(static_cast<std::size_t>(state.range(0)), kLeafArea);
    const Setting setting(triangles, vertical_rays(kRays, 1.5, true));
    std::size_t first = 0;
    Packet packet{};
    std::array<RayEnd, kPacket> ends{};
    for (auto _ : state) {
        packet = packet_of(setting.rays, first % kRays);
        first += kPacket;
        setting.caster.cast(packet, kPacket, ends);
        benchmark::DoNotOptimize(packet.triangle);
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(kPacket));
}

BENCHMARK(build)->Arg(1)->Arg(10000)->Arg(1000000)->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(cast_leaf_rays)->Arg(500)->Arg(10000)->Arg(1000000);
BENCHMARK(occluded_leaf_rays)->Arg(500)->Arg(10000)->Arg(1000000);
BENCHMARK(cast_vertical_rays)->Arg(500)->Arg(10000)->Arg(1000000);
BENCHMARK(cast_vertical_packets)->Arg(500)->Arg(10000)->Arg(1000000);

}  // namespace

}  // namespace quasimc::bench

BENCHMARK_MAIN();
