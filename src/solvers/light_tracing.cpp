// BoundSource tracing: paths start at the sources, and every organ they meet receives their light.
//
// A block of consecutive points is put in the order of a curve through the window of the beam.
// Parallel light is then cast in packets of 16; whatever survives its first hit goes on one ray at
// a time. Which rays share a packet follows from the block alone, never from load, so a run gives
// the same bits on any number of threads.

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "base/checks.h"
#include "base/distribution.h"
#include "solvers/estimator.h"
#include "transport/particle.h"
#include "transport/start_order.h"

namespace quasimc {
namespace {

/// Points a block holds: enough that neighbours are near, few enough for the cache and for many
/// threads.
constexpr std::uint64_t kBlock = 16384;

/// The points of a block, and what they share.
struct Block {
    PathRules rules;
    std::uint64_t first = 0;
    std::uint64_t count = 0;
};

/// Points of a block that are traced together: neighbours lit by the same light.
struct Group {
    std::size_t light = 0;
    std::span<const std::uint32_t> points;  // in the block
};

class ForwardEstimator final : public Estimator {
  public:
    ForwardEstimator(
        const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec, Lights lights)
        : prepared_(prepared),
          sampler_(sampler),
          spec_(spec),
          lights_(lights),
          roulette_threshold_(spec.roulette_weight * static_cast<double>(prepared.bands())) {
        for (const BoundSource& light : prepared.lights()) {
            beams_.push_back(light.source_sampler->beam_direction());
            only_beams_ = only_beams_ && beams_.back().has_value();
        }
        for (const auto& spectrum : prepared.spectra()) {
            for (const Material& material : prepared.scene().materials()) {
                for (const bool upper : {true, false}) {
                    survival_.push_back(survival(spectrum, material, upper));
                }
            }
        }
    }

    [[nodiscard]] std::uint64_t blocks(const Round& round) const override {
        return (round.count + kBlock - 1) / kBlock;
    }

    void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Workspace& workspace,
        Tally& tally) const override {
        Block points;
        points.rules = {
            .prepared = &prepared_,
            .sampler = &sampler_,
            .stream = {spec_.seed, 0, replicate, round.first, round.count},
            .scatter_dimension = only_beams_ ? 2U : 4U,
            .max_depth = spec_.max_depth,
            .roulette_threshold = roulette_threshold_};
        points.first = round.first + block * kBlock;
        points.count = std::min(kBlock, round.count - block * kBlock);
        prepare(points, workspace);
        std::uint64_t rays = 0;
        for (std::size_t i = 0; i < points.count;) {
            const Group group = next_group(workspace, i);
            i += group.points.size();
            if (lights_ == Lights::lamps && !prepared_.lights()[group.light].source->is_lamp()) {
                continue;
            }
            rays += beams_[group.light] ? trace_packet(points, group, workspace, tally)
                                        : trace_single(points, group, workspace, tally);
        }
        tally.add(tally.layout().rays(), static_cast<std::int64_t>(rays));
    }

    [[nodiscard]] double flux_per_unit(
        std::uint32_t, std::size_t band, std::uint64_t paths) const override {
        return prepared_.flux()[band] / static_cast<double>(paths);
    }
    [[nodiscard]] double sunlit_area_per_unit(std::uint32_t, std::uint64_t paths) const override {
        return prepared_.sun_area() / static_cast<double>(paths);
    }
    [[nodiscard]] double flux_per_find(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const override {
        return flux_per_unit(region, band, paths);
    }
    [[nodiscard]] double sunlit_area_per_find(
        std::uint32_t region, std::uint64_t paths) const override {
        return sunlit_area_per_unit(region, paths);
    }
    [[nodiscard]] bool counts_escapes() const override { return true; }

  private:
    /// An upper bound of the chance that light of a spectrum goes on after its first hit; above 1
    /// if more than the chance has to be looked at.
    [[nodiscard]] double survival(
        const std::vector<double>& spectrum, const Material& material, bool upper) const {
        double sum = 0;
        double kept = 0;
        for (std::size_t b = 0; b < spectrum.size(); ++b) {
            sum += spectrum[b];
            kept += spectrum[b] * material.side(upper).albedo()[b];
        }
        const double played = std::max(kept, std::min(sum, roulette_threshold_));
        constexpr double kRounding = 1e-12;
        constexpr double kCertain = 2;
        return material.is_transparent() || spec_.max_depth == 1 ? kCertain
                                                                 : kept / played * (1 + kRounding);
    }

    /// Draws the first coordinates of all points of the block and orders them.
    void prepare(const Block& block, Workspace& workspace) const {
        workspace.u0.resize(block.count);
        workspace.u1.resize(block.count);
        workspace.u2.resize(block.count);
        workspace.lights.assign(prepared_.lights().size() > 1 ? block.count : 0, 0);
        const Stream& stream = block.rules.stream;
        sampler_.coordinates(stream, block.first, 0, workspace.u0);
        sampler_.coordinates(stream, block.first, 1, workspace.u1);
        sampler_.coordinates(stream, block.first, block.rules.scatter_dimension, workspace.u2);
        // The first coordinate also picks the light.
        for (std::size_t i = 0; i < workspace.lights.size(); ++i) {
            const std::size_t pick = prepared_.pick_light(workspace.u0[i]);
            const BoundSource& light = prepared_.lights()[pick];
            workspace.lights[i] = static_cast<std::uint32_t>(pick);
            workspace.u0[i] =
                std::clamp((workspace.u0[i] - light.before) / light.probability, 0.0, kBelowOne);
        }
        order_starts(
            workspace.lights, static_cast<std::uint32_t>(prepared_.lights().size()), workspace);
    }

    /// The next sixteen points, or fewer, in order and of one light.
    [[nodiscard]] static Group next_group(const Workspace& workspace, std::size_t begin) {
        const auto light_of = [&](std::size_t i) {
            return workspace.lights.empty() ? 0 : workspace.lights[workspace.order[i]];
        };
        const std::size_t light = light_of(begin);
        std::size_t end = begin + 1;
        while (end < workspace.order.size() && end < begin + kPacket && light_of(end) == light) {
            ++end;
        }
        return {light, {&workspace.order[begin], end - begin}};
    }

    std::uint64_t trace_single(
        const Block& block, const Group& group, Workspace& workspace, Tally& tally) const {
        const BoundSource& light = prepared_.lights()[group.light];
        const Stream& stream = block.rules.stream;
        std::uint64_t rays = 0;
        for (const std::uint32_t i : group.points) {
            const std::uint64_t point = block.first + i;
            const Emission emission = light.source_sampler->emit(
                {workspace.u0[i], workspace.u1[i], sampler_.coordinate(stream, point, 2),
                 sampler_.coordinate(stream, point, 3)});
            if (emission.weight == 0) {
                continue;  // to where the lamp doesn't shine
            }
            tally.add(tally.layout().emitted() + light.spectrum, to_fixed(emission.weight));
            const CastHit at =
                prepared_.caster().cast(emission.origin, emission.direction, kNoTriangle);
            rays += 1 + follow(
                            block.rules, {&light, point, emission.direction, emission.weight}, at,
                            FirstHit::to_score, workspace, tally);
        }
        return rays;
    }

    std::uint64_t trace_packet(
        const Block& block, const Group& group, Workspace& workspace, Tally& tally) const {
        std::array<double, kPacket> u0;
        std::array<double, kPacket> u1;
        std::array<Vec3, kPacket> origins;
        const std::size_t n = group.points.size();
        for (std::size_t lane = 0; lane < n; ++lane) {
            u0[lane] = workspace.u0[group.points[lane]];
            u1[lane] = workspace.u1[group.points[lane]];
        }
        const BoundSource& light = prepared_.lights()[group.light];
        light.source_sampler->beam_origins({u0.data(), n}, {u1.data(), n}, {origins.data(), n});
        const Vec3& direction = *beams_[group.light];
        Packet packet;
        for (std::size_t lane = 0; lane < n; ++lane) {
            packet.origin_x[lane] = static_cast<float>(origins[lane].x);
            packet.origin_y[lane] = static_cast<float>(origins[lane].y);
            packet.origin_z[lane] = static_cast<float>(origins[lane].z);
        }
        packet.direction_x.fill(static_cast<float>(direction.x));
        packet.direction_y.fill(static_cast<float>(direction.y));
        packet.direction_z.fill(static_cast<float>(direction.z));
        std::array<RayEnd, kPacket> ends;
        prepared_.caster().cast(packet, n, ends);
        tally.add(
            tally.layout().emitted() + light.spectrum, static_cast<std::int64_t>(n) * to_fixed(1));
        return n + shade(block, group, packet, ends, workspace, tally);
    }

    /// Scores the first hits of a packet, and follows the paths that survive them: the same as
    /// `follow` alone would do, but cheaper for the many that end here. Returns the rays cast.
    std::uint64_t shade(
        const Block& block,
        const Group& group,
        const Packet& packet,
        const std::array<RayEnd, kPacket>& ends,
        Workspace& workspace,
        Tally& tally) const {
        const TallyLayout& layout = tally.layout();
        const BoundSource& light = prepared_.lights()[group.light];
        const double* survival =
            &survival_[2 * light.spectrum * prepared_.scene().materials().size()];
        const Facing facing = facing_of(packet);
        Particle path{&light, 0, *beams_[group.light], 1};
        std::uint64_t rays = 0;
        for (std::size_t lane = 0; lane < group.points.size(); ++lane) {
            CastHit at{ends[lane], {}};
            if (at.end == RayEnd::hit) {
                const PrimitiveInfo& primitive = prepared_.primitive(packet.triangle[lane]);
                const bool lower = facing.along[lane] >= 0;
                const double lit =
                    light.lit_area * static_cast<double>(facing.inverse_cosine[lane]);
                if (prepared_.in_field_of_view(
                        primitive.region, 1 / static_cast<double>(facing.inverse_cosine[lane]))) {
                    tally.add_two(
                        primitive.region, layout.direct(0, lower, light.spectrum), to_fixed(1),
                        layout.sunlit(0), to_fixed(facing.along[lane] == 0 ? 0 : lit));
                }
                if (workspace.u2[group.points[lane]] >=
                    survival[2 * primitive.material + (lower ? 1 : 0)]) {
                    continue;
                }
                at.hit = hit_of(packet, lane);
            }
            path.point = block.first + group.points[lane];
            rays += follow(block.rules, path, at, FirstHit::scored, workspace, tally);
        }
        return rays;
    }

    /// How the triangles hit lie towards the rays: normal times direction (not normalized), and
    /// 1/|cosine|.
    struct Facing {
        std::array<float, kPacket> along, inverse_cosine;
    };
    static Facing facing_of(const Packet& p) {
        Facing facing;
        for (std::size_t i = 0; i < kPacket; ++i) {
            const float along = p.normal_x[i] * p.direction_x[i] +
                                p.normal_y[i] * p.direction_y[i] + p.normal_z[i] * p.direction_z[i];
            const float square = p.normal_x[i] * p.normal_x[i] + p.normal_y[i] * p.normal_y[i] +
                                 p.normal_z[i] * p.normal_z[i];
            facing.along[i] = along;
            facing.inverse_cosine[i] = std::sqrt(square) / std::abs(along);
        }
        return facing;
    }

    static Hit hit_of(const Packet& p, std::size_t lane) {
        return {
            p.triangle[lane],
            p.t[lane],
            p.u[lane],
            p.v[lane],
            {p.normal_x[lane], p.normal_y[lane], p.normal_z[lane]}};
    }

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    Lights lights_;
    double roulette_threshold_;
    std::vector<std::optional<Vec3>> beams_;  // by light: its direction if it is a beam
    bool only_beams_ = true;
    std::vector<double> survival_;  // [spectrum][material][upper, lower]
};

}  // namespace

std::unique_ptr<Estimator> make_forward_estimator(
    const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec, Lights lights) {
    return std::make_unique<ForwardEstimator>(prepared, sampler, spec, lights);
}

}  // namespace quasimc
