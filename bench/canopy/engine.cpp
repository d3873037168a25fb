#include <chrono>
#include <cstdio>
#include <numeric>

#include "bare_embree.h"
#include "parts.h"
#include "samplers/catalogue.h"
#include "scene/scene.h"
#include "scenes.h"
#include "solvers/catalogue.h"
#include "transport/prepared_scene.h"

namespace quasimc::bench {
namespace {

/// Forwards rays and stores a copy of each.
class Recorder final : public Intersector {
  public:
    Recorder(std::unique_ptr<Intersector> engine, RayLog& log)
        : engine_(std::move(engine)), log_(log) {}
    [[nodiscard]] Hit closest(const Ray& ray) const override {
        log_.rays.push_back(ray);
        return engine_->closest(ray);
    }
    void closest(Packet& packet) const override {
        log_.packets.push_back(packet);
        engine_->closest(packet);
    }
    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t except) const override {
        return engine_->occluded(ray, except);
    }

  private:
    std::unique_ptr<Intersector> engine_;
    RayLog& log_;
};

/// Traces all blocks of a round and returns the seconds it took.
double trace_all(const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec) {
    const auto solver = make_solver({prepared, sampler, spec});
    Sums sums = empty_sums(prepared, spec);
    Executor executor(1);
    const double start = thread_seconds();
    solver->solve({0, spec.paths}, executor, sums);
    return thread_seconds() - start;
}

void print_speed(std::uint32_t leaves, double albedo, const Effort& effort) {
    const Scene scene = make_canopy({leaves, {albedo}, 1});
    const Sources sources = make_light(Light::sun, 1);
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = 1U << 20U;
    spec.replicates = 1;
    const auto sampler = make_sampler(spec.sampler);
    RayLog log;
    {
        const PreparedScene recording(
            scene, sources, spec.start_area,
            std::make_shared<RayCaster>(
                data_of(scene).geometry, scene.cell(), [&](const LocalMesh& mesh) {
                    return std::make_unique<Recorder>(make_embree_intersector(mesh), log);
                }));
        static_cast<void>(trace_all(recording, *sampler, spec));
    }
    const PreparedScene stage(
        scene, sources, spec.start_area,
        std::make_shared<RayCaster>(data_of(scene).geometry, scene.cell(), spec.accelerator));
    const BareEmbree bare(stage.caster().mesh());
    std::vector<double> ratios;
    std::vector<double> engine;
    std::vector<double> loop;
    for (int repeat = 0; repeat < effort.repeats; ++repeat) {
        const double start = thread_seconds();
        bare.trace(log);
        loop.push_back(thread_seconds() - start);
        engine.push_back(trace_all(stage, *sampler, spec));
        ratios.push_back(loop.back() / engine.back());
    }
    const double rays = static_cast<double>(log.count());
    const auto paths = static_cast<double>(spec.paths);
    std::printf(
        "  %8u %6.2f %10.3f %14.2f %14.2f %14.2f %9.3f\n", leaves, albedo, rays / paths,
        1e-6 * paths / median(engine), 1e-6 * rays / median(engine), 1e-6 * rays / median(loop),
        median(ratios));
}

}  // namespace

void print_engine_speed(const Effort& effort) {
    std::printf(
        "\n== Rays per second against a bare Embree loop over the same rays (first flights in "
        "packets of "
        "16, the others "
        "single), sun, one thread, all quantities tallied\n");
    std::printf(
        "  %8s %6s %10s %14s %14s %14s %9s\n", "leaves", "albedo", "rays/path", "Mpaths/s",
        "Mrays/s", "bare Mrays/s", "ratio");
    for (const std::uint32_t leaves : {500U, 10000U, 1000000U}) {
        for (const double albedo : {0.2, 0.9}) {
            if (leaves <= effort.most_leaves) {
                print_speed(leaves, albedo, effort);
            }
        }
    }
}

void print_scaling(const Effort& effort) {
    std::printf("\n== Threads: PAR, sun, wall seconds of tracing\n");
    std::printf("  %8s %10s %10s %9s\n", "leaves", "1 thread", "2 threads", "speed-up");
    for (const std::uint32_t leaves : {500U, 10000U}) {
        const Scene scene = make_canopy({leaves, {0.2}, 1});
        RunSpec spec;
        spec.method = Method::light_tracing;
        spec.paths = 1U << 20U;
        std::vector<double> one;
        std::vector<double> two;
        std::vector<double> ratios;
        for (int repeat = 0; repeat < effort.repeats; ++repeat) {
            spec.threads = 1;
            one.push_back(run(scene, make_light(Light::sun, 1), spec).solve_seconds);
            spec.threads = 2;
            two.push_back(run(scene, make_light(Light::sun, 1), spec).solve_seconds);
            ratios.push_back(one.back() / two.back());
        }
        std::printf(
            "  %8u %10.3f %10.3f %9.2f\n", leaves, median(one), median(two), median(ratios));
    }
}

}  // namespace quasimc::bench
