// A periodic canopy: rays that are wrapped into the cell, against rays through 11 x 11 copies of
// the cell (instances). Wrapping is exact and should cost no more.

#include <array>
#include <cmath>

#include <benchmark/benchmark.h>

#include "copies.h"
#include "geometry/cast/ray_caster.h"
#include "scenes.h"

namespace quasimc::bench {

namespace {

constexpr std::size_t kPeriodicRays = 1 << 17;
constexpr double kHeight = 0.55;

enum Kind { vertical, sky, leaf, low };

std::vector<BenchRay> rays_of(Kind kind, const std::vector<Triangle>& triangles) {
    switch (kind) {
        case vertical:
            return vertical_rays(kPeriodicRays, kHeight, false);
        case sky:
            return sky_rays(kPeriodicRays, kHeight);
        case leaf:
            return leaf_rays(kPeriodicRays, triangles);
        case low:
            break;
    }
    return low_rays(kPeriodicRays, kHeight);
}

/// The mesh triangle of `caster` that is the unmoved image of `source`, for each source.
std::vector<std::uint32_t> unmoved_triangles(
    const RayCaster& caster, const std::vector<Triangle>& triangles) {
    std::vector<std::uint32_t> unmoved(triangles.size(), kNoTriangle);
    for (std::uint32_t i = 0; i < caster.mesh().triangle_count(); ++i) {
        const std::uint32_t source = caster.source(i);
        const Vec3 there = caster.mesh().to_local(triangles[source][0]);
        if (length(caster.mesh().vertex(i, 0) - there) < 1e-3) {
            unmoved[source] = i;
        }
    }
    return unmoved;
}

void wrapped(benchmark::State& state) {
    const auto triangles = plants(static_cast<std::size_t>(state.range(1)));
    const RayCaster caster(triangles, Cell{true, true, 0, 0, 1, 1}, Accelerator::embree);
    const auto unmoved = unmoved_triangles(caster, triangles);
    auto rays = rays_of(static_cast<Kind>(state.range(0)), triangles);
    for (BenchRay& ray : rays) {
        ray.origin = caster.mesh().to_local(ray.origin);
        ray.self = ray.self == kNoTriangle ? kNoTriangle : unmoved[ray.self];
    }
    std::size_t i = 0, hits = 0;
    for (auto _ : state) {
        const BenchRay& ray = rays[i++ % kPeriodicRays];
        hits += caster.cast(ray.origin, ray.direction, ray.self).end == RayEnd::hit ? 1U : 0U;
    }
    state.SetItemsProcessed(state.iterations());
    state.counters["hit"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}

void copied(benchmark::State& state) {
    const auto triangles = plants(static_cast<std::size_t>(state.range(1)));
    const Copies copies(triangles, 5);
    auto rays = rays_of(static_cast<Kind>(state.range(0)), triangles);
    for (BenchRay& ray : rays) {
        ray.origin = copies.mesh().to_local(ray.origin);
    }
    std::size_t i = 0, hits = 0;
    for (auto _ : state) {
        hits += copies.cast(rays[i++ % kPeriodicRays]) ? 1U : 0U;
    }
    state.SetItemsProcessed(state.iterations());
    state.counters["hit"] = static_cast<double>(hits) / static_cast<double>(state.iterations());
}

/// A beam in packets, with its zenith angle in degrees.
void wrapped_beam(benchmark::State& state) {
    const auto triangles = plants(static_cast<std::size_t>(state.range(1)));
    const RayCaster caster(triangles, Cell{true, true, 0, 0, 1, 1}, Accelerator::embree);
    auto rays = vertical_rays(kPeriodicRays, kHeight, true);
    const double zenith = static_cast<double>(state.range(0)) * 3.14159265358979323846 / 180;
    for (BenchRay& ray : rays) {
        ray.origin = caster.mesh().to_local(ray.origin);
        ray.direction = {std::sin(zenith) * 0.8, std::sin(zenith) * 0.6, -std::cos(zenith)};
    }
    const bool in_packets = state.range(2) != 0;
    std::size_t first = 0, hits = 0;
    std::array<RayEnd, kPacket> ends{};
    for (auto _ : state) {
        if (in_packets) {
            Packet packet = packet_of(rays, first);
            caster.cast(packet, kPacket, ends);
            for (const RayEnd end : ends) {
                hits += end == RayEnd::hit ? 1U : 0U;
            }
        } else {
            for (std::size_t i = 0; i < kPacket; ++i) {
                const BenchRay& ray = rays[first + i];
                hits += caster.cast(ray.origin, ray.direction, kNoTriangle).end == RayEnd::hit ? 1U
                                                                                               : 0U;
            }
        }
        first = (first + kPacket) % kPeriodicRays;
    }
    const auto traced = state.iterations() * static_cast<std::int64_t>(kPacket);
    state.SetItemsProcessed(traced);
    state.counters["hit"] = static_cast<double>(hits) / static_cast<double>(traced);
}

void arguments(benchmark::internal::Benchmark* benchmark) {
    benchmark->ArgNames({"kind", "leaves"});
    for (const int leaves : {600, 50000}) {
        for (const Kind kind : {vertical, sky, leaf, low}) {
            benchmark->Args({kind, leaves});
        }
    }
}

BENCHMARK(wrapped)->Apply(arguments);
BENCHMARK(copied)->Apply(arguments);
BENCHMARK(wrapped_beam)
    ->ArgNames({"zenith", "leaves", "packets"})
    ->ArgsProduct({{10, 45, 75}, {600, 50000}, {0, 1}});

}  // namespace

}  // namespace quasimc::bench
