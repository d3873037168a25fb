#include "solvers/light_tracing/light_tracing.h"

#include <algorithm>

#include "solvers/block_runner.h"
#include "solvers/light_tracing/light_tracer.h"
#include "solvers/sampling_strategies.h"

namespace quasimc {
namespace {

class LightTracing final : public Solver {
  public:
    explicit LightTracing(const SolverInput& input) : tracer_(input, {}), runner_(input) {}

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        const std::uint64_t blocks = LightTracer::blocks(round);
        TaskRound tasks = executor.begin(blocks * sums->replicates.size());
        runner_.run(
            blocks, tasks, sums,
            [&](std::uint32_t replicate, std::uint64_t block, LightTracer::Scratch& scratch,
                Tally& tally) { tracer_.trace(round, replicate, block, scratch, tally); });
        sums->paths += round.count;
        sums->samples += samples_of(round);
    }

  private:
    LightTracer tracer_;
    BlockRunner<LightTracer::Scratch> runner_;
};

}  // namespace

std::unique_ptr<Solver> make_light_tracing(const SolverInput& input) {
    return std::make_unique<LightTracing>(input);
}

SumMeaning light_tracing_meaning(const PreparedScene& prepared, const RunSpec&) {
    // Paths of suns with small probabilities have the largest weights.
    double largest = 0;
    const auto& lights = prepared.lights();
    for (const BoundSource& light : lights) {
        largest = std::max(largest, light.lit_area);
    }
    return {
        .units = {.flux = lights.flux(), .sunlit_area = lights.sun_area()},
        .bounds =
            {{"direct", lights.flux()},
             {"scattered", lights.flux()},
             {"sunlit", {lights.sun_area() * largest}}},
        .strategies = strategies_by_path(prepared)};
}

bool do_light_tracing_rounds_add_up(const Scene& /*scene*/, std::uint64_t first_paths) {
    return first_paths % LightTracer::kPathsPerBlock == 0;
}

}  // namespace quasimc
