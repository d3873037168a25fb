// Ray bundles: all scattered light at once.
//
// Direct light falls on patches of surfaces (solvers/ray_bundles/direct_on_patches.h). Lambertian
// surfaces scatter it equally bright in all directions, so that light need not be traced ray by
// ray: along lines in one direction through the whole scene each patch sends light to the next one,
// both ways (solvers/ray_bundles/bundle_exchange.h). Step by step all light that has not yet been
// sent on goes along lines in new directions, drawn independently of all before: the Neumann series
// of the radiosity equation, order by order, each without bias. The remainder is taken for a
// geometric series. Where direct light varies within a bright patch, rays correct the first order
// (solvers/ray_bundles/near_light.h). These steps have few lines. The sum of all exitances then
// goes along many lines once more (final gather, Reichert 1992), and the irradiance of this last
// step is the result.

#include "solvers/ray_bundles/ray_bundles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "base/checks.h"
#include "base/memory_need.h"
#include "base/stop.h"
#include "samplers/balanced_numbers.h"
#include "samplers/hash.h"
#include "scene/scene.h"
#include "solvers/block_runner.h"
#include "solvers/ray_bundles/all_bands.h"
#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/bundle_exchange.h"
#include "solvers/ray_bundles/direct_on_patches.h"
#include "solvers/ray_bundles/near_light.h"
#include "solvers/ray_bundles/suits_bundles.h"

namespace quasimc {
namespace {

/// Point sets of other purposes have smaller numbers.
constexpr std::uint64_t kBundleSequence = std::uint64_t{1} << 62U;
/// The number of near light, among those of orders.
constexpr std::uint64_t kNear = std::uint64_t{1} << 61U;

/// The numbers of random deviations.
constexpr std::uint64_t kDeviations = std::uint64_t{1} << 60U;

/// Scattered light of one replicate that reached no surface, [column]; fixed point.
struct Flow {
    std::vector<std::int64_t> escaped, cut_off;
};

/// If fewer replicates are left than there are threads, each uses several.
struct ThreadShares {
    std::atomic<std::size_t> replicates;  // remaining ones
    std::size_t workers = 1;

    [[nodiscard]] unsigned of_each() const {
        return static_cast<unsigned>(workers / std::clamp<std::size_t>(replicates, 1, workers));
    }
};

class RayBundles final : public Solver {
  public:
    explicit RayBundles(const SolverInput& input)
        : input_(input),
          beams_(input, ScatteredBy::bundles),
          runner_(input),
          bands_(SolvedBands::of(input.prepared)),
          deviations_(make_deviations()) {}

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        cut_for(round);
        beams_.raise_bounds(round, sums);
        const CountedStrategies counted(*sums);
        TaskRound replicates = executor.begin(sums->replicates.size());
        ThreadShares threads{sums->replicates.size(), executor.workers()};
        runner_.run(
            1, replicates, sums,
            [&](std::uint32_t replicate, std::uint64_t, Scratch& scratch, Tally& tally) {
                const std::vector<VisibilityTask> tasks = beams_.tasks(round, replicate);
                solve_replicate({round, tasks, counted, replicate}, threads, scratch, tally);
                --threads.replicates;
            });
        sums->paths += round.count;
        sums->samples += samples_of(round);
    }

  private:
    /// All surfaces cut into patches.
    struct Cut {
        Cut(const SolverInput& input,
            const SolvedBands& bands,
            const DirectBeams& beams,
            double patches)
            : most(patches),
              scene(
                  input.prepared,
                  bands,
                  beams.scene(),
                  make_patches(input.prepared, beams.scene().roles, patches, input.stop)),
              near(scene) {}
        double most;
        PatchScene scene;
        NearLines near;
    };

    /// Scratch memory of a worker.
    struct Scratch {
        explicit Scratch(std::size_t) {}
        DirectScratch direct;
        BundleScratch bundles;
        std::unique_ptr<PatchLight> light;
        std::vector<double> sum;  // of exitances
        std::uint64_t cut = 0;    // to which the light belongs
    };

    /// Patches become finer with the paths of all rounds: their error falls as that of lines does.
    void cut_for(const Round& round) {
        const double most = patches_for(round.first + round.count);
        if (!cut_ || cut_->most != most) {
            cut_.reset();  // two at once would take twice the memory
            ++cuts_;
            cut_ = std::make_unique<Cut>(input_, bands_, beams_, most);
        }
    }

    /// Solves the radiosity equation, order by order, for the exitance B and the irradiance E of
    /// patches: R scatters, and T exchanges light along a bundle of lines
    /// (docs/theory/ray-bundles.md).
    void solve_replicate(
        const ReplicateInput& replicate,
        const ThreadShares& threads,
        Scratch& scratch,
        Tally& tally) const {
        const auto exchange_along = [&](PatchExitance exitance, const BundleGroup& bundle,
                                        ExchangeOptions options) {
            throw_if_stopped(input_.stop);
            options.threads = threads.of_each();
            auto irradiance = exchange(std::move(exitance), bundle, options, scratch.bundles);
            count_work(bundle, irradiance.lines->segments, tally);
            return irradiance;
        };
        const SkyDirections* skies = beams_.viewed_skies();
        // B^(1) = R E_direct
        DirectOnPatches direct = score_and_deposit_direct(
            input_, beams_, replicate, memory_of(scratch), scratch.direct, tally);
        ScatteredOrder order = scatter(std::move(direct.irradiance));
        const BundleBudget budget(cut_->scene, replicate.round.count, order.flux.first);
        ExitanceSum sum(cut_->scene, scratch.sum);  // sum B = 0
        double segments = 0;
        std::vector<bool> is_surrounded;
        NearLight near;
        AllBands all(bands_, deviations_[replicate.index]);
        std::uint64_t k = 1;
        for (; goes_on(k, order.exitance); ++k) {
            // E^(k) = T_k B^(k)
            const BundleGroup bundle = budget.of_order(order.flux.last, key_of(replicate, k));
            segments += bundle.segments;
            PatchIrradiance irradiance = exchange_along(
                std::move(order.exitance), bundle, {.skies = k == 1 ? skies : nullptr});
            if (k == 1) {
                is_surrounded = surrounded_sides(*irradiance.lines);
                near = correct_near(replicate, *irradiance.light, tally);
            }
            // sum B += B^(k), B^(k+1) = R E^(k)
            order = sum.add_and_scatter(std::move(irradiance), std::move(order.flux));
        }
        // B^(k) is not sent on any more: cut off where it is not negligible
        Flow flow{
            std::vector<std::int64_t>(bands_.count()),
            fixed(flux_of(order.exitance, order.flux.last_by_column))};
        if (k == 1) {
            add_sums(RegionFlux(cut_->scene.region_areas.size(), bands_.count()), flow, all, tally);
            scratch.light = std::move(order.exitance.light);
            return;
        }
        sum.add_series(order);  // sum B += B^(k) + B^(k+1) + ... where it is
        // scattered part of E: T sum B
        PatchIrradiance irradiance = exchange_along(
            sum.exitance(std::move(order.exitance.light)),
            budget.of_all(segments, key_of(replicate, k)),
            {.skies = skies, .on_escape = [&](const Vec3& direction, auto flux) {
                 add_escaped(direction, flux, flow, all, tally);
             }});
        const std::vector<double> corrections =
            sky_view_corrections(cut_->scene, direct.open, *irradiance.lines, is_surrounded);
        tally.add(
            tally.blocks().scattered_count(),
            static_cast<std::int64_t>(irradiance.lines->segments));
        RegionFlux flux(irradiance, corrections);
        add_near(near, flux, flow, all, tally);
        add_sums(flux, flow, all, tally);
        scratch.light = std::move(irradiance.light);
    }

    void count_work(const BundleGroup& bundle, std::uint64_t segments, Tally& tally) const {
        tally.count(WorkUnit::segment, segments);
        tally.count(WorkUnit::lined_triangle, bundle.directions * cut_->scene.surfaces.size());
        tally.count(WorkUnit::patch, cut_->scene.patches.count() * bands_.count());
    }

    /// Corrects the light of the first order that goes less far than a patch is wide.
    [[nodiscard]] NearLight correct_near(
        const ReplicateInput& replicate, PatchLight& light, Tally& tally) const {
        NearLight near = trace_near_light(
            input_.prepared, cut_->near, static_cast<double>(replicate.round.count),
            key_of(replicate, kNear), light);
        tally.count(WorkUnit::ray, near.rays);
        return near;
    }

    /// Whether light of order k is exchanged.
    [[nodiscard]] bool goes_on(std::uint64_t k, const PatchExitance& exitance) const {
        const bool is_deepest = input_.spec.max_depth > 0 && k >= input_.spec.max_depth;
        return !exitance.packs.empty() && !is_deepest;
    }

    /// The flux in the bands that an exitance has; 0 in others.
    [[nodiscard]] static std::vector<double> flux_of(
        const PatchExitance& exitance, const std::vector<double>& flux) {
        std::vector<double> own(flux.size());
        for (const std::size_t pack : exitance.packs) {
            const BandPack& bands = exitance.light->packs()[pack];
            std::copy_n(&flux[bands.first], bands.bands, &own[bands.first]);
        }
        return own;
    }

    /// Memory for the light on the current patches.
    [[nodiscard]] std::unique_ptr<PatchLight> memory_of(Scratch& scratch) const {
        if (scratch.cut == cuts_ && scratch.light != nullptr) {
            return std::move(scratch.light);
        }
        scratch.light.reset();
        scratch.sum = std::vector<double>();
        scratch.cut = cuts_;
        const std::size_t patches = cut_->scene.patches.count();
        const std::size_t bands = bands_.count();
        return make_big(
            fmt::format("the light of {} patches in {} bands", patches, bands),
            bytes_of_patch_light(static_cast<double>(patches), bands), [&] {
                scratch.sum = std::vector<double>(ExitanceSum::size(cut_->scene));
                return std::make_unique<PatchLight>(cut_->scene);
            });
    }

    [[nodiscard]] std::uint64_t key_of(const ReplicateInput& replicate, std::uint64_t order) const {
        const Stream stream{
            input_.spec.seed, kBundleSequence + order, replicate.index, replicate.round.first,
            replicate.round.count};
        return stream_key(stream, replicate.round.first, 0);
    }

    /// Numbers whose mean over the replicates is 0 for each band, [replicate][band].
    [[nodiscard]] std::vector<std::vector<double>> make_deviations() const {
        const std::size_t replicates = input_.spec.replicates;
        std::vector<std::vector<double>> deviations(replicates);
        for (std::size_t b = 0; b < bands_.all(); ++b) {
            const std::uint64_t key = mix64(input_.spec.seed ^ mix64(kDeviations + b));
            const std::vector<double> of_band = balanced_numbers(replicates, key);
            for (std::size_t r = 0; r < replicates; ++r) {
                deviations[r].push_back(of_band[r]);
            }
        }
        return deviations;
    }

    static std::vector<std::int64_t> fixed(std::span<const double> flux) {
        std::vector<std::int64_t> all;
        for (const double amount : flux) {
            all.push_back(AllBands::signed_fixed(amount));
        }
        return all;
    }

    void add_escaped(
        const Vec3& direction,
        std::span<const double> flux,
        Flow& flow,
        AllBands& all,
        Tally& tally) const {
        const std::vector<std::int64_t> amounts = fixed(flux);
        for (std::size_t c = 0; c < flux.size(); ++c) {
            flow.escaped[c] += amounts[c];
        }
        const auto& detectors = input_.prepared.detectors();
        for (std::size_t i = 0; i < detectors.size(); ++i) {
            const std::span<const std::int64_t> escaped = all.of(amounts);
            for (std::size_t origin = 0; origin < bands_.origins(); ++origin) {
                detectors[i]->on_escape(
                    direction, escaped.subspan(origin * bands_.all(), bands_.all()),
                    tally.blocks().detector(i, origin), tally);
            }
        }
    }

    void add_near(
        const NearLight& near, RegionFlux& flux, Flow& flow, AllBands& all, Tally& tally) const {
        flux.add(near.on_regions);
        for (const NearLight::Escaped& light : near.escaped) {
            add_escaped(light.direction, light.flux, flow, all, tally);
        }
    }

    /// Adds the flows of a replicate. Scattered light is exactly the sum of incident, escaped and
    /// cut-off light.
    void add_sums(const RegionFlux& flux, Flow flow, AllBands& all, Tally& tally) const {
        for (std::size_t c = 0; c < bands_.count(); ++c) {
            // Negative for slivers that rounding made smaller.
            flow.escaped[c] += AllBands::signed_fixed(flux.missed()[c]);
        }
        const ScatteredBlocks& blocks = tally.blocks().scattered_blocks();
        const auto add = [&](std::size_t first, const std::vector<std::int64_t>& amounts) {
            for (std::size_t b = 0; b < amounts.size(); ++b) {
                tally.add_signed(first + b, amounts[b]);
            }
        };
        const auto add_scattered = [&](std::size_t first,
                                       const std::vector<std::int64_t>& amounts) {
            add(first, amounts);
            add(blocks.scattered_out.bin(0), amounts);
        };
        for (std::uint32_t region = 0; region < input_.prepared.scene().regions().size();
             ++region) {
            const bool is_opaque = !input_.prepared.material(region).is_transparent();
            for (const SurfaceSide side : kSurfaceSides) {
                const std::size_t first = blocks.on_surfaces.bin(region, side);
                const std::vector<std::int64_t>& amounts = all.of(flux.of(region, side));
                is_opaque ? add_scattered(first, amounts) : add(first, amounts);
            }
        }
        add_scattered(blocks.escaped.bin(0), all.of(flow.escaped));
        add_scattered(blocks.cut_off.bin(0), all.of(flow.cut_off));
    }

    SolverInput input_;
    DirectBeams beams_;
    BlockRunner<Scratch> runner_;
    SolvedBands bands_;
    std::vector<std::vector<double>> deviations_;  // [replicate][band]
    std::unique_ptr<Cut> cut_;
    std::uint64_t cuts_ = 0;  // number made
};

}  // namespace

void check_diffuse(const Scene& scene, Faults& faults) {
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = data_of(scene).materials[m];
        if (is_used[m] && !is_diffuse(material)) {
            faults.add(
                {"method",
                 fmt::format(
                     "ray_bundles needs Lambertian materials; '{}' is not", material.name()),
                 "", "use method = \"first_hits\""});
        }
    }
}

SumMeaning ray_bundles_meaning(const PreparedScene& prepared, const RunSpec& spec) {
    SumMeaning meaning = direct_beams_meaning(prepared, spec, ScatteredBy::bundles);
    // A segment of the final gather carries twice the mean at most, if all light is scattered once.
    constexpr double kOverMean = 2;
    const std::vector<double> albedos = largest_albedos(prepared.scene());
    std::vector<double>& largest = meaning.bound("scattered").largest;
    for (std::size_t b = 0; b < largest.size(); ++b) {
        largest[b] *= kOverMean * albedos[b];
    }
    meaning.blocks.push_back(
        {std::string(kScatteredCount), SumBlock::Rows::run, {{SumColumn::Of::number}}});
    return meaning;
}

std::unique_ptr<Solver> make_ray_bundles(const SolverInput& input) {
    return std::make_unique<RayBundles>(input);
}

}  // namespace quasimc
