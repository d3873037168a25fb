// The cost of a hit: each lobe model, and scattering with 1 ... 200 bands.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "optics/catalogue.h"
#include "optics/directions.h"
#include "optics/material.h"

namespace quasimc {
namespace {

constexpr std::size_t kPoints = 1024;
constexpr Vec3 kNormal{0.36, -0.48, 0.8};
constexpr Vec3 kArriving{-0.48, 0.36, -0.8};

/// Points of the unit square that defeat branch prediction: an additive recurrence, scrambled.
std::vector<std::array<double, 2>> points() {
    std::vector<std::array<double, 2>> result;
    std::uint64_t state = 1;
    const auto next = [&state] {
        state = state * 6364136223846793005U + 1442695040888963407U;
        return static_cast<double>((state ^ (state >> 29)) >> 11) * 0x1p-53;
    };
    for (std::size_t i = 0; i < kPoints; ++i) {
        const double u0 = next();
        result.push_back({u0, next()});
    }
    return result;
}

/// A leaf whose reflectance and transmittance vary over the bands. With `glossy` it also has Phong
/// lobes, of two exponents in turn.
MaterialSpec leaf(std::size_t bands, bool glossy) {
    MaterialSpec spec{"leaf", {}, {}};
    for (std::size_t b = 0; b < bands; ++b) {
        const double wave = std::sin(static_cast<double>(b));
        SideOptics optics{.reflectance = 0.45 + 0.04 * wave, .transmittance = 0.45 - 0.03 * wave};
        if (glossy) {
            optics.reflection_model = b % 2 == 0 ? "lambertian" : "phong";
            optics.reflection_parameters["exponent"] = 20;
        }
        spec.upper.push_back(optics);
        spec.lower.push_back(optics);
    }
    return spec;
}

/// The default value of every parameter, or 20 clamped to its domain.
std::vector<double> values_of(const BsdfEntry& entry) {
    std::vector<double> values;
    for (const BsdfParameter& p : entry.parameters) {
        values.push_back(p.usual.value_or(std::clamp(20.0, p.low, p.high)));
    }
    return values;
}

void sample_model(benchmark::State& state, const BsdfEntry& entry) {
    const auto bsdf = entry.make(Hemisphere::reflected, values_of(entry));
    const auto u = points();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(bsdf->sample(kNormal, kArriving, u[i][0], u[i][1]));
        i = (i + 1) % kPoints;
    }
}

void pdf_of_model(benchmark::State& state, const BsdfEntry& entry) {
    const auto bsdf = entry.make(Hemisphere::reflected, values_of(entry));
    std::vector<Vec3> outgoing;
    for (const auto& [u0, u1] : points()) {
        outgoing.push_back(cosine_direction(kNormal, u0, u1));
    }
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(bsdf->pdf(kNormal, kArriving, outgoing[i]));
        i = (i + 1) % kPoints;
    }
}

/// Calls `hit(u0, u1, weights)` repeatedly; the weights are reset to 1 after each.
template <typename Hit>
void repeat(benchmark::State& state, std::size_t bands, const Hit& hit) {
    const auto u = points();
    std::vector<double> weights(bands, 1.0);
    std::size_t i = 0;
    for (auto _ : state) {
        std::fill(weights.begin(), weights.end(), 1.0);
        benchmark::DoNotOptimize(weights.data());
        benchmark::DoNotOptimize(hit(u[i][0], u[i][1], weights));
        i = (i + 1) % kPoints;
    }
}

void scatter(benchmark::State& state, bool glossy) {
    const auto bands = static_cast<std::size_t>(state.range(0));
    const Material material = make_material(leaf(bands, glossy), bands);
    repeat(state, bands, [&](double u0, double u1, std::vector<double>& weights) {
        return material.side(SurfaceSide::upper).scatter(kNormal, kArriving, {u0, u1}, weights);
    });
}

void gather(benchmark::State& state, bool glossy) {
    const auto bands = static_cast<std::size_t>(state.range(0));
    const Material material = make_material(leaf(bands, glossy), bands);
    repeat(state, bands, [&](double u0, double u1, std::vector<double>& weights) {
        return material.gather(kNormal, SurfaceSide::upper, -kArriving, {u0, u1}, weights);
    });
}

void add_reflected(benchmark::State& state) {
    const auto bands = static_cast<std::size_t>(state.range(0));
    const Material material = make_material(leaf(bands, false), bands);
    const std::vector<double> weights(bands, 1.0);
    std::vector<double> out(bands);
    for (auto _ : state) {
        material.add_reflected(
            kNormal, SurfaceSide::upper, -kArriving, kArriving, 1.0, weights, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
}

void fast_sin_cos(benchmark::State& state) {
    const auto u = points();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(sin_cos_turn(u[i][0]));
        i = (i + 1) % kPoints;
    }
}
BENCHMARK(fast_sin_cos);

void cosine_law(benchmark::State& state) {
    const auto u = points();
    std::size_t i = 0;
    for (auto _ : state) {
        benchmark::DoNotOptimize(cosine_direction(kNormal, u[i][0], u[i][1]));
        i = (i + 1) % kPoints;
    }
}
BENCHMARK(cosine_law);

constexpr std::array<std::int64_t, 4> kBands = {1, 3, 20, 200};

void register_all() {
    for (const BsdfEntry& entry : bsdf_catalogue()) {
        const std::string name(entry.name);
        benchmark::RegisterBenchmark(("sample/" + name).c_str(), sample_model, entry);
        benchmark::RegisterBenchmark(("pdf/" + name).c_str(), pdf_of_model, entry);
    }
    for (const std::int64_t bands : kBands) {
        benchmark::RegisterBenchmark("scatter/lambertian", scatter, false)->Arg(bands);
        benchmark::RegisterBenchmark("scatter/two_exponents", scatter, true)->Arg(bands);
        benchmark::RegisterBenchmark("gather/lambertian", gather, false)->Arg(bands);
        benchmark::RegisterBenchmark("gather/two_exponents", gather, true)->Arg(bands);
        benchmark::RegisterBenchmark("add_reflected", add_reflected)->Arg(bands);
    }
}

}  // namespace
}  // namespace quasimc

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    quasimc::register_all();
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}
