// Ray bundles: all scattered light at once.
//
// Direct light falls on patches of surfaces (solvers/ray_bundles/direct_on_patches.h). Matt
// surfaces send on what falls on them equally bright in all directions, so that light need not be
// followed ray by ray: along lines in one direction through the whole scene each patch sends light
// to the next one, both ways (solvers/ray_bundles/bundle_exchange.h). Step by step all light that
// has not yet been sent on goes along lines in new directions, drawn independently of all before:
// the Neumann series of the radiosity equation, order by order, each without bias. What is left
// then is reported as cut off. These steps have few lines. All that left surfaces in them goes
// along many lines once more, and what organs receive in this last step is the result.
//
// The same steps are done twice at once: with patches, and with each four of them taken together.
// The difference tells how much it matters that light is constant over a patch.

#include "solvers/ray_bundles/ray_bundles.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>

#include <fmt/format.h>

#include "base/memory_need.h"
#include "base/stop.h"
#include "samplers/hash.h"
#include "scene/scene.h"
#include "solvers/block_runner.h"
#include "solvers/ray_bundles/bundle_budget.h"
#include "solvers/ray_bundles/bundle_exchange.h"
#include "solvers/ray_bundles/direct_on_patches.h"
#include "solvers/ray_bundles/suits_bundles.h"

namespace quasimc {
namespace {

/// Steps end where what is left is this part of the light that came from the sources and was
/// scattered: less than any error.
constexpr double kLeft = 1e-5;
/// Point sets of other purposes have smaller numbers.
constexpr std::uint64_t kBundleSequence = std::uint64_t{1} << 62U;

/// Sums of one replicate, [column of PatchLight].
struct Flow {
    explicit Flow(std::size_t columns) : escaped(columns), cut_off(columns) {}
    std::vector<std::int64_t> escaped, cut_off;  // fixed point
};

class RayBundles final : public Solver {
  public:
    explicit RayBundles(const SolverInput& input)
        : input_(input), beams_(input, ScatteredBy::bundles), runner_(input) {}

    void solve(const Round& round, Executor& executor, Sums& sums) override {
        cut_for(round);
        const std::vector<VisibilityTask> tasks = beams_.tasks(round, sums);
        executor.announce(sums.replicates.size());
        std::atomic<std::size_t> left = sums.replicates.size();
        // Where fewer replicates are left than there are threads, each uses several.
        const auto threads = [&left, workers = executor.workers()] {
            const std::size_t busy = std::clamp<std::size_t>(left, 1, workers);
            return static_cast<unsigned>(workers / busy);
        };
        runner_.run(
            1, executor, sums,
            [&](std::uint32_t replicate, std::uint64_t, Scratch& scratch, Tally& tally) {
                solve_replicate({round, tasks, sums.units, replicate}, threads, scratch, tally);
                --left;
            });
        sums.paths += round.count;
        sums.samples += samples_of(round);
    }

  private:
    /// All surfaces cut into patches.
    struct Cut {
        Cut(const SolverInput& input, const DirectBeams& beams, double patches)
            : most(patches),
              scene(
                  input.prepared,
                  beams.scene(),
                  make_patches(input.prepared, beams.scene().roles, patches, input.stop)),
              direct(input, beams, scene) {}
        double most;
        PatchScene scene;
        DirectOnPatches direct;
    };

    /// What a worker keeps between replicates.
    struct Scratch {
        explicit Scratch(std::size_t) {}
        DirectOnPatches::Scratch direct;
        std::uint64_t cut = 0;  // which one the rest is made for
        std::unique_ptr<PatchLight> light;
        std::unique_ptr<BundleExchange> exchange;
        std::unique_ptr<OpenSides> open;
    };

    /// Patches become finer with the paths of all rounds: their error falls as that of lines does.
    void cut_for(const Round& round) {
        const double most = patches_for(round.first + round.count);
        if (!cut_ || cut_->most != most) {
            cut_.reset();  // two at once would take twice the memory
            ++cuts_;
            cut_ = std::make_unique<Cut>(input_, beams_, most);
        }
    }

    /// @param threads  tells how many may be at work now
    void solve_replicate(
        const DirectOnPatches::Task& task,
        const std::function<unsigned()>& threads,
        Scratch& scratch,
        Tally& tally) const {
        if (scratch.cut != cuts_) {
            scratch.light = make_light();
            scratch.exchange = std::make_unique<BundleExchange>(cut_->scene, beams_.scene());
            scratch.open = std::make_unique<OpenSides>(cut_->scene, beams_.skies());
            scratch.cut = cuts_;
        }
        PatchLight& light = *scratch.light;
        light.clear();
        scratch.open->clear();
        cut_->direct.find(task, scratch.direct, light, *scratch.open, tally);
        Flow flow(light.columns());
        std::uint64_t stretches = 0;
        const auto exchange = [&](const BundleGroup& group, const BundleExchange::Tell& tell) {
            throw_if_stopped(input_.stop);
            stretches += scratch.exchange->exchange(group, threads(), light, tell);
            light.correct_areas(group.directions / (2 * group.line_area));
        };
        const std::vector<double> first = light.scatter(true);
        BundleBudget budget(cut_->scene, task.round.count, first);
        std::vector<double> left = first;
        std::uint64_t order = 1;
        for (; goes_on(order, left, first, light); ++order) {
            const bool is_first = order == 1;
            exchange(
                budget.of_order(left, key_of(task, order)),
                {{}, is_first ? looking_at(*scratch.open) : BundleExchange::OnEnds{}});
            left = light.scatter(false);
            if (is_first) {
                scratch.open->choose_sides(light);
            }
        }
        for (std::size_t c = 0; c < left.size(); ++c) {
            flow.cut_off[c] = to_fixed(left[c]);
        }
        if (order > 1) {
            light.send_all_kept();
            scratch.open->forget_ends();
            exchange(
                budget.of_all(key_of(task, order)),
                {[&](const Vec3& direction, std::span<const double> flux) {
                     add_escaped(direction, flux, flow, tally);
                 },
                 looking_at(*scratch.open)});
            const std::vector<double> passed_by = light.collect();
            for (std::size_t c = 0; c < left.size(); ++c) {
                flow.escaped[c] += signed_fixed(passed_by[c]);
            }
        }
        add_sums(light, *scratch.open, flow, tally);
        tally.add(tally.layout().rays(), static_cast<std::int64_t>(stretches));
    }

    /// What looks at the ends of lines, where the sky is looked at for direct light.
    [[nodiscard]] BundleExchange::OnEnds looking_at(OpenSides& open) const {
        if (!beams_.looks_at_skies()) {
            return {};
        }
        return [&open](std::span<const std::uint32_t> sides, const Vec3& direction, double weight) {
            open.add_ends(sides, direction, weight);
        };
    }

    [[nodiscard]] std::unique_ptr<PatchLight> make_light() const {
        const std::size_t patches = cut_->scene.patches.count();
        const std::size_t bands = input_.prepared.bands();
        return make_big(
            fmt::format("the light of {} patches in {} bands", patches, bands),
            bytes_of_patch_light(static_cast<double>(patches), bands),
            [&] { return std::make_unique<PatchLight>(cut_->scene); });
    }

    /// Whether light is sent on that was scattered `order` times. Packs of bands in which little is
    /// left rest from now on.
    [[nodiscard]] bool goes_on(
        std::uint64_t order,
        const std::vector<double>& left,
        const std::vector<double>& first,
        PatchLight& light) const {
        std::vector<bool> is_little;
        for (std::size_t c = 0; c < left.size(); ++c) {
            is_little.push_back(left[c] <= kLeft * first[c]);
        }
        light.rest(is_little);
        const bool is_deepest = input_.spec.max_depth > 0 && order >= input_.spec.max_depth;
        return !light.all_rest() && !is_deepest;
    }

    [[nodiscard]] std::uint64_t key_of(
        const DirectOnPatches::Task& task, std::uint64_t order) const {
        const Stream stream{
            input_.spec.seed, kBundleSequence + order, task.replicate, task.round.first,
            task.round.count};
        return stream_key(stream, task.round.first, 0);
    }

    static std::int64_t signed_fixed(double amount) {
        return amount < 0 ? -to_fixed(-amount) : to_fixed(amount);
    }

    void add_escaped(
        const Vec3& direction, std::span<const double> flux, Flow& flow, Tally& tally) const {
        std::vector<std::int64_t> fixed;
        for (std::size_t c = 0; c < flux.size(); ++c) {
            fixed.push_back(to_fixed(flux[c]));
            flow.escaped[c] += fixed[c];
        }
        const auto& detectors = input_.prepared.detectors();
        for (std::size_t i = 0; i < detectors.size(); ++i) {
            detectors[i]->on_escape(
                direction, std::span(fixed).first(input_.prepared.bands()),
                tally.layout().detector(i), tally);
        }
    }

    /// What went out is what came to surfaces, escaped or was cut off: exactly.
    void add_sums(
        const PatchLight& light, const OpenSides& open, const Flow& flow, Tally& tally) const {
        const SumLayout& layout = tally.layout();
        const std::size_t bands = input_.prepared.bands();
        std::vector<std::int64_t> out(light.columns());
        for (std::uint32_t region = 0; region < layout.regions; ++region) {
            const bool is_opaque = !input_.prepared.material(region).is_transparent();
            for (const SurfaceSide side : kSurfaceSides) {
                const std::span<const double> sum = light.sum(region, side);
                const double correction = open.correction(region, side, light);
                for (std::size_t b = 0; b < bands; ++b) {
                    const std::int64_t fine = to_fixed(correction * sum[b]);
                    const std::int64_t coarse = to_fixed(correction * sum[bands + b]);
                    tally.add(layout.scattered(region, side) + b, fine);
                    tally.add(layout.coarse_scattered(region, side) + b, coarse);
                    out[b] += is_opaque ? fine : 0;
                    out[bands + b] += is_opaque ? coarse : 0;
                }
            }
        }
        for (std::size_t b = 0; b < bands; ++b) {
            add_flow(layout.escaped_scattered() + b, out, flow, b, tally);
            add_flow(layout.coarse_escaped() + b, out, flow, bands + b, tally);
        }
    }

    /// Adds what escaped to `bin`, and with it, as the layout has them, what was scattered and what
    /// was cut off.
    static void add_flow(
        std::size_t bin,
        const std::vector<std::int64_t>& arrived,
        const Flow& flow,
        std::size_t column,
        Tally& tally) {
        const std::size_t bands = tally.layout().bands;
        tally.add_signed(bin, flow.escaped[column]);
        tally.add_signed(
            bin + bands, arrived[column] + flow.escaped[column] + flow.cut_off[column]);
        tally.add(bin + 2 * bands, flow.cut_off[column]);
    }

    SolverInput input_;
    DirectBeams beams_;
    BlockRunner<Scratch> runner_;
    std::unique_ptr<Cut> cut_;
    std::uint64_t cuts_ = 0;  // made until now
};

}  // namespace

void check_matt(const Scene& scene, Faults& faults) {
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = data_of(scene).materials[m];
        if (is_used[m] && !is_matt(material)) {
            faults.add(
                {"method",
                 fmt::format(
                     "ray_bundles, with the material '{}' that is not matt", material.name()),
                 "bundles send light on by the cosine law alone, with the same albedo at every "
                 "angle",
                 "use method = \"first_hits\""});
        }
    }
}

SumMeaning ray_bundles_meaning(const PreparedScene& prepared, const RunSpec& spec) {
    SumMeaning meaning = direct_beams_meaning(prepared, spec, ScatteredBy::bundles);
    meaning.patch_levels = PatchLevels::two;
    meaning.units.scattered_flux_per_find = prepared.flux();
    for (double& flux : meaning.units.scattered_flux_per_find) {
        flux *= light_of_stretch();
    }
    return meaning;
}

std::unique_ptr<Solver> make_ray_bundles(const SolverInput& input) {
    return std::make_unique<RayBundles>(input);
}

}  // namespace quasimc
