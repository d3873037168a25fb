// Time for reading and writing a million triangles, in OPF and in the writable formats.

#include "meshio/formats.h"

#include <string>

#include <benchmark/benchmark.h>

#include "format_texts.h"

namespace quasimc::bench {
namespace {

constexpr std::size_t kLeaves = 1000;

const Scene& scene() {
    static const Scene made = leaves(kLeaves);
    return made;
}

/// Reads bytes into meshes of organs.
void read_format(benchmark::State& state, const FormatEntry& format) {
    const std::string bytes = text_of(format.name, scene());
    std::size_t triangles = 0;
    for ([[maybe_unused]] auto _ : state) {
        Reporter reporter{"file", {}, {}};
        InputFiles files("/");
        FormatContext context{reporter, files, ""};
        MeshFile file = read_mesh(format, bytes, context);
        triangles = 0;
        for (const Mesh& mesh : file.take_meshes()) {
            triangles += mesh.faces.size();
        }
        if (!reporter.faults.empty()) {
            state.SkipWithError("it has errors");
        }
    }
    state.counters["triangles"] = static_cast<double>(triangles);
    state.counters["megabytes"] = static_cast<double>(bytes.size()) / 1e6;
}

void write_format(benchmark::State& state, const FormatEntry& format) {
    std::size_t size = 0;
    for ([[maybe_unused]] auto _ : state) {
        size = 0;
        format.write(scene(), [&](std::string_view piece) { size += piece.size(); });
    }
    state.counters["megabytes"] = static_cast<double>(size) / 1e6;
}

int run_all(int count, char** words) {
    for (const FormatEntry& format : format_table()) {
        if (format.name != "opf" && format.write == nullptr) {
            continue;
        }
        const std::string name(format.name);
        benchmark::RegisterBenchmark(("read/" + name).c_str(), [&format](benchmark::State& state) {
            read_format(state, format);
        })->Unit(benchmark::kMillisecond);
        if (format.write != nullptr) {
            benchmark::RegisterBenchmark(
                ("write/" + name).c_str(),
                [&format](benchmark::State& state) { write_format(state, format); })
                ->Unit(benchmark::kMillisecond);
        }
    }
    benchmark::Initialize(&count, words);
    benchmark::RunSpecifiedBenchmarks();
    return 0;
}

}  // namespace
}  // namespace quasimc::bench

int main(int count, char** words) {
    return quasimc::bench::run_all(count, words);
}
