// Tracing from lit surfaces: where parallel light falls is found along scan lines, and scattered
// light starts from there.
//
// Each beam is cut into scan lines, and each line into the segments of surfaces that it lights
// (geometry/scan_lines.h). They give the direct light of every organ, whose error falls with the
// third power of the number of lines. Paths start on the segments, at equal steps of the light that
// is going to be scattered there: none misses, and none ends at its first hit. A path's number in
// the point set is its place along the lines, so that neighbours in the scene are neighbours in the
// set. Light of other sources, and all light of periodic scenes, is traced from the sources.
//
// A unit of all cells is the light of one path, as in light tracing.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "quasimc/tracing/estimator.h"
#include "quasimc/tracing/path.h"

namespace quasimc {
namespace {

/// One line costs about as much as this many paths, and goes with as many.
constexpr double kPathsPerLine = 96;
/// A beam has at least so many.
constexpr std::uint32_t kFewestLines = 16;
/// Bins of lines that make up a block of work.
constexpr std::uint32_t kBinsPerBlock = 16;

double mean_albedo(const Side& side, const std::vector<double>& spectrum) {
    double sum = 0;
    double kept = 0;
    for (std::size_t b = 0; b < spectrum.size(); ++b) {
        sum += spectrum[b];
        kept += spectrum[b] * side.albedo()[b];
    }
    return kept / sum;
}

/// The lines of one light in one round.
struct BeamPlan {
    std::uint32_t light = 0;
    std::uint32_t lines = 0;
    std::uint64_t first_block = 0, blocks = 0;
};

class LitSurfacesEstimator final : public Estimator {
  public:
    LitSurfacesEstimator(const Stage& stage, const Sampler& sampler, const RunSpec& spec)
        : stage_(stage),
          sampler_(sampler),
          spec_(spec),
          enough_(spec.roulette_weight * static_cast<double>(stage.bands())) {
        for (const Light& light : stage.lights()) {
            const bool is_beam = light.emitter->beam_direction().has_value();
            (is_beam ? has_beams_ : has_others_) = true;
        }
        if (stage.scene().cell().periodic()) {
            has_others_ = true;
            has_beams_ = false;
        }
        forward_ = make_forward_estimator(
            stage, sampler, spec, has_beams_ ? Lights::but_beams : Lights::all);
        const std::uint32_t triangles = stage.caster().mesh().triangle_count();
        for (std::uint32_t i = 0; stage.has_transparent() && i < triangles; ++i) {
            transparent_.push_back(stage.material(stage.element(i)).is_transparent() ? 1 : 0);
        }
        set_scattering();
    }

    [[nodiscard]] std::uint64_t blocks(const Round& round) const override {
        const std::vector<BeamPlan> plans = plan(round);
        const std::uint64_t own =
            plans.empty() ? 0 : plans.back().first_block + plans.back().blocks;
        return own + (has_others_ ? forward_->blocks(round) : 0);
    }

    void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Workspace& workspace,
        Tally& tally) const override {
        for (const BeamPlan& beam : plan(round)) {
            if (block < beam.first_block + beam.blocks) {
                trace_lines(round, replicate, beam, block - beam.first_block, workspace, tally);
                return;
            }
        }
        const std::uint64_t own = blocks(round) - forward_->blocks(round);
        forward_->trace(round, replicate, block - own, workspace, tally);
    }

    [[nodiscard]] double flux_per_unit(
        std::uint32_t element, std::size_t band, std::uint64_t paths) const override {
        return forward_->flux_per_unit(element, band, paths);
    }
    [[nodiscard]] double sunlit_area_per_unit(
        std::uint32_t element, std::uint64_t paths) const override {
        return forward_->sunlit_area_per_unit(element, paths);
    }
    [[nodiscard]] double flux_per_find(
        std::uint32_t element, std::size_t band, std::uint64_t paths) const override {
        return forward_->flux_per_find(element, band, paths);
    }
    [[nodiscard]] double sunlit_area_per_find(
        std::uint32_t element, std::uint64_t paths) const override {
        return forward_->sunlit_area_per_find(element, paths);
    }
    [[nodiscard]] bool counts_escapes() const override { return true; }

  private:
    /// What a block's segments share, and where its next path starts.
    struct Batch {
        PathRules rules;
        const Light* light = nullptr;
        Vec3 direction;
        double light_per_length = 0;  ///< paths' worth of light per length of a line
        double to_next = 0;           ///< light to be scattered until the next path starts
    };

    /// Share of the light that goes on from each side of each material, relative to the largest.
    void set_scattering() {
        for (const auto& spectrum : stage_.spectra()) {
            for (const Material& material : stage_.scene().materials()) {
                const bool scatters = !material.is_transparent();
                scattering_.push_back(scatters ? mean_albedo(material.side(true), spectrum) : 0);
                scattering_.push_back(scatters ? mean_albedo(material.side(false), spectrum) : 0);
            }
        }
        const double largest = *std::max_element(scattering_.begin(), scattering_.end());
        for (double& share : scattering_) {
            share = largest > 0 ? share / largest : 0;
        }
    }

    [[nodiscard]] std::vector<BeamPlan> plan(const Round& round) const {
        std::vector<BeamPlan> plans;
        std::uint64_t first = 0;
        for (std::uint32_t i = 0; has_beams_ && i < stage_.lights().size(); ++i) {
            const Light& light = stage_.lights()[i];
            if (!light.emitter->beam_direction()) {
                continue;
            }
            const double share = light.probability * static_cast<double>(round.count);
            const auto lines =
                std::max(kFewestLines, static_cast<std::uint32_t>(share / kPathsPerLine));
            const std::uint64_t blocks =
                (ScanLines::bins(lines) + kBinsPerBlock - 1) / kBinsPerBlock;
            plans.push_back({i, lines, first, blocks});
            first += blocks;
        }
        return plans;
    }

    /// The point set number `i` of a light's blocks; number 0 places its lines. Light tracing has
    /// sequence 0.
    [[nodiscard]] Stream stream_of(
        const Round& round, std::uint32_t replicate, const BeamPlan& beam, std::uint64_t i) const {
        // A block's paths can't be more than the light of the whole beam.
        const std::uint64_t most = std::bit_ceil(2 * round.count + 2);
        const std::uint64_t lights = stage_.lights().size();
        return {spec_.seed, 1 + beam.light + lights * i, replicate, round.first * 4, most};
    }

    void set_lines(
        const Round& round,
        std::uint32_t replicate,
        const BeamPlan& beam,
        Workspace& workspace) const {
        const std::array<std::uint64_t, 3> key{beam.light, replicate, round.first};
        if (workspace.lines_of == key) {
            return;
        }
        const Stream stream = stream_of(round, replicate, beam, 0);
        const Light& light = stage_.lights()[beam.light];
        workspace.lines.set(
            stage_.caster().mesh(), transparent_,
            {.direction = *light.emitter->beam_direction(),
             .rotation = sampler_.number(stream, stream.first, 0),
             .shift = sampler_.number(stream, stream.first, 1),
             .lines = beam.lines});
        workspace.lines_of = key;
    }

    void trace_lines(
        const Round& round,
        std::uint32_t replicate,
        const BeamPlan& beam,
        std::uint64_t block,
        Workspace& workspace,
        Tally& tally) const {
        set_lines(round, replicate, beam, workspace);
        ScanLines& lines = workspace.lines;
        const Light& light = stage_.lights()[beam.light];
        const double paths = light.probability * static_cast<double>(round.count);
        workspace.starts.clear();
        Batch batch;
        batch.rules = {
            .stage = &stage_,
            .sampler = &sampler_,
            .stream = stream_of(round, replicate, beam, 1 + block),
            .scatter_dimension = 0,
            .max_depth = spec_.max_depth,
            .enough = enough_};
        batch.light = &light;
        batch.direction = *light.emitter->beam_direction();
        batch.light_per_length = paths * lines.pitch() / light.emitter->flux();
        const Stream placing = stream_of(round, replicate, beam, 0);
        batch.to_next = sampler_.number(placing, placing.first + 1 + block, 2);
        std::int64_t lit = 0;
        const std::uint32_t bins = ScanLines::bins(beam.lines);
        const auto first = static_cast<std::uint32_t>(block * kBinsPerBlock);
        for (std::uint32_t bin = first; bin < std::min(first + kBinsPerBlock, bins); ++bin) {
            lines.visit(bin, [&](const LitSegment& segment) {
                lit += light_segment(segment, batch, workspace, tally);
            });
        }
        const std::uint64_t rays = trace_starts(batch, workspace, tally);
        // What the beam brings, less what was caught, flies by.
        const TallyLayout& layout = tally.layout();
        const std::int64_t emitted = share_of_block(paths, block, beam.blocks);
        tally.add(layout.emitted() + light.spectrum, emitted);
        tally.add(layout.escaped_direct() + light.spectrum, emitted - lit);
        tally.add(layout.rays(), static_cast<std::int64_t>(rays));
    }

    /// A block's part of the light of a beam; all parts add up to it, to the last bit.
    static std::int64_t share_of_block(double paths, std::uint64_t block, std::uint64_t blocks) {
        const auto until = [&](std::uint64_t i) {
            return to_fixed(paths * static_cast<double>(i) / static_cast<double>(blocks));
        };
        return until(block + 1) - until(block);
    }

    /// Scores a segment and traces what it scatters. Returns the light that it stops.
    std::int64_t light_segment(
        const LitSegment& segment, Batch& batch, Workspace& workspace, Tally& tally) const {
        const Facet& facet = stage_.facet(segment.triangle);
        const TallyLayout& layout = tally.layout();
        const bool lower = segment.cosine > 0;
        const double amount = batch.light_per_length * segment.length;
        const double cosine = std::abs(segment.cosine);
        const std::int64_t fixed = to_fixed(amount);
        if (stage_.counts(facet.element, cosine)) {
            tally.add_two(
                facet.element, layout.direct(0, lower, batch.light->spectrum), fixed,
                layout.sunlit(0), to_fixed(amount * batch.light->lit_area / cosine));
        }
        if (stage_.material(facet.element).is_transparent()) {
            return 0;
        }
        const std::size_t materials = stage_.scene().materials().size();
        const double share =
            scattering_[2 * (batch.light->spectrum * materials + facet.material) + (lower ? 1 : 0)];
        if (share > 0) {
            place_starts(segment, amount, share, batch, workspace.starts);
        }
        return fixed;
    }

    static void place_starts(
        const LitSegment& segment,
        double amount,
        double share,
        Batch& batch,
        std::vector<SurfaceStart>& starts) {
        const double scattered = amount * share;
        double at = batch.to_next;
        while (at < scattered) {
            const double f = at / scattered;
            const auto u = static_cast<float>((1 - f) * segment.u[0] + f * segment.u[1]);
            const auto v = static_cast<float>((1 - f) * segment.v[0] + f * segment.v[1]);
            starts.push_back({segment.triangle, u, v, 1 / share});
            at += 1;
        }
        batch.to_next = at - scattered;
    }

    /// Traces the paths that start in a block, surface after surface, so that the directions in
    /// which one scatters are neighbours in the point set.
    std::uint64_t trace_starts(const Batch& batch, Workspace& workspace, Tally& tally) const {
        std::vector<SurfaceStart>& starts = workspace.starts;
        std::stable_sort(
            starts.begin(), starts.end(),
            [](const SurfaceStart& a, const SurfaceStart& b) { return a.triangle < b.triangle; });
        std::uint64_t rays = 0;
        PathRules rules = batch.rules;
        rules.stream.count = std::bit_ceil(starts.size() + 1);
        // Part of a lattice must be spread over all of it, and its first coordinate, which grows
        // with the number, is left out: a surface would send all its light one way.
        const bool spread = sampler_.needs_power_of_two();
        rules.scatter_dimension = spread ? 1 : 0;
        LightPath path{batch.light, 0, batch.direction, 1};
        for (std::size_t i = 0; i < starts.size(); ++i) {
            const SurfaceStart& start = starts[i];
            path.point = rules.stream.first + (spread ? i * rules.stream.count / starts.size() : i);
            path.weight = start.weight;
            rays += follow(
                rules, path, {RayEnd::hit, hit_at(start.triangle, start.u, start.v)},
                FirstHit::surely_scattered, workspace, tally);
        }
        return rays;
    }

    [[nodiscard]] Hit hit_at(std::uint32_t triangle, float u, float v) const {
        const LocalMesh& mesh = stage_.caster().mesh();
        const Vec3 a = mesh.vertex(triangle, 0);
        const Vec3 up = cross(mesh.vertex(triangle, 1) - a, mesh.vertex(triangle, 2) - a);
        return {
            triangle,
            0,
            u,
            v,
            {static_cast<float>(up.x), static_cast<float>(up.y), static_cast<float>(up.z)}};
    }

    const Stage& stage_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    double enough_;
    bool has_beams_ = false, has_others_ = false;
    std::unique_ptr<Estimator> forward_;     // of all other light; tells what the cells mean
    std::vector<std::uint8_t> transparent_;  // by triangle; empty if none is
    std::vector<double> scattering_;         // [spectrum][material][upper, lower], relative
};

}  // namespace

std::unique_ptr<Estimator> make_lit_surfaces_estimator(
    const Stage& stage, const Sampler& sampler, const RunSpec& spec) {
    return std::make_unique<LitSurfacesEstimator>(stage, sampler, spec);
}

}  // namespace quasimc
