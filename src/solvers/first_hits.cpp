// Tracing from lit surfaces: what light from far away falls on first is found without random paths,
// and scattered light starts from there.
//
// A sun is cut into scan lines, and each line into the segments of surfaces that it lights
// (geometry/raster/scan_lines.h): the direct light of every organ, with an error that falls with
// the third power of the number of lines. A sky is a sum of beams from well-spread directions, and
// each is seen pixel by pixel (geometry/raster/item_buffer.h). Paths start on segments and pixels
// (solvers/scatter_source.h). Lamps are traced from the sources.
//
// A unit of all cells is the light of one path, as in light tracing.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <span>

#include "solvers/sampling_budget.h"
#include "solvers/scatter_source.h"

namespace quasimc {
namespace {

class LitSurfacesEstimator final : public Estimator {
  public:
    LitSurfacesEstimator(const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec)
        : prepared_(prepared),
          sampler_(sampler),
          spec_(spec),
          roulette_threshold_(spec.roulette_weight * static_cast<double>(prepared.bands())),
          forward_(make_forward_estimator(prepared, sampler, spec, Lights::lamps)),
          shares_(prepared),
          skies_(prepared),
          plan_(prepared, skies_) {
        for (const BoundSource& light : prepared.lights()) {
            has_lamps_ = has_lamps_ || light.source->is_lamp();
        }
        set_scene();
    }

    [[nodiscard]] std::uint64_t blocks(const Round& round) const override {
        const std::vector<VisibilityTask> parts = plan_.parts(round);
        const std::uint64_t own =
            parts.empty() ? 0 : parts.back().first_block + parts.back().blocks;
        return own + (has_lamps_ ? forward_->blocks(round) : 0);
    }

    void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Workspace& workspace,
        Tally& tally) const override {
        const std::vector<VisibilityTask> parts = plan_.parts(round);
        for (std::uint32_t i = 0; i < parts.size(); ++i) {
            const VisibilityTask& part = parts[i];
            if (block < part.first_block + part.blocks) {
                const Work work{round, replicate, i, part, block - part.first_block};
                part.is_sky ? trace_skies(work, workspace, tally)
                            : trace_lines(work, workspace, tally);
                return;
            }
        }
        const std::uint64_t own = blocks(round) - forward_->blocks(round);
        forward_->trace(round, replicate, block - own, workspace, tally);
    }

    [[nodiscard]] double flux_per_unit(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const override {
        return forward_->flux_per_unit(region, band, paths);
    }
    [[nodiscard]] double sunlit_area_per_unit(
        std::uint32_t region, std::uint64_t paths) const override {
        return forward_->sunlit_area_per_unit(region, paths);
    }
    [[nodiscard]] double flux_per_find(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const override {
        return forward_->flux_per_find(region, band, paths);
    }
    [[nodiscard]] double sunlit_area_per_find(
        std::uint32_t region, std::uint64_t paths) const override {
        return forward_->sunlit_area_per_find(region, paths);
    }
    [[nodiscard]] bool counts_escapes() const override { return true; }

  private:
    /// A block of a part.
    struct Work {
        const Round& round;
        std::uint32_t replicate;
        std::uint32_t number;  ///< of the part
        const VisibilityTask& part;
        std::uint64_t block;  ///< of the part
    };
    /// One direction of a light.
    struct Beam {
        Vec3 direction;
        double paths = 0;  ///< how many paths' light it brings
        double area = 1;   ///< across it, through which that enters; local
    };

    void set_scene() {
        const RayCaster& caster = prepared_.caster();
        const std::uint32_t triangles = caster.mesh().triangle_count();
        const bool repeats = prepared_.scene().cell().periodic();
        for (std::uint32_t i = 0; (prepared_.has_transparent() || repeats) && i < triangles; ++i) {
            const bool image = repeats && i > 0 && caster.source(i) == caster.source(i - 1);
            const bool sensor = prepared_.material(prepared_.region(i)).is_transparent();
            roles_.push_back(
                image ? VisibilityRole::left_out
                      : (sensor ? VisibilityRole::sensor : VisibilityRole::opaque));
        }
        scene_ = {
            &caster.mesh(), prepared_.projection().cell(), roles_,
            prepared_.projection().outline()};
    }

    /// How many paths' light a light brings.
    static double paths_of(const BoundSource& light, const Round& round) {
        return light.probability * static_cast<double>(round.count);
    }

    /// The point set number `i` of a part's blocks; number 0 places its beams. BoundSource tracing
    /// has sequence 0.
    [[nodiscard]] Stream stream_of(const Work& work, std::uint64_t i) const {
        // A block's paths can't be more than the light of the whole part; beams are placed by at
        // most a number for each of them, and for each sky in each block.
        const std::uint64_t placed =
            work.part.count + work.part.blocks * (1 + skies_.skies().size());
        const std::uint64_t most = std::bit_ceil(2 * work.round.count + 2 + placed);
        // Each light has at most so many parts.
        const std::uint64_t parts = prepared_.lights().size() * kDiskBeams;
        return {
            spec_.seed, 1 + work.number + parts * i, work.replicate, work.round.first * 4, most};
    }

    [[nodiscard]] PathRules rules_of(const Work& work) const {
        return {
            .prepared = &prepared_,
            .sampler = &sampler_,
            .stream = stream_of(work, 1 + work.block),
            .scatter_dimension = 0,
            .max_depth = spec_.max_depth,
            .roulette_threshold = roulette_threshold_};
    }

    /// A light's part in one of `count` directions, drawn with `density`.
    [[nodiscard]] Beam beam_of(
        const BoundSource& light,
        const Vec3& direction,
        double density,
        const Work& work,
        std::uint32_t count) const {
        const double area = prepared_.projection().entry_box().projected_area(direction);
        const double entering =
            light.source->radiance(-direction) * area / light.source_sampler->flux();
        return {direction, paths_of(light, work.round) * entering / (density * count), area};
    }

    /// The beam of a part that is cut into lines.
    [[nodiscard]] Beam beam_of(const Work& work) const {
        const BoundSource& light = prepared_.lights()[work.part.light];
        if (const auto direction = light.source_sampler->beam_direction()) {
            return {*direction, paths_of(light, work.round), light.source_sampler->flux()};
        }
        // All beams of a disk are placed by the same two numbers.
        const Work first{work.round, work.replicate, work.number - work.part.beam, work.part, 0};
        const Stream placing = stream_of(first, 0);
        const DrawnDirection from = lattice_direction(
            light, work.part.beam, work.part.beams,
            {sampler_.coordinate(placing, placing.first, 3),
             sampler_.coordinate(placing, placing.first, 4)});
        return beam_of(light, from.direction, from.density, work, work.part.beams);
    }

    void trace_lines(const Work& work, Workspace& workspace, Tally& tally) const {
        const Beam beam = beam_of(work);
        const Stream placing = stream_of(work, 0);
        set_lines(work, beam, placing, workspace);
        ScanLines& lines = workspace.lines;
        ScatterSource light(shares_, rules_of(work), workspace, tally);
        double residual = sampler_.coordinate(placing, placing.first + 1 + work.block, 2);
        light.begin_beam(
            prepared_.lights()[work.part.light], beam.direction, share_of_block(beam.paths, work),
            residual);
        const double per_length = beam.paths * lines.area() / beam.area;
        lines.begin(static_cast<std::uint32_t>(work.block));
        std::vector<ShiningPiece>& shining = workspace.shining;
        shining.clear();
        for (const ScanLines::Item& item : lines.items()) {
            shining.push_back(light.shining(item.triangle, item.cosine, per_length));
        }
        while (lines.next()) {
            for (const LinePiece& piece : lines.pieces()) {
                light.scatter(shining[piece.segment], piece.length(), [&](double f) {
                    return lines.place(piece, f);
                });
            }
        }
        for (const ScanLines::Item& item : lines.items()) {
            if (item.length > 0) {
                light.fall(item.triangle, item.cosine, per_length * item.length);
            }
        }
        light.end_beam();
        light.trace();
    }

    void set_lines(
        const Work& work, const Beam& beam, const Stream& placing, Workspace& workspace) const {
        const std::array<std::uint64_t, 3> key{work.number, work.replicate, work.round.first};
        if (workspace.lines_of != key) {
            workspace.lines.set(
                scene_, {.direction = beam.direction,
                         .rotation = sampler_.coordinate(placing, placing.first, 0),
                         .shift = sampler_.coordinate(placing, placing.first, 1),
                         .lines = work.part.count});
            workspace.lines_of = key;
        }
    }

    /// A block's part of the light of a beam; all parts add up to it.
    static double share_of_block(double paths, const Work& work) {
        const auto until = [&](std::uint64_t i) {
            return from_fixed(
                to_fixed(paths * static_cast<double>(i) / static_cast<double>(work.part.blocks)));
        };
        return until(work.block + 1) - until(work.block);
    }

    /// Every so many-th direction of the skies: what is seen of it serves all of them.
    void trace_skies(const Work& work, Workspace& workspace, Tally& tally) const {
        const Stream placing = stream_of(work, 0);
        const std::array<double, 2> shift{
            sampler_.coordinate(placing, placing.first, 0),
            sampler_.coordinate(placing, placing.first, 1)};
        ScatterSource light(shares_, rules_of(work), workspace, tally);
        const std::span<const BoundSource* const> skies = skies_.skies();
        std::vector<double> residual;
        for (std::size_t k = 0; k < skies.size(); ++k) {
            const std::uint64_t point = 1 + work.part.count + work.block * skies.size() + k;
            residual.push_back(sampler_.coordinate(placing, placing.first + point, 2));
        }
        for (auto i = static_cast<std::uint32_t>(work.block); i < work.part.count;
             i += static_cast<std::uint32_t>(work.part.blocks)) {
            const DrawnDirection from = skies_.direction(i, work.part.count, shift);
            const std::uint64_t point = placing.first + 1 + i;
            workspace.pixels.draw(
                scene_, {.direction = from.direction,
                         .rotation = sampler_.coordinate(placing, point, 3),
                         .shift_s = sampler_.coordinate(placing, point, 4),
                         .shift_t = sampler_.coordinate(placing, point, 5),
                         .pixels = work.part.pixels});
            for (std::size_t k = 0; k < skies.size(); ++k) {
                const Beam beam =
                    beam_of(*skies[k], from.direction, from.density, work, work.part.count);
                if (beam.paths > 0) {
                    light.begin_beam(*skies[k], beam.direction, beam.paths, residual[k]);
                    light_pixels(beam, workspace, light);
                    light.end_beam();
                }
            }
        }
        light.trace();
    }

    static void light_pixels(const Beam& beam, Workspace& workspace, ScatterSource& light) {
        const ItemBuffer& pixels = workspace.pixels;
        const double amount = beam.paths * pixels.pixel_area() / beam.area;
        std::vector<ShiningPiece>& shining = workspace.shining;
        shining.assign(pixels.id_count(), {});
        for (const ItemBuffer::Item& item : pixels.items()) {
            light.fall(item.triangle, item.cosine, amount * item.pixels);
            if (item.id > 0) {
                shining[item.id] = light.shining(item.triangle, item.cosine, amount);
            }
        }
        for (const ItemBuffer::Run& run : pixels.runs()) {
            light.scatter(shining[run.id], run.count, [&](double f) {
                return pixels.place(run.first + static_cast<std::uint32_t>(f * run.count));
            });
        }
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    double roulette_threshold_;
    bool has_lamps_ = false;
    std::unique_ptr<Estimator> forward_;  // of lamps; tells what the cells mean
    ScatteredShares shares_;
    SkyDirections skies_;
    SamplingBudget plan_;
    std::vector<VisibilityRole> roles_;  // by triangle; empty: all opaque
    ProjectedScene scene_;
};

}  // namespace

std::unique_ptr<Estimator> make_lit_surfaces_estimator(
    const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec) {
    return std::make_unique<LitSurfacesEstimator>(prepared, sampler, spec);
}

}  // namespace quasimc
