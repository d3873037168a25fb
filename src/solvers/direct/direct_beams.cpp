// Direct light of suns and skies by geometry: see solvers/first_hits/first_hits.cpp.

#include "solvers/direct/direct_beams.h"

#include <algorithm>
#include <bit>

#include "light/models/source.h"
#include "samplers/hash.h"
#include "solvers/light_tracing/light_tracing.h"

namespace quasimc {
namespace {

/// Lights sampled by paths: lamps, suns without scan lines and skies without item buffers.
TracedLights traced_lights(const PreparedScene& prepared, const SamplingBudget& budget) {
    TracedLights traced;
    for (std::size_t i = 0; i < prepared.lights().size(); ++i) {
        const Source& source = *prepared.lights()[i].source;
        traced.push_back(
            source.is_lamp() || !(source.is_sun() ? budget.has_lines(i) : budget.sees_skies()));
    }
    return traced;
}

/// The index of a task's strategy.
std::size_t strategy_of(const VisibilityTask& task, std::span<const SamplingStrategy> strategies) {
    const SampledBy by = task.is_sky ? SampledBy::directions : SampledBy::lines;
    const auto found = std::ranges::find(strategies, by, &SamplingStrategy::by);
    return static_cast<std::size_t>(found - strategies.begin());
}

/// The fraction of a beam's light of a block; the fractions of all blocks add up exactly.
double share_of_block(double paths, const DirectBeams::Work& work) {
    const auto until = [&](std::uint64_t i) {
        return from_fixed(
            to_fixed(paths * static_cast<double>(i) / static_cast<double>(work.task.blocks)));
    };
    return until(work.block + 1) - until(work.block);
}

/// Sequence number of the choice of suns: those of tasks are smaller.
constexpr std::uint64_t kPickSequence = std::uint64_t{1} << 61U;

}  // namespace

DirectBeams::DirectBeams(const SolverInput& input, ScatteredBy scattered)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      spec_(input.spec),
      stop_(input.stop),
      skies_(input.prepared),
      projection_input_(input.prepared, &stop_),
      budget_(input.prepared, skies_, scene(), input.spec.paths, scattered),
      traced_(traced_lights(input.prepared, budget_)) {
    if (budget_.sees_skies()) {
        projection_input_.store_blocks();
    }
}

std::vector<VisibilityTask> DirectBeams::tasks(const Round& round, std::uint32_t replicate) const {
    const Stream stream{spec_.seed, kPickSequence, replicate, round.first, round.count};
    return budget_.tasks(round, unit_number(stream_key(stream, round.first, 0)));
}

void DirectBeams::raise_bounds(const Round& round, Sums& sums) const {
    for (const VisibilityTask& task : budget_.largest_tasks(round)) {
        const double contribution = budget_.light_per_sample(task, round);
        double& most = sums->per_contribution[strategy_of(task, sums->strategies)];
        most = std::max(most, contribution);
    }
}

DirectBeams::Work DirectBeams::work_of(
    const std::vector<VisibilityTask>& tasks,
    const Round& round,
    const CountedStrategies& counted,
    std::uint32_t replicate,
    std::uint64_t block) {
    const std::uint32_t i = task_of_block(tasks, block);
    return {
        round,
        replicate,
        i,
        tasks[i],
        counted,
        strategy_of(tasks[i], counted.strategies),
        block - tasks[i].first_block};
}

Stream DirectBeams::stream_of(const Work& work, std::uint64_t i) const {
    // A block's paths can't be more than the light of the whole task; beams are placed by at
    // most a number for each of them, and for each sky in each block.
    const std::uint64_t placed = work.task.count + work.task.blocks * (1 + skies_.skies().size());
    const std::uint64_t most = std::bit_ceil(2 * work.round.count + 2 + placed);
    // An upper bound of the number of tasks.
    const std::uint64_t tasks = prepared_.lights().size() * kDiskBeams;
    return {spec_.seed, 1 + work.number + tasks * i, work.replicate, work.round.first * 4, most};
}

/// The random shift of the directions of a task: three dimensions of its first point.
std::array<double, 3> DirectBeams::placing_of(const Stream& first, std::uint32_t dimension) const {
    const auto coordinate = [&](std::uint32_t i) {
        return sampler_.coordinate(first, first.first, dimension + i);
    };
    return {coordinate(0), coordinate(1), coordinate(2)};
}

/// The beam of a light along one of `count` directions. @param paths  light of all of them
DirectBeams::Beam DirectBeams::beam_along(
    const DirectionSample& from,
    const BoundSource& light,
    double paths,
    std::uint32_t count) const {
    const double area = prepared_.projection().entry_box().projected_area(from.direction);
    const double entering =
        model_of(*light.source).radiance(-from.direction) * area / light.source_sampler->flux();
    return {{&light, from.direction, paths * entering / (from.density * count)}, area};
}

/// The beam of a task that is cut into lines.
DirectBeams::Beam DirectBeams::beam_of(const Work& work) const {
    const BoundSource& light = prepared_.lights()[work.task.light];
    const double paths = work.task.probability * static_cast<double>(work.round.count);
    if (const auto direction = light.source_sampler->beam_direction()) {
        return {{&light, *direction, paths}, light.source_sampler->flux()};
    }
    // All beams of a disk are placed by the same three numbers.
    const Work first{work.round, work.replicate, work.number - work.task.beam,
                     work.task,  work.counted,   work.strategy,
                     0};
    const Stream placing = stream_of(first, 0);
    return beam_along(
        lattice_direction(light, work.task.beam, work.task.beams, placing_of(placing, 3)), light,
        paths, work.task.beams);
}

const ScanLines& DirectBeams::lines_of(const Work& work, const Beam& beam, Scratch& scratch) const {
    const std::array<std::uint64_t, 3> key{work.number, work.replicate, work.round.first};
    if (!scratch.lines || scratch.lines_of != key) {
        const Stream placing = stream_of(work, 0);
        scratch.lines.emplace(
            scene(), ScanLines::Spec{
                         .direction = beam.direction,
                         .rotation = sampler_.coordinate(placing, placing.first, 0),
                         .shift = sampler_.coordinate(placing, placing.first, 1),
                         .lines = work.task.count});
        scratch.lines_of = key;
    }
    return *scratch.lines;
}

DirectBeams::LitStrip DirectBeams::lit_strip(const Work& work, Scratch& scratch) const {
    const Beam beam = beam_of(work);
    const ScanLines& lines = lines_of(work, beam, scratch);
    return {
        {beam.light, beam.direction, share_of_block(beam.paths, work)},
        beam.paths * lines.area() / beam.area,
        LineStrip(lines, static_cast<std::uint32_t>(work.block), scratch.strip)};
}

void DirectBeams::score_strip(
    const Work& work,
    const LitStrip& lit,
    std::span<const LineStrip::Visible> visible,
    Tally& tally) const {
    const std::span<const LineStrip::Triangle> triangles = lit.strip.triangles();
    // All lines of a picked sun are one contribution: the light of other suns may be missing.
    const double most = work.task.is_picked ? 1 : std::min(work.task.count, ScanLines::kStrip);
    std::uint64_t segments = 0;
    for (const LineStrip::Visible& own : visible) {
        segments += own.segments;
    }
    tally.count(WorkUnit::strip_triangle, triangles.size());
    tally.count(WorkUnit::piece, segments);
    const auto score_all = [&](DirectLightScore& direct, ContributionCounter& counter) {
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const auto [triangle, cosine] = triangles[i];
            if (visible[i].length > 0) {
                const double amount = lit.per_length * visible[i].length;
                direct.add(triangle, cosine, amount);
                counter.add(triangle, cosine, amount, visible[i].segments);
            }
        }
    };
    DirectLightScore::score(prepared_, lit.share, tally, [&](DirectLightScore& direct) {
        ContributionCounter::count(
            prepared_, work.counted, work.strategy, most, tally,
            [&](ContributionCounter& counter) { score_all(direct, counter); });
    });
}

DirectBeams::SkyView DirectBeams::sky_view(
    const Work& work, std::uint32_t i, bool with_points, Scratch& scratch) const {
    const Stream placing = stream_of(work, 0);
    const std::uint64_t point = placing.first + 1 + i;
    SkyView view{skies_.direction(i, work.task.count, placing_of(placing, 0)), {}, 0, {}};
    view.image = draw(
        scene(),
        {.direction = view.from.direction,
         .rotation = sampler_.coordinate(placing, point, 3),
         .shift_s = sampler_.coordinate(placing, point, 4),
         .shift_t = sampler_.coordinate(placing, point, 5),
         .pixels = work.task.pixels,
         .with_points = with_points},
        scratch.image);
    for (const BoundSource* sky : skies_.skies()) {
        const double paths = sky->probability * static_cast<double>(work.round.count);
        view.beams.push_back(beam_along(view.from, *sky, paths, work.task.count));
        view.paths += std::max(0.0, view.beams.back().paths);
    }
    return view;
}

void DirectBeams::count_contributions(const Work& work, const SkyView& view, Tally& tally) const {
    tally.count(WorkUnit::viewed_triangle, prepared_.caster().mesh().triangle_count());
    tally.count(WorkUnit::pixel, static_cast<std::uint64_t>(work.task.pixels));
    const double area = prepared_.projection().entry_box().projected_area(view.from.direction);
    const double amount = view.paths * view.image.pixel_area() / area;
    ContributionCounter::count(
        prepared_, work.counted, work.strategy, 1, tally, [&](ContributionCounter& counter) {
            for (const ItemBuffer::Item& item : view.image.items()) {
                counter.add(item.triangle, item.cosine, amount * item.pixels);
            }
        });
}

SumMeaning direct_beams_meaning(
    const PreparedScene& prepared, const RunSpec& spec, ScatteredBy scattered) {
    SumMeaning meaning = light_tracing_meaning(prepared, spec);
    const SkyDirections skies(prepared);
    const ProjectionInput seen(prepared);
    const SamplingBudget budget(prepared, skies, seen.projected(), spec.paths, scattered);
    const Round first{0, spec.paths};
    std::vector<SamplingStrategy> counted;
    double of_line = 0;
    double spacing = 0;
    const std::vector<bool>& has_lines = budget.lights_with_lines();
    for (const VisibilityTask& task : budget.largest_tasks(first)) {
        const double step = budget.light_per_sample(task, first);
        if (task.is_sky) {
            counted.push_back(strategy_by_direction(prepared, step));
        } else if (task.is_picked) {
            counted.push_back(strategy_by_pick(prepared, has_lines, step));
        } else {
            of_line = std::max(of_line, step);
            spacing = std::max(spacing, budget.spacing(task));
        }
    }
    if (of_line > 0) {
        counted.push_back(strategy_by_line(prepared, has_lines, of_line, spacing));
    }
    std::vector<SamplingStrategy>& strategies = meaning.strategies;
    std::erase_if(strategies, [&](const SamplingStrategy& strategy) {
        return std::any_of(counted.begin(), counted.end(), [&](const SamplingStrategy& each) {
            return std::ranges::includes(each.spectra, strategy.spectra);
        });
    });
    CountedStrategies::declare(counted.size(), meaning.blocks);
    if ((of_line > 0 || budget.picks_suns()) && budget.traces_suns()) {
        strategies.push_back(strategy_of_traced_suns(prepared, has_lines));
    }
    strategies.insert(strategies.begin(), counted.begin(), counted.end());
    return meaning;
}

}  // namespace quasimc
