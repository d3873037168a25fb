// The cost of a step of a coupled plant.
//
// bench_steps: the cost besides tracing, i.e. reading the queries, building the scene, answering.
// Counters are CPU seconds of all threads:
//   beyond   per step, outside the tracing (includes the scene's acceleration structure)
//   text     for reading the queries and writing the answers
//   share    beyond / whole step
//
// bench_bound: the effect of `number of rays`: steps by `auto` and by light_tracing in turn, with
// equal numbers of rays. Counters:
//   auto, light   CPU milliseconds of a step, median
//   ratio         of the two of a pair, median
//   method        that auto chose, by its index in the catalogue
//
// bench_pipe: the whole step as the plant simulator measures it, from the first byte of the queries
// written to a pipe until the last byte of the answers is read. Counters are wall-clock seconds:
//   median   of the steps
//   quickest of them, least disturbed by other programs

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>
#include <vector>

#include <unistd.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "base/process_time.h"
#include "coupling/plant_light.h"
#include "coupling/protocol/session.h"

namespace {

using namespace quasimc;

CommFile usual_format() {
    Notices silent([](const std::string&) {});
    return read_comm_text(
        "turtle position: %f %f %f\nturtle heading: %f %f %f\nturtle left: %f %f %f\n"
        "turtle up: %f %f %f\nfollowing module: yes\n",
        "comm.e", silent);
}

/// Leaves around a stem with a mutual shading independent of their number; they grow with `step`.
std::string leaves_message(std::size_t count, int step) {
    constexpr double kGoldenAngle = 2.399963229728653;
    const double width = std::cbrt(static_cast<double>(count));
    std::string text;
    for (std::size_t i = 0; i < count; ++i) {
        const double part = static_cast<double>(i) / static_cast<double>(count);
        const double angle = kGoldenAngle * static_cast<double>(i);
        const double radius = width * std::sqrt(std::fmod(part * 97, 1.0));
        const double c = std::cos(angle), s = std::sin(angle);
        text += fmt::format(
            "{} E(1)P({:g},{:g})\n {:g} {:g} {:g}\n {:g} 0.5 {:g}\n {:g} 0 {:g}\n {:g} -0.866025 "
            "{:g}\n",
            50 * i, 0.2 + 0.001 * step, 0.5, radius * c, part * width, radius * s, 0.866025 * c,
            0.866025 * s, -s, c, 0.5 * c, 0.5 * s);
    }
    return text + fmt::format("Control: 5 {}\n", step);
}

/// The light: one source; a sky of as many cells as the original program's; sky and sun of a day.
enum class Shining { sun, cells, day };

Specification specification(std::uint64_t paths, std::uint32_t runs, Shining shining) {
    constexpr std::size_t kCells = 32;
    Specification spec;
    spec.returns = {ReturnType::density};
    if (shining == Shining::sun) {
        spec.lights.push_back({{0.3, -1, 0.1}, 1});
    } else if (shining == Shining::cells) {
        spec.sky_table = plant_sky_table(kCells, kCells);
        for (std::size_t i = 0; i < kCells * kCells; ++i) {
            spec.sky_table->radiance[i] = 1 + static_cast<double>(i / kCells);
        }
    } else {
        spec.sky = SkyOfDay{.latitude_deg = 51, .longitude_deg = -114};
    }
    spec.run.paths = paths;
    spec.run.replicates = runs;
    spec.run.max_depth = 5;
    return spec;
}

/// Runs steps, each with a changed plant.
void bench_steps(benchmark::State& state) {
    const auto leaves = static_cast<std::size_t>(state.range(0));
    const auto paths = static_cast<std::uint64_t>(state.range(1));
    Notices silent([](const std::string&) {});
    PlantLight light(
        specification(paths, static_cast<std::uint32_t>(state.range(2)), Shining::sun), silent);
    MessageParser parser(usual_format());
    const std::string even = leaves_message(leaves, 0), odd = leaves_message(leaves, 1);
    double whole = 0, tracing = 0, text = 0;
    bool is_odd = false;
    for (auto _ : state) {
        const double start = process_cpu_seconds();
        Pass pass;
        static_cast<void>(parser.parse(is_odd ? odd : even, pass));
        const double parsed = process_cpu_seconds();
        Answers answers;
        light.answer(
            pass, [] {}, answers);
        const double answered = process_cpu_seconds();
        benchmark::DoNotOptimize(reply_chunks(pass, answers, 100, 1 << 30));
        const double end = process_cpu_seconds();
        whole += end - start;
        text += parsed - start + end - answered;
        tracing += light.last().results.front().solve_cpu_seconds;
        is_odd = !is_odd;
    }
    const auto steps = static_cast<double>(state.iterations());
    state.counters["beyond"] = (whole - tracing) / steps;
    state.counters["text"] = text / steps;
    state.counters["share"] = (whole - tracing) / whole;
}

BENCHMARK(bench_steps)
    ->ArgNames({"leaves", "paths", "runs"})
    ->Args({35, 4096, 1})
    ->Args({10000, 65536, 1})
    ->Args({100000, 1 << 20, 8})
    ->Unit(benchmark::kMillisecond);

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// CPU seconds per step.
double seconds_of_answer(PlantLight& light, const Pass& pass) {
    const double start = process_cpu_seconds();
    Answers answers;
    light.answer(
        pass, [] {}, answers);
    return process_cpu_seconds() - start;
}

/// Alternates steps by auto and by light_tracing with as many rays.
void bench_bound(benchmark::State& state) {
    Notices silent([](const std::string&) {});
    Specification spec = specification(
        static_cast<std::uint64_t>(state.range(1)), 1, static_cast<Shining>(state.range(2)));
    const double half = static_cast<double>(state.range(3)) / 200;  // of the albedo in percent
    for (SideOptics& side : spec.materials.front()) {
        side.reflectance = side.transmittance = half;
    }
    spec.run.threads = 1;
    Specification plain = spec;
    plain.run.method = Method::light_tracing;
    PlantLight automatic(spec, silent), light(plain, silent);
    MessageParser parser(usual_format());
    Pass pass;
    static_cast<void>(
        parser.parse(leaves_message(static_cast<std::size_t>(state.range(0)), 0), pass));
    std::vector<double> by_auto, by_light, ratios;
    for (auto _ : state) {
        by_auto.push_back(seconds_of_answer(automatic, pass));
        by_light.push_back(seconds_of_answer(light, pass));
        ratios.push_back(by_auto.back() / by_light.back());
    }
    constexpr double kMilliseconds = 1000;
    state.counters["auto"] = kMilliseconds * median_of(by_auto);
    state.counters["light"] = kMilliseconds * median_of(by_light);
    state.counters["ratio"] = median_of(ratios);
    state.counters["method"] = static_cast<double>(automatic.last().results.front().chosen.method);
}

void bound_cases(benchmark::internal::Benchmark* cases) {
    for (const auto shining : {Shining::sun, Shining::cells, Shining::day}) {
        for (const int albedo : {20, 90}) {
            for (const auto& [leaves, paths] : std::vector<std::pair<int, int>>{
                     {35, 1024},
                     {35, 65536},
                     {200, 1024},
                     {200, 4096},
                     {200, 16384},
                     {3000, 65536},
                     {100000, 65536}}) {
                cases->Args({leaves, paths, static_cast<int>(shining), albedo});
            }
        }
    }
}

BENCHMARK(bench_bound)
    ->ArgNames({"leaves", "paths", "shining", "albedo"})
    ->Apply(bound_cases)
    ->Unit(benchmark::kMillisecond);

/// A pipe that closes itself.
struct Pipe {
    Pipe() {
        if (pipe(ends.data()) != 0) {
            throw std::runtime_error("no pipe");
        }
    }
    ~Pipe() {
        close(ends[0]);
        close(ends[1]);
    }
    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;
    std::array<int, 2> ends{};
};

void write_all(int to, std::string_view text) {
    while (!text.empty()) {
        const auto written = write(to, text.data(), text.size());
        text.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(written, 0)));
    }
}

/// Reads answers up to the end of the last chunk.
void read_answers(int from) {
    std::array<char, 1 << 16> buffer{};
    std::string text;
    while (!text.ends_with("Control: 5\n") && !text.ends_with("Control: 4\n")) {
        const auto got = read(from, buffer.data(), buffer.size());
        text.append(buffer.data(), static_cast<std::size_t>(std::max<ssize_t>(got, 0)));
    }
}

double seconds_of_step(const Pipe& to, const Pipe& from, const std::string& message) {
    const auto start = std::chrono::steady_clock::now();
    write_all(to.ends[1], message);
    read_answers(from.ends[0]);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Runs steps through a pair of pipes, each with a changed plant.
void bench_pipe(benchmark::State& state) {
    const auto leaves = static_cast<std::size_t>(state.range(0));
    const auto paths = static_cast<std::uint64_t>(state.range(1));
    const Pipe to, from;
    std::jthread environment([&] {
        Notices silent([](const std::string&) {});
        PlantLight light(specification(paths, 1, static_cast<Shining>(state.range(2))), silent);
        const auto stream = make_pipe_stream(to.ends[0], from.ends[1]);
        stream->announce();
        serve(
            *stream, usual_format(),
            [&](const Pass& pass, const std::function<void()>& check, Answers& answers) {
                light.answer(pass, check, answers);
            },
            [](std::uint64_t, const std::exception_ptr& fault) {
                if (fault) {
                    std::rethrow_exception(fault);
                }
            });
    });
    const std::string even = leaves_message(leaves, 0), odd = leaves_message(leaves, 1);
    char here = 0;
    benchmark::DoNotOptimize(read(from.ends[0], &here, 1));
    std::vector<double> seconds;
    for (auto _ : state) {
        seconds.push_back(seconds_of_step(to, from, seconds.size() % 2 == 0 ? even : odd));
    }
    write_all(to.ends[1], "Control: 8\n");
    state.counters["median"] = median_of(seconds);
    state.counters["quickest"] = *std::min_element(seconds.begin(), seconds.end());
}

BENCHMARK(bench_pipe)
    ->ArgNames({"leaves", "paths", "shining"})
    ->Args({35, 4096, static_cast<int>(Shining::sun)})
    ->Args({35, 4096, static_cast<int>(Shining::cells)})
    ->Args({35, 4096, static_cast<int>(Shining::day)})
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
