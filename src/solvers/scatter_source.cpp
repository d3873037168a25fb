#include "solvers/scatter_source.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>

#include "transport/start_order.h"

namespace quasimc {
namespace {

double mean_albedo(const Side& side, const std::vector<double>& spectrum) {
    double sum = 0;
    double kept = 0;
    for (std::size_t b = 0; b < spectrum.size(); ++b) {
        sum += spectrum[b];
        kept += spectrum[b] * side.albedo()[b];
    }
    return kept / sum;
}

/// How many bits of a triangle's tiles, in both directions, are sorted by.
unsigned tile_bits(std::size_t starts, std::uint32_t triangles) {
    // About one start a tile, and at most 16 tiles a side.
    const auto bits =
        std::min(4U, static_cast<unsigned>(std::bit_width(starts / triangles + 1) - 1) / 2);
    return std::bit_width(triangles) + 2 * bits <= 32 ? bits : 0;
}

/// Sets workspace.keys to where starts lie: triangle, then tile of it.
void find_keys(
    const std::vector<PathVertex>& starts, unsigned bits, std::vector<std::uint32_t>& keys) {
    const auto side = static_cast<float>(1U << bits);
    keys.clear();
    for (const PathVertex& start : starts) {
        const auto column = static_cast<std::uint32_t>(std::clamp(start.u, 0.0F, .999F) * side);
        const auto row = static_cast<std::uint32_t>(std::clamp(start.v, 0.0F, .999F) * side);
        keys.push_back(start.triangle << (2 * bits) | interleaved(column, row));
    }
}

/// Sets workspace.order to that of the triangles and of places on each, stable: digit by digit from
/// the lowest (radix sort), which a few thousand starts on any number of triangles need but two or
/// three of.
void order_by_place(
    const std::vector<PathVertex>& starts, std::uint32_t triangles, Workspace& workspace) {
    constexpr unsigned kDigit = 11;
    constexpr std::uint32_t kMask = (1U << kDigit) - 1;
    const unsigned bits = tile_bits(starts.size(), triangles);
    find_keys(starts, bits, workspace.keys);
    const std::uint64_t keys = std::uint64_t{triangles} << (2 * bits);
    std::vector<std::uint32_t>& order = workspace.order;
    std::vector<std::uint32_t>& next = workspace.next_order;
    order.resize(starts.size());
    next.resize(starts.size());
    std::iota(order.begin(), order.end(), 0U);
    for (unsigned shift = 0; (keys >> shift) > 0; shift += kDigit) {
        const auto digit = [&](std::uint32_t i) { return (workspace.keys[i] >> shift) & kMask; };
        workspace.key_counts.assign(std::size_t{kMask} + 2, 0);
        for (const std::uint32_t i : order) {
            ++workspace.key_counts[digit(i) + 1];
        }
        std::partial_sum(
            workspace.key_counts.begin(), workspace.key_counts.end(), workspace.key_counts.begin());
        for (const std::uint32_t i : order) {
            next[workspace.key_counts[digit(i)]++] = i;
        }
        order.swap(next);
    }
}

}  // namespace

ScatteredShares::ScatteredShares(const PreparedScene& prepared)
    : materials_(prepared.scene().materials().size()) {
    for (const auto& spectrum : prepared.spectra()) {
        for (const Material& material : prepared.scene().materials()) {
            const bool scatters = !material.is_transparent();
            shares_.push_back(scatters ? mean_albedo(material.side(true), spectrum) : 0);
            shares_.push_back(scatters ? mean_albedo(material.side(false), spectrum) : 0);
        }
    }
    const double largest = *std::max_element(shares_.begin(), shares_.end());
    for (double& share : shares_) {
        share = largest > 0 ? share / largest : 0;
    }
}

ScatterSource::ScatterSource(
    const ScatteredShares& shares, const PathRules& rules, Workspace& workspace, Tally& tally)
    : shares_(shares),
      rules_(rules),
      prepared_(*rules.prepared),
      workspace_(workspace),
      tally_(tally) {
    workspace_.starts.clear();
    workspace_.beams.clear();
}

void ScatterSource::begin_beam(
    const BoundSource& light, const Vec3& direction, double paths, double& residual) {
    light_ = &light;
    residual_ = &residual;
    emitted_ = to_fixed(paths);
    stopped_ = 0;
    workspace_.beams.push_back({&light, direction});
}

void ScatterSource::fall(std::uint32_t triangle, double cosine, double amount) {
    const PrimitiveInfo& primitive = prepared_.primitive(triangle);
    const TallyLayout& layout = tally_.layout();
    const std::int64_t fixed = to_fixed(amount);
    if (prepared_.in_field_of_view(primitive.region, std::abs(cosine))) {
        tally_.add_two(
            primitive.region, layout.direct(0, cosine > 0, light_->spectrum), fixed,
            layout.sunlit(0), to_fixed(amount * light_->lit_area / std::abs(cosine)));
    }
    if (!prepared_.material(primitive.region).is_transparent()) {
        stopped_ += fixed;
    }
}

ShiningPiece ScatterSource::shining(std::uint32_t triangle, double cosine, double amount) const {
    const double share =
        shares_.of(light_->spectrum, prepared_.primitive(triangle).material, cosine > 0);
    return {amount * share, share > 0 ? 1 / share : 0, triangle};
}

void ScatterSource::add_start(std::uint32_t triangle, float u, float v, double weight) {
    const auto beam = static_cast<std::uint32_t>(workspace_.beams.size() - 1);
    workspace_.starts.push_back({triangle, beam, u, v, weight});
}

void ScatterSource::end_beam() {
    const TallyLayout& layout = tally_.layout();
    tally_.add(layout.emitted() + light_->spectrum, emitted_);
    tally_.add(layout.escaped_direct() + light_->spectrum, emitted_ - stopped_);
}

void ScatterSource::trace() {
    const std::vector<PathVertex>& starts = workspace_.starts;
    order_by_place(starts, prepared_.caster().mesh().triangle_count(), workspace_);
    rules_.stream.count = std::bit_ceil(starts.size() + 1);
    // Part of a lattice must be spread over all of it, and its first coordinate, which grows with
    // the number, is left out: a surface would send all its light one way.
    spread_ = rules_.sampler->needs_power_of_two();
    rules_.scatter_dimension = spread_ ? 1 : 0;
    // As many at a time as stay in the cache.
    constexpr std::size_t kMostAtOnce = 512, kWeightsAtOnce = 8192;
    const std::size_t at_once =
        std::clamp<std::size_t>(kWeightsAtOnce / prepared_.bands(), 1, kMostAtOnce);
    std::uint64_t rays = 0;
    for (std::size_t first = 0; first < starts.size(); first += at_once) {
        depart_from(first, std::min(first + at_once, starts.size()));
        for (std::size_t i = 0; i < workspace_.departures.size(); ++i) {
            const ScatteredRay& from = workspace_.departures[i];
            rays += follow_on(rules_, path_of(from.start), from, weights_of(i), workspace_, tally_);
        }
    }
    tally_.add(tally_.layout().rays(), static_cast<std::int64_t>(rays));
}

Particle ScatterSource::path_of(std::size_t i) const {
    const std::size_t count = workspace_.starts.size();
    const PathVertex& start = workspace_.starts[workspace_.order[i]];
    const SurfaceBeam& beam = workspace_.beams[start.beam];
    const std::uint64_t place = spread_ ? i * rules_.stream.count / count : i;
    return {beam.light, rules_.stream.first + place, beam.direction, start.weight};
}

/// BoundSource departs from some starts, one right after the other, before any of it is followed:
/// arithmetic that does not wait for rays overlaps in the processor.
void ScatterSource::depart_from(std::size_t first, std::size_t end) {
    const LocalMesh& mesh = prepared_.caster().mesh();
    std::vector<ScatteredRay>& departures = workspace_.departures;
    departures.clear();
    workspace_.departing.resize((end - first) * prepared_.bands());
    draw_numbers(first, end);
    Surface at;
    Vec3 up;
    for (std::size_t i = first; i < end; ++i) {
        const PathVertex& start = workspace_.starts[workspace_.order[i]];
        if (start.triangle != at.triangle) {
            at.triangle = start.triangle;
            at.region = prepared_.region(start.triangle);
            up = normalized(mesh.across(start.triangle));
        }
        const Particle path = path_of(i);
        at.upper = dot(up, path.direction) < 0;
        at.normal = at.upper ? up : -up;
        const std::array<double, 2> numbers{workspace_.u0[i - first], workspace_.u1[i - first]};
        const auto direction =
            depart(rules_, path, at, numbers, weights_of(departures.size()), tally_);
        if (direction) {
            departures.push_back(
                {mesh.point(at.triangle, start.u, start.v), *direction, at.triangle, i});
        }
    }
}

/// Per band, of light that departs.
std::span<double> ScatterSource::weights_of(std::size_t departure) {
    return std::span(workspace_.departing)
        .subspan(departure * prepared_.bands(), prepared_.bands());
}

/// The numbers by which light departs.
void ScatterSource::draw_numbers(std::size_t first, std::size_t end) {
    const std::size_t count = end - first;
    workspace_.u0.resize(count);
    workspace_.u1.resize(count);
    const std::uint32_t dimension = rules_.scatter_dimension;
    if (!spread_) {
        const std::uint64_t point = rules_.stream.first + first;
        rules_.sampler->coordinates(rules_.stream, point, dimension, workspace_.u0);
        rules_.sampler->coordinates(rules_.stream, point, dimension + 1, workspace_.u1);
        return;
    }
    for (std::size_t k = 0; k < count; ++k) {
        const std::uint64_t point = path_of(first + k).point;
        workspace_.u0[k] = rules_.sampler->coordinate(rules_.stream, point, dimension);
        workspace_.u1[k] = rules_.sampler->coordinate(rules_.stream, point, dimension + 1);
    }
}

}  // namespace quasimc
