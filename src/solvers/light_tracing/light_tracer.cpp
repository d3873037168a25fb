// Light tracing: paths start at the sources, and every organ they meet receives their light.
//
// A block of consecutive points is put in the order of a curve through the cross-section of the
// beam. Parallel light is then cast in packets of 16; paths that survive their first hit continue
// one ray at a time. Which rays share a packet follows from the block alone, never from load, so a
// run gives the same bits on any number of threads.

#include "solvers/light_tracing/light_tracer.h"

#include <algorithm>
#include <cmath>

#include "base/checks.h"
#include "base/stop.h"
#include "scene/scene.h"
#include "solvers/block_runner.h"
#include "transport/absorbed_light.h"
#include "transport/scatter.h"

namespace quasimc {
namespace {

/// Orientation of the triangles that rays hit: normal times direction (not normalized), and
/// 1/|cosine|.
struct Facing {
    std::array<float, kPacket> along, inverse_cosine;
};
Facing facing_of(const Packet& p) {
    Facing facing;
    for (std::size_t i = 0; i < kPacket; ++i) {
        const float along = p.normal_x[i] * p.direction_x[i] + p.normal_y[i] * p.direction_y[i] +
                            p.normal_z[i] * p.direction_z[i];
        const float square = p.normal_x[i] * p.normal_x[i] + p.normal_y[i] * p.normal_y[i] +
                             p.normal_z[i] * p.normal_z[i];
        facing.along[i] = along;
        facing.inverse_cosine[i] = std::sqrt(square) / std::abs(along);
    }
    return facing;
}

}  // namespace

LightTracer::LightTracer(const SolverInput& input, TracedLights traced)
    : prepared_(input.prepared),
      sampler_(input.sampler),
      spec_(input.spec),
      traced_(std::move(traced)),
      light_sampler_(input.prepared, input.spec.paths),
      stop_(input.stop),
      roulette_threshold_(roulette_threshold(input)) {
    for (const BoundSource& source : prepared_.lights()) {
        beams_.push_back(source.source_sampler->beam_direction());
        only_beams_ = only_beams_ && beams_.back().has_value();
    }
    for (const std::vector<double>& spectrum : brightest_paths()) {
        for (const Material& material : data_of(prepared_.scene()).materials) {
            for (const SurfaceSide side : kSurfaceSides) {
                survival_.push_back(survival(spectrum, material, side));
            }
        }
    }
}

std::uint64_t LightTracer::blocks(const Round& round) {
    return block_count(round.count, kPathsPerBlock);
}

void LightTracer::trace(
    const Round& round,
    std::uint32_t replicate,
    std::uint64_t block,
    Scratch& scratch,
    Tally& tally) const {
    Block points;
    points.rules = {
        .prepared = &prepared_,
        .sampler = &sampler_,
        .stream = {spec_.seed, 0, replicate, round.first, round.count},
        .scatter_dimension = only_beams_ ? 2U : 4U,
        .max_depth = spec_.max_depth,
        .roulette_threshold = roulette_threshold_,
        .stop = &stop_};
    const auto [begin, end] = block_range(round.count, kPathsPerBlock, block);
    points.first = round.first + begin;
    points.count = end - begin;
    prepare(points, scratch);
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < points.count;) {
        throw_if_stopped(stop_);
        const Group group = next_group(scratch, i);
        i += group.points.size();
        if (!traced_.empty() && !traced_[group.source]) {
            continue;
        }
        rays += beams_[group.source] ? trace_packet(points, group, scratch, tally)
                                     : trace_single(points, group, scratch, tally);
    }
    tally.count(WorkUnit::ray, rays);
}

/// By spectrum, the largest start weights of a path.
std::vector<std::vector<double>> LightTracer::brightest_paths() const {
    std::vector<double> most(prepared_.lights().spectra().size(), 0);
    for (std::size_t i = 0; i < prepared_.lights().size(); ++i) {
        double& own = most[prepared_.lights()[i].spectrum];
        own = std::max(own, light_sampler_.weight(i));
    }
    std::vector<std::vector<double>> weights = prepared_.lights().spectra();
    for (std::size_t i = 0; i < weights.size(); ++i) {
        for (double& weight : weights[i]) {
            weight *= most[i];
        }
    }
    return weights;
}

/// An upper bound of the probability that light of a spectrum survives its first hit; above 1 if
/// more than this probability decides.
double LightTracer::survival(
    const std::vector<double>& spectrum, const Material& material, SurfaceSide side) const {
    double sum = 0;
    double kept = 0;
    for (std::size_t b = 0; b < spectrum.size(); ++b) {
        sum += spectrum[b];
        kept += spectrum[b] * material.side(side).albedo()[b];
    }
    const double played = std::max(kept, std::min(sum, roulette_threshold_));
    constexpr double kRounding = 1e-12;
    constexpr double kCertain = 2;
    return material.is_transparent() || spec_.max_depth == 1 ? kCertain
                                                             : kept / played * (1 + kRounding);
}

/// Draws the first coordinates of all points of the block and orders them.
void LightTracer::prepare(const Block& block, Scratch& scratch) const {
    scratch.starts.u0.resize(block.count);
    scratch.starts.u1.resize(block.count);
    scratch.u2.resize(block.count);
    scratch.sources.assign(prepared_.lights().size() > 1 ? block.count : 0, 0);
    const Stream& stream = block.rules.stream;
    sampler_.coordinates(stream, block.first, 0, scratch.starts.u0);
    sampler_.coordinates(stream, block.first, 1, scratch.starts.u1);
    sampler_.coordinates(stream, block.first, block.rules.scatter_dimension, scratch.u2);
    // The first coordinate also picks the light.
    for (std::size_t i = 0; i < scratch.sources.size(); ++i) {
        const LightPick picked = light_sampler_.pick(scratch.starts.u0[i]);
        scratch.sources[i] = static_cast<std::uint32_t>(picked.index);
        scratch.starts.u0[i] = picked.u;
    }
    order_starts(
        scratch.sources, static_cast<std::uint32_t>(prepared_.lights().size()), scratch.starts);
}

/// The next sixteen points, or fewer, in order and of one light.
LightTracer::Group LightTracer::next_group(const Scratch& scratch, std::size_t begin) {
    const auto source_of = [&](std::size_t i) {
        return scratch.sources.empty() ? 0 : scratch.sources[scratch.starts.order[i]];
    };
    const std::size_t source = source_of(begin);
    std::size_t end = begin + 1;
    while (end < scratch.starts.order.size() && end < begin + kPacket && source_of(end) == source) {
        ++end;
    }
    return {source, {&scratch.starts.order[begin], end - begin}};
}

std::uint64_t LightTracer::trace_single(
    const Block& block, const Group& group, Scratch& scratch, Tally& tally) const {
    const BoundSource& light = prepared_.lights()[group.source];
    const Stream& stream = block.rules.stream;
    const double weight = light_sampler_.weight(group.source);
    std::uint64_t rays = 0;
    for (const std::uint32_t i : group.points) {
        const std::uint64_t point = block.first + i;
        Emission emission = light.source_sampler->emit(
            {scratch.starts.u0[i], scratch.starts.u1[i], sampler_.coordinate(stream, point, 2),
             sampler_.coordinate(stream, point, 3)});
        if (emission.weight == 0) {
            continue;  // a direction without light of the lamp
        }
        emission.weight *= weight;
        tally.add(tally.blocks().emitted() + light.spectrum, to_fixed(emission.weight));
        const CastHit at = cast_from_source(prepared_, light, emission);
        rays += 1 + trace_particle(
                        block.rules, {&light, point, emission.direction, emission.weight}, at,
                        FirstHit::to_score, scratch.particle, tally);
    }
    return rays;
}

std::uint64_t LightTracer::trace_packet(
    const Block& block, const Group& group, Scratch& scratch, Tally& tally) const {
    std::array<double, kPacket> u0;
    std::array<double, kPacket> u1;
    std::array<Vec3, kPacket> origins;
    const std::size_t n = group.points.size();
    for (std::size_t lane = 0; lane < n; ++lane) {
        u0[lane] = scratch.starts.u0[group.points[lane]];
        u1[lane] = scratch.starts.u1[group.points[lane]];
    }
    const BoundSource& light = prepared_.lights()[group.source];
    light.source_sampler->beam_origins({u0.data(), n}, {u1.data(), n}, {origins.data(), n});
    const Vec3& direction = *beams_[group.source];
    Packet packet;
    for (std::size_t lane = 0; lane < n; ++lane) {
        packet.set_origin(lane, origins[lane]);
    }
    packet.direction_x.fill(static_cast<float>(direction.x));
    packet.direction_y.fill(static_cast<float>(direction.y));
    packet.direction_z.fill(static_cast<float>(direction.z));
    std::array<RayEnd, kPacket> ends;
    prepared_.caster().cast(packet, n, ends);
    tally.add(
        tally.blocks().emitted() + light.spectrum,
        static_cast<std::int64_t>(n) * to_fixed(light_sampler_.weight(group.source)));
    return n + shade(block, group, packet, ends, scratch, tally);
}

/// Scores the first hits of a packet, and follows the paths that survive them: the same as
/// trace_particle(), but cheaper for the many paths that end here. Returns the rays cast.
std::uint64_t LightTracer::shade(
    const Block& block,
    const Group& group,
    const Packet& packet,
    const std::array<RayEnd, kPacket>& ends,
    Scratch& scratch,
    Tally& tally) const {
    const LightBlocks& blocks = tally.blocks();
    const BoundSource& light = prepared_.lights()[group.source];
    const double* survival =
        &survival_[2 * light.spectrum * data_of(prepared_.scene()).materials.size()];
    const Facing facing = facing_of(packet);
    Particle path{&light, 0, *beams_[group.source], light_sampler_.weight(group.source)};
    std::uint64_t rays = 0;
    for (std::size_t lane = 0; lane < group.points.size(); ++lane) {
        CastHit at{ends[lane], {}};
        if (at.end == RayEnd::hit) {
            const PrimitiveInfo& primitive = prepared_.primitive(packet.triangle[lane]);
            const SurfaceSide side = side_facing(static_cast<double>(facing.along[lane]));
            const double lit =
                path.weight * light.lit_area * static_cast<double>(facing.inverse_cosine[lane]);
            const double cosine = 1 / static_cast<double>(facing.inverse_cosine[lane]);
            const double share = path.weight * prepared_.rounding().light_share(
                                                   packet.triangle[lane], path.direction, cosine);
            const bool is_sunlit =
                light.lit_area > 0 && facing.along[lane] != 0 &&
                prepared_.rounding().is_sunlit(packet.triangle[lane], path.direction, cosine);
            const double area_share =
                is_sunlit ? prepared_.rounding().area_share(packet.triangle[lane]) : 0;
            if (prepared_.fields_of_view().contain(primitive.region, cosine)) {
                const std::int64_t sunlit = to_fixed(is_sunlit ? area_share * lit : 0);
                tally.add_two(
                    primitive.region, blocks.direct(0, side, light.spectrum), to_fixed(share),
                    blocks.sunlit(0), sunlit);
                tally.add_sunlit_upper(primitive.region, side, sunlit);
                score_absorbed(
                    prepared_,
                    {primitive.region, side, cosine, direct_part(light), light.origin, share,
                     light.start_weights},
                    tally);
            }
            if (share != path.weight && !prepared_.material(primitive.region).is_transparent()) {
                tally.add_signed(
                    blocks.escaped_direct() + light.spectrum,
                    to_fixed(path.weight) - to_fixed(share));
            }
            if (scratch.u2[group.points[lane]] >=
                survival[std::size_t{2} * primitive.material + index_of(side)]) {
                continue;
            }
            at.hit = packet.hit(lane);
        }
        path.point = block.first + group.points[lane];
        rays += trace_particle(block.rules, path, at, FirstHit::scored, scratch.particle, tally);
    }
    return rays;
}

}  // namespace quasimc
