#include "solvers/direct/path_vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include "scene/scene.h"
#include "transport/absorbed_light.h"
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

/// Number of bits per direction of the tiles by which vertices of a triangle are sorted.
unsigned tile_bits(std::size_t vertices, std::uint32_t triangles) {
    // About one vertex a tile, and at most 16 tiles a side.
    const auto bits =
        std::min(4U, static_cast<unsigned>(std::bit_width(vertices / triangles + 1) - 1) / 2);
    return std::bit_width(triangles) + 2 * bits <= 32 ? bits : 0;
}

/// Sets the sort keys of vertices: triangle, then tile.
void set_keys(
    std::span<const PathVertex> vertices, unsigned bits, std::vector<std::uint32_t>& keys) {
    const auto side = static_cast<float>(1U << bits);
    keys.clear();
    for (const PathVertex& vertex : vertices) {
        const auto column = static_cast<std::uint32_t>(std::clamp(vertex.u, 0.0F, .999F) * side);
        const auto row = static_cast<std::uint32_t>(std::clamp(vertex.v, 0.0F, .999F) * side);
        keys.push_back(vertex.triangle << (2 * bits) | interleaved(column, row));
    }
}

}  // namespace

ScatteredShares::ScatteredShares(const PreparedScene& prepared)
    : materials_(data_of(prepared.scene()).materials.size()) {
    const std::vector<bool> is_used = used_materials(prepared.scene());
    for (const auto& spectrum : prepared.lights().spectra()) {
        for (std::size_t m = 0; m < materials_; ++m) {
            const Material& material = data_of(prepared.scene()).materials[m];
            const bool scatters = is_used[m] && !material.is_transparent();
            for (const SurfaceSide side : kSurfaceSides) {
                shares_.push_back(scatters ? mean_albedo(material.side(side), spectrum) : 0);
            }
        }
    }
    const double largest = *std::max_element(shares_.begin(), shares_.end());
    for (double& share : shares_) {
        share = largest > 0 ? share / largest : 0;
    }
}

ScatteringPiece scattering_piece(
    const PreparedScene& prepared,
    const ScatteredShares& shares,
    const SurfaceBeam& beam,
    std::uint32_t triangle,
    double along,
    double amount) {
    const double share = shares.of(
        beam.light->spectrum, prepared.primitive(triangle).material,
        along > 0 ? SurfaceSide::lower : SurfaceSide::upper);
    return {amount * share, share > 0 ? 1 / share : 0, triangle};
}

void DirectLightScore::add_sunlit(std::uint32_t triangle, double along, double amount) {
    if (prepared_.rounding().is_sunlit(triangle, beam_.direction, along)) {
        const double area =
            prepared_.rounding().area_share(triangle) * beam_.light->lit_area / std::abs(along);
        tally_.add_sunlit(
            prepared_.region(triangle), along > 0 ? SurfaceSide::lower : SurfaceSide::upper,
            to_fixed(amount * area));
    }
}

void DirectLightScore::add_absorbed(std::uint32_t region, double along, double amount) {
    const SurfaceSide side = along > 0 ? SurfaceSide::lower : SurfaceSide::upper;
    score_absorbed(
        prepared_,
        {region, side, std::abs(along), direct_part(*beam_.light), beam_.light->origin, amount,
         beam_.light->start_weights},
        tally_);
}

void DirectLightScore::add_escaped() {
    const LightBlocks& blocks = tally_.blocks();
    const std::int64_t emitted = to_fixed(beam_.paths);
    tally_.add(blocks.emitted() + beam_.light->spectrum, emitted);
    tally_.add_signed(blocks.escaped_direct() + beam_.light->spectrum, emitted - stopped_);
}

void order_by_position(
    std::span<const PathVertex> vertices, std::uint32_t triangles, VertexOrder& order) {
    // Digit by digit from the lowest (radix sort), which a few thousand vertices on any number of
    // triangles need but two or three of.
    constexpr unsigned kDigit = 11;
    constexpr std::uint32_t kMask = (1U << kDigit) - 1;
    const unsigned bits = tile_bits(vertices.size(), triangles);
    set_keys(vertices, bits, order.keys);
    const std::uint64_t keys = std::uint64_t{triangles} << (2 * bits);
    order.order.resize(vertices.size());
    order.next.resize(vertices.size());
    std::iota(order.order.begin(), order.order.end(), 0U);
    for (unsigned shift = 0; (keys >> shift) > 0; shift += kDigit) {
        const auto digit = [&](std::uint32_t i) { return (order.keys[i] >> shift) & kMask; };
        order.key_counts.assign(std::size_t{kMask} + 2, 0);
        for (const std::uint32_t i : order.order) {
            ++order.key_counts[digit(i) + 1];
        }
        std::partial_sum(
            order.key_counts.begin(), order.key_counts.end(), order.key_counts.begin());
        for (const std::uint32_t i : order.order) {
            order.next[order.key_counts[digit(i)]++] = i;
        }
        order.order.swap(order.next);
    }
}

}  // namespace quasimc
