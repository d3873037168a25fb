// The cost of the coupling between plant and light, without both: 100 steps of a plant with 1,000
// leaves at night, so that no light is computed. Wall-clock seconds of a whole growth, the start of
// the other process included.
//
//   in_process   light in this process
//   two_programs QuasiMC as another process, over pipes
//
// Floor: both grow the plant, and read and store 100,000 queries and answers.

#include <filesystem>
#include <fstream>
#include <memory>
#include <string>

#include <unistd.h>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "base/process_time.h"
#include "coupling/plants/environment_program.h"
#include "coupling/plants/light_in_process.h"
#include "files/input_files.h"
#include "growth/plant.h"

namespace {

using namespace quasimc;

/// A plant whose leaves turn and grow, and its light at night.
constexpr std::string_view kLeafyModel =
    "lsystem: 1\nderivation length: 110\naxiom: A(0)\n"
    "A(n) : n<10 --> [&(10*n)A(10)]A(n+1)\n"
    "A(n) : n==10 --> B(0)\n"
    "B(n) : n<100 --> F(1)/(137.5)[&(60)?E(1)P(0.2,1)]B(n+1)\n"
    "P(a,b) --> P(a*1.01,b*1.01)\nendlsystem\n";
constexpr std::string_view kNight =
    "location: 50 0\ngrowth period: 0 1\njulian day: 172\nreturn type: D\nverbose: 0\n";

/// Files in a temporary folder.
class GrowthFiles {
  public:
    GrowthFiles() : folder_(fmt::format("/tmp/growth-{}", ::getpid())) {
        std::filesystem::create_directories(folder_);
        write("plant.l", kLeafyModel);
        write("night.qmc", kNight);
        write(
            "plant.e",
            fmt::format(
                "communication type: pipes\nexecutable: {} {}\nturtle position: %g %g %g\n"
                "turtle heading: %g %g %g\nturtle left: %g %g %g\nturtle up: %g %g %g\n"
                "following module: yes\n",
                QUASIMC_ENVIRONMENT, path("night.qmc")));
    }
    ~GrowthFiles() { std::filesystem::remove_all(folder_); }
    GrowthFiles(const GrowthFiles&) = delete;
    GrowthFiles& operator=(const GrowthFiles&) = delete;

    [[nodiscard]] std::string path(const std::string& name) const { return folder_ + "/" + name; }

  private:
    void write(const std::string& name, std::string_view text) const {
        std::ofstream(path(name)) << text;
    }
    std::string folder_;
};

template <typename Make>
void grow_all(benchmark::State& state, const Make& make) {
    const GrowthFiles files;
    for ([[maybe_unused]] auto unused : state) {
        Notices notices([](const std::string&) {});
        const Stopwatch watch;
        const auto model = PlantModel::read(files.path("plant.l"), "", notices);
        const std::unique_ptr<PlantEnvironment> environment = make(files, notices);
        Plant plant(model, environment.get(), notices);
        while (plant.grow()) {
        }
        state.SetIterationTime(watch.seconds());
        state.counters["modules"] = static_cast<double>(plant.string().size());
    }
}

void in_process(benchmark::State& state) {
    grow_all(state, [](const GrowthFiles& files, Notices& notices) {
        return std::make_unique<LightInProcess>(
            read_specification(files.path("night.qmc"), SpecificationKind::quasimc, notices),
            notices, [](const std::string&) {}, LightInProcess::Options{});
    });
}

void two_programs(benchmark::State& state) {
    grow_all(state, [](const GrowthFiles& files, Notices& notices) {
        const std::string file = files.path("plant.e");
        return std::make_unique<EnvironmentProgram>(
            read_comm_text(read_file(file), file, notices), file, notices);
    });
}

BENCHMARK(in_process)->UseManualTime()->Unit(benchmark::kMillisecond);
BENCHMARK(two_programs)->UseManualTime()->Unit(benchmark::kMillisecond);

}  // namespace

BENCHMARK_MAIN();
