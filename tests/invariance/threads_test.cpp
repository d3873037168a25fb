// The same bits on any number of threads. A light that is slow at first makes whoever draws the
// first block late, so that blocks end in another order than they began.

#include <atomic>
#include <chrono>
#include <thread>

#include "invariance/plot.h"
#include "light/models/source.h"

namespace quasimc::test {
namespace {

/// Waits once.
class FirstCallWaits {
  public:
    void wait() const {
        if (!done_.exchange(true)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
        }
    }

  private:
    mutable std::atomic<bool> done_{false};
};

class SlowEmitter final : public SourceSampler {
  public:
    explicit SlowEmitter(std::unique_ptr<SourceSampler> source_sampler)
        : SourceSampler(source_sampler->flux(), source_sampler->beam_direction()),
          emitter_(std::move(source_sampler)) {}
    [[nodiscard]] Emission emit(const std::array<double, 4>& u) const override {
        first_.wait();
        return emitter_->emit(u);
    }
    [[nodiscard]] DirectionSample draw_direction(double u0, double u1) const override {
        first_.wait();
        return emitter_->draw_direction(u0, u1);
    }
    [[nodiscard]] double density(const Vec3& direction) const override {
        return emitter_->density(direction);
    }
    void beam_origins(
        std::span<const double> u0,
        std::span<const double> u1,
        std::span<Vec3> origins) const override {
        first_.wait();
        emitter_->beam_origins(u0, u1, origins);
    }

  private:
    std::unique_ptr<SourceSampler> emitter_;
    FirstCallWaits first_;
};

/// A source that takes its time at the first path.
class SlowSource final : public SourceModel {
  public:
    explicit SlowSource(std::shared_ptr<const Source> source)
        : SourceModel(
              source->name(),
              {source->spectrum().begin(), source->spectrum().end()},
              source->traits(),
              source->horizontal_irradiance()),
          source_(std::move(source)) {}
    [[nodiscard]] ModelParameters parameters() const override {
        return model_of(*source_).parameters();
    }
    [[nodiscard]] std::unique_ptr<SourceSampler> make_sampler_in(
        const SceneProjection& projection) const override {
        return std::make_unique<SlowEmitter>(model_of(*source_).make_sampler_in(projection));
    }
    [[nodiscard]] Illumination illuminate(const Vec3& point, double u0, double u1) const override {
        first_.wait();
        return model_of(*source_).illuminate(point, u0, u1);
    }
    [[nodiscard]] double radiance(const Vec3& to_light) const override {
        return model_of(*source_).radiance(to_light);
    }
    [[nodiscard]] double most_irradiance(const Vec3& normal) const override {
        return model_of(*source_).most_irradiance(normal);
    }

  private:
    std::shared_ptr<const Source> source_;
    FirstCallWaits first_;
};

Sources slow(const Sources& sources) {
    Sources out;
    for (const auto& source : sources) {
        out.push_back(std::make_shared<SlowSource>(source));
    }
    return out;
}

class Threads : public BothWays {
  protected:
    /// Runs that differ in nothing but threads.
    void expect_the_same_bits(const Scene& scene, const Sources& sources, RunSpec spec) const {
        spec.method = GetParam();
        spec.replicates = 3;
        spec.threads = 1;
        const Result alone = run(scene, sources, spec);
        for (const unsigned threads : {2U, 7U}) {
            spec.threads = threads;
            EXPECT_TRUE(have_the_same_bits(alone, run(scene, slow(sources), spec))) << threads;
        }
    }
};

constexpr std::uint64_t kPaths = 1U << 15U;  // several blocks

TEST_P(Threads, DoNotChangeABitOfAResult) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = kPaths;
    spec.ratios = {"b0:b1"};
    expect_the_same_bits(make_plot({}), plot_sources({}), spec);
}

TEST_P(Threads, DoNotChangeABitUnderASingleSun) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = kPaths;
    expect_the_same_bits(make_plot({}), {plot_sources({})[0]}, spec);
}

TEST_P(Threads, DoNotChangeABitInAPeriodicCell) {
    RunSpec spec;
    spec.method = Method::light_tracing;
    spec.paths = kPaths;
    expect_the_same_bits(make_plot({.periodic = true}), plot_sources({}), spec);
}

TEST_P(Threads, DoNotChangeABitWhenTheyShareOneTally) {
    RunSpec spec;
    spec.paths = kPaths;
    spec.tally_memory_mb = 0;
    expect_the_same_bits(make_plot({}), plot_sources({}), spec);
}

/// So many that fewer paths depart at once.
TEST_P(Threads, DoNotChangeABitOfManyBands) {
    PlotSpec plot;
    for (std::size_t band = 0; band < 40; ++band) {
        plot.bands.push_back(band % kPlotBands);
    }
    RunSpec spec;
    spec.paths = 1U << 13U;
    expect_the_same_bits(make_plot(plot), plot_sources(plot), spec);
}

TEST_P(Threads, DoNotChangeABitOfARunThatStopsAtATarget) {
    RunSpec spec;
    spec.paths = 1U << 12U;
    spec.target_error = .05;
    spec.target_fraction = .8;
    const Scene scene = make_plot({});
    expect_the_same_bits(scene, plot_sources({}), spec);
    spec.method = GetParam();
    spec.replicates = 3;
    EXPECT_GT(run(scene, plot_sources({}), spec).paths, spec.paths) << "one round proves nothing";
}

TEST_P(Threads, PrivateAndSharedTalliesHoldTheSame) {
    RunSpec spec = spec_of(GetParam(), kPaths);
    spec.replicates = 2;
    const Scene scene = make_plot({});
    const Result privately = run(scene, plot_sources({}), spec);
    spec.tally_memory_mb = 0;
    EXPECT_TRUE(have_the_same_bits(privately, run(scene, plot_sources({}), spec)));
}

/// A control: the comparison sees the smallest change.
TEST(SameBits, AreNotFoundInRunsOfDifferentSeeds) {
    RunSpec spec = spec_of(Method::light_tracing, 256);
    const Scene scene = make_plot({});
    const Result a = run(scene, plot_sources({}), spec);
    Result b = a;
    EXPECT_TRUE(have_the_same_bits(a, b));
    b.values.back().mean = std::nextafter(b.values.back().mean, 1e9);
    EXPECT_FALSE(have_the_same_bits(a, b));
    spec.seed = 2;
    EXPECT_FALSE(have_the_same_bits(a, run(scene, plot_sources({}), spec)));
}

QUASIMC_BOTH_WAYS(Threads);

}  // namespace
}  // namespace quasimc::test
