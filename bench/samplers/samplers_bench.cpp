// Nanoseconds per number, for every sampler of the catalogue: `random_access` draws scattered
// points and the dimensions of a path, `one_after_another` makes each draw depend on the previous
// one so that nothing overlaps, and `consecutive` fills blocks of 4096 points of one dimension.

#include <array>
#include <cstdint>
#include <memory>
#include <string>

#include <benchmark/benchmark.h>

#include "samplers/catalogue.h"

namespace quasimc {
namespace {

constexpr std::uint64_t kCount = std::uint64_t{1} << 20;
constexpr Stream kStream{.seed = 7, .sequence = 0, .replicate = 3, .first = 0, .count = kCount};
constexpr std::uint32_t kPathDimensions = 16;

void count_numbers(benchmark::State& state, std::int64_t per_iteration) {
    state.SetItemsProcessed(state.iterations() * per_iteration);
    state.counters["ns"] = benchmark::Counter(
        static_cast<double>(per_iteration) * 1e-9,
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void random_access(benchmark::State& state, const Sampler& sampler) {
    std::uint64_t point = 0;
    for (auto _ : state) {
        double sum = 0;
        for (std::uint32_t dimension = 0; dimension < kPathDimensions; ++dimension)
            sum += sampler.coordinate(kStream, point, dimension);
        benchmark::DoNotOptimize(sum);
        point = (point + 0x9e3779b1U) % kCount;
    }
    count_numbers(state, kPathDimensions);
}

void one_after_another(benchmark::State& state, const Sampler& sampler) {
    std::uint64_t point = 0;
    for (auto _ : state)
        for (std::uint32_t dimension = 0; dimension < kPathDimensions; ++dimension)
            point = static_cast<std::uint64_t>(
                sampler.coordinate(kStream, point, dimension) * static_cast<double>(kCount));
    benchmark::DoNotOptimize(point);
    count_numbers(state, kPathDimensions);
}

void consecutive(benchmark::State& state, const Sampler& sampler) {
    std::array<double, 4096> block;
    std::uint64_t point = 0;
    for (auto _ : state) {
        sampler.coordinates(kStream, point, 5, block);
        benchmark::DoNotOptimize(block.data());
        benchmark::ClobberMemory();
        point = (point + block.size()) % kCount;
    }
    count_numbers(state, static_cast<std::int64_t>(block.size()));
}

void register_all() {
    for (const SamplerEntry& entry : sampler_catalogue()) {
        const std::shared_ptr<const Sampler> sampler = entry.make();
        const auto add = [&](const char* kind, auto* run) {
            const std::string name = std::string(entry.name) + "/" + kind;
            benchmark::RegisterBenchmark(
                name.c_str(), [=](benchmark::State& state) { run(state, *sampler); });
        };
        add("random_access", random_access);
        add("one_after_another", one_after_another);
        add("consecutive", consecutive);
    }
}

}  // namespace
}  // namespace quasimc

int main(int argc, char** argv) {
    quasimc::register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv))
        return 2;
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
