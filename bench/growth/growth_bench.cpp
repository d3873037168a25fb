// The cost of growth without light, CPU seconds: derivation steps and passes of the turtle.
//
// Floor: a step reads and writes the string once. 2^20 modules A(x) are 8 MB, so 16 MB of memory
// traffic, 2 ms; the rest is the work for a module, about 15 ns for a rule without parameters and
// 45 ns with a condition and an expression.
//
//   doubling      2^20 modules by A --> AA in 20 steps, and the text of the string
//   context_free  a step of 2^20 modules A(x), x > 0 --> A(x + 1)
//   context       a step of 2^20 modules A(l) < A(x) > A(r) --> A(l + r - x)
//   branched      a step of 524,287 modules F with brackets and turns, F(l) < F(x) --> F(l + x)
//   turtle        a pass over 1.84 million modules F, turns and brackets
// Counter bytes: of the string, per module.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "base/process_time.h"
#include "growth/plant.h"

namespace {

using namespace quasimc;

/// A model in a temporary file.
class BenchModel {
  public:
    explicit BenchModel(std::string_view text)
        : path_(fmt::format("/tmp/growth-{}.l", ::getpid())) {
        std::ofstream(path_) << text;
        model_ = PlantModel::read(path_, "", notices_);
    }
    ~BenchModel() { std::filesystem::remove(path_); }
    BenchModel(const BenchModel&) = delete;
    BenchModel& operator=(const BenchModel&) = delete;

    [[nodiscard]] Plant plant() { return {model_, nullptr, notices_}; }

  private:
    std::string path_;
    Notices notices_{[](const std::string&) {}};
    std::shared_ptr<const PlantModel> model_;
};

void count_memory(benchmark::State& state, const Plant& plant) {
    state.counters["modules"] = static_cast<double>(plant.string().size());
    state.counters["bytes"] =
        4.0 * plant.string().end() / static_cast<double>(plant.string().size());
}

void doubling(benchmark::State& state) {
    BenchModel model("lsystem: 1\nderivation length: 20\naxiom: A\nA --> AA\nendlsystem\n");
    for ([[maybe_unused]] auto unused : state) {
        const double begin = process_cpu_seconds();
        Plant plant = model.plant();
        while (plant.grow()) {
        }
        benchmark::DoNotOptimize(plant.string().lines());
        state.SetIterationTime(process_cpu_seconds() - begin);
        count_memory(state, plant);
    }
}

/// Times the last step of a model.
void last_step(benchmark::State& state, std::string_view text, int steps) {
    BenchModel model(text);
    for ([[maybe_unused]] auto unused : state) {
        Plant plant = model.plant();
        while (plant.step() < steps - 1) {
            plant.grow();
        }
        const double begin = process_cpu_seconds();
        plant.grow();
        state.SetIterationTime(process_cpu_seconds() - begin);
        count_memory(state, plant);
    }
}

void context_free(benchmark::State& state) {
    last_step(
        state,
        "lsystem: 1\nderivation length: 21\naxiom: A(1)\nA(x) : Q<=20 --> A(x)A(x)\n"
        "A(x) : x>0 --> A(x+1)\nendlsystem\n",
        21);
}

void context(benchmark::State& state) {
    last_step(
        state,
        "lsystem: 1\nderivation length: 21\naxiom: A(1)\nA(x) : Q<=20 --> A(x)A(x)\n"
        "A(l) < A(x) > A(r) --> A(l+r-x)\nendlsystem\n",
        21);
}

constexpr std::string_view kTree =
    "lsystem: 1\nderivation length: 19\nignore: +-\naxiom: X(1)\n"
    "X(x) : Q<=18 --> F(x)[+(20)X(x)][-(20)X(x)]\nX(x) --> F(x)\n"
    "F(l) < F(x) : Q>18 --> F(l+x)\nendlsystem\n";

void branched(benchmark::State& state) {
    last_step(state, kTree, 19);
}

void turtle(benchmark::State& state) {
    BenchModel model(kTree);
    Plant plant = model.plant();
    while (plant.grow()) {
    }
    for ([[maybe_unused]] auto unused : state) {
        const double begin = process_cpu_seconds();
        plant.finish();
        state.SetIterationTime(process_cpu_seconds() - begin);
        count_memory(state, plant);
    }
}

BENCHMARK(doubling)->UseManualTime()->Unit(benchmark::kSecond);
BENCHMARK(context_free)->UseManualTime()->Unit(benchmark::kSecond);
BENCHMARK(context)->UseManualTime()->Unit(benchmark::kSecond);
BENCHMARK(branched)->UseManualTime()->Unit(benchmark::kSecond);
BENCHMARK(turtle)->UseManualTime()->Unit(benchmark::kSecond);

}  // namespace

BENCHMARK_MAIN();
