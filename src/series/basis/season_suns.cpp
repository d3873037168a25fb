// Direct light of the suns of a series by item buffers, which for the requested error cost a fifth
// of scan lines (docs/develop/notebook/time-series.md).

#include "series/basis/season_suns.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "base/parallel.h"
#include "base/stop.h"
#include "run/simulator.h"
#include "series/trace_spec.h"
#include "solvers/direct/sun_pixels.h"

namespace quasimc {
namespace {

/// Error of the direct light of suns relative to that of all other light, in the band where that is
/// largest: it increases the total error by an eighth. Where little is scattered the other errors
/// are small, and half of them would take most of the time.
constexpr double kPartOfOthers = 0.5;
/// The variance falls with this power of the number of pixels.
constexpr double kPower = 1.5;
/// Number of pixels of the pilot estimate, and limits of the number: projecting a triangle costs as
/// much as some pixels.
constexpr double kPilotPixels = 65536, kMaxPixels = 2048 * 2048, kMinPixels = 16384,
                 kMinPerTriangle = 4;

}  // namespace

SeasonSuns::SeasonSuns(
    Simulator& simulator,
    const Scene& scene,
    const RunSpec& spec,
    const BasisLayout& layout,
    std::stop_token stop)
    : simulator_(simulator),
      scene_(scene),
      spec_(spec),
      layout_(layout),
      stop_(std::move(stop)),
      pixels_(kPilotPixels) {}

void SeasonSuns::choose_pixels(
    std::span<const SunsOfTime> times, std::span<const SumWithVariance> others) {
    std::vector<double> own(layout_.bands), other(layout_.bands);
    for (std::size_t i = 0; i < times.size(); ++i) {
        const std::optional<LightResponse> suns = light_of(times.subspan(i, 1)).front();
        if (!suns) {
            continue;
        }
        LightSum direct(layout_, spec_.replicates);
        direct.add_suns(*suns, 1);
        const SumWithVariance spread = direct.spread({});
        for (std::size_t b = 0; b < layout_.bands; ++b) {
            const double light = spread.light[b] + others[i].light[b];
            if (light > 0) {
                own[b] += spread.variance[b] / (light * light);
                other[b] += others[i].variance[b] / (light * light);
            }
        }
    }
    const double allowed =
        kPartOfOthers * kPartOfOthers * *std::max_element(other.begin(), other.end());
    const double largest = *std::max_element(own.begin(), own.end());
    const double most = largest > 0 ? std::pow(largest / allowed, 1 / kPower) : 0;
    const double fewest =
        std::max(kMinPixels, kMinPerTriangle * static_cast<double>(scene_.triangle_count()));
    pixels_ = std::clamp(most * kPilotPixels, std::min(fewest, kMaxPixels), kMaxPixels);
}

std::vector<std::optional<LightResponse>> SeasonSuns::light_of(
    std::span<const SunsOfTime> times) const try {
    auto& state = SimulatorAccess::state(simulator_);
    const auto caster = state.caster_for(scene_, spec_.accelerator, stop_);
    const Sampler& sampler = state.sampler_for(spec_.sampler);
    struct SunGroup {
        RunSpec spec;
        std::unique_ptr<const PreparedScene> prepared;
        std::unique_ptr<const SunPixels> pixels;
        std::vector<SunLight> replicates;
    };
    std::vector<SunGroup> groups(times.size());
    const unsigned threads = thread_count(spec_.threads);
    parallel_blocks(times.size(), threads, [&](std::uint64_t i, unsigned) {
        throw_if_stopped(stop_);
        SunGroup& own = groups[i];
        own.spec = trace_spec(spec_, {}, times[i].trace);
        own.prepared = std::make_unique<const PreparedScene>(
            scene_, times[i].suns, spec_.start_area, caster, stop_);
        if (!own.prepared->lights().empty()) {
            own.pixels = std::make_unique<const SunPixels>(
                SolverInput{*own.prepared, sampler, own.spec, stop_}, pixels_);
            own.replicates.resize(spec_.replicates);
        }
    });
    std::vector<std::unique_ptr<ItemScratch>> scratch;
    for (unsigned i = 0; i < threads; ++i) {
        scratch.push_back(std::make_unique<ItemScratch>());
    }
    parallel_blocks(
        times.size() * spec_.replicates, threads, [&](std::uint64_t block, unsigned worker) {
            throw_if_stopped(stop_);
            SunGroup& own = groups[block / spec_.replicates];
            const auto replicate = static_cast<std::uint32_t>(block % spec_.replicates);
            if (own.pixels) {
                own.replicates[replicate] = own.pixels->find(replicate, *scratch[worker]);
            }
        });
    std::vector<std::optional<LightResponse>> found(times.size());
    parallel_blocks(times.size(), threads, [&](std::uint64_t i, unsigned) {
        if (groups[i].pixels) {
            found[i] = response_of_suns(groups[i].replicates, layout_);
        }
    });
    return found;
} catch (const StopRequested&) {
    throw Stopped(
        StopReason::interrupted, "stopped before the light of the sun positions was complete");
}

}  // namespace quasimc
