#include "quasimc/tracing/surface_light.h"

#include <bit>
#include <cmath>
#include <numeric>

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

/// The hit of a ray that met a triangle there.
Hit hit_at(const LocalMesh& mesh, const SurfaceStart& start) {
    const Vec3 up = mesh.across(start.triangle);
    return {
        start.triangle,
        0,
        start.u,
        start.v,
        {static_cast<float>(up.x), static_cast<float>(up.y), static_cast<float>(up.z)}};
}

/// Sets workspace.order to that of the triangles, stable: digit by digit from the lowest (radix
/// sort), which a few thousand starts on any number of triangles need but two or three of.
void order_by_triangle(
    const std::vector<SurfaceStart>& starts, std::uint32_t triangles, Workspace& workspace) {
    constexpr unsigned kDigit = 11;
    constexpr std::uint32_t kMask = (1U << kDigit) - 1;
    std::vector<std::uint32_t>& order = workspace.order;
    std::vector<std::uint32_t>& next = workspace.keys;
    order.resize(starts.size());
    next.resize(starts.size());
    std::iota(order.begin(), order.end(), 0U);
    for (unsigned shift = 0; shift < 32 && (triangles >> shift) > 0; shift += kDigit) {
        const auto digit = [&](std::uint32_t i) { return (starts[i].triangle >> shift) & kMask; };
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

ScatteredShares::ScatteredShares(const Stage& stage)
    : materials_(stage.scene().materials().size()) {
    for (const auto& spectrum : stage.spectra()) {
        for (const Material& material : stage.scene().materials()) {
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

SurfaceLight::SurfaceLight(
    const ScatteredShares& shares, const PathRules& rules, Workspace& workspace, Tally& tally)
    : shares_(shares), rules_(rules), stage_(*rules.stage), workspace_(workspace), tally_(tally) {
    workspace_.starts.clear();
    workspace_.beams.clear();
}

void SurfaceLight::begin_beam(
    const Light& light, const Vec3& direction, double paths, double& to_next) {
    light_ = &light;
    to_next_ = &to_next;
    emitted_ = to_fixed(paths);
    stopped_ = 0;
    workspace_.beams.push_back({&light, direction});
}

void SurfaceLight::fall(std::uint32_t triangle, double cosine, double amount) {
    const Facet& facet = stage_.facet(triangle);
    const TallyLayout& layout = tally_.layout();
    const std::int64_t fixed = to_fixed(amount);
    if (stage_.counts(facet.element, std::abs(cosine))) {
        tally_.add_two(
            facet.element, layout.direct(0, cosine > 0, light_->spectrum), fixed, layout.sunlit(0),
            to_fixed(amount * light_->lit_area / std::abs(cosine)));
    }
    if (!stage_.material(facet.element).is_transparent()) {
        stopped_ += fixed;
    }
}

ShiningPiece SurfaceLight::shining(std::uint32_t triangle, double cosine, double amount) const {
    const double share = shares_.of(light_->spectrum, stage_.facet(triangle).material, cosine > 0);
    return {amount * share, share > 0 ? 1 / share : 0, triangle};
}

void SurfaceLight::add_start(std::uint32_t triangle, float u, float v, double weight) {
    const auto beam = static_cast<std::uint32_t>(workspace_.beams.size() - 1);
    workspace_.starts.push_back({triangle, beam, u, v, weight});
}

void SurfaceLight::end_beam() {
    const TallyLayout& layout = tally_.layout();
    tally_.add(layout.emitted() + light_->spectrum, emitted_);
    tally_.add(layout.escaped_direct() + light_->spectrum, emitted_ - stopped_);
}

void SurfaceLight::trace() {
    const std::vector<SurfaceStart>& starts = workspace_.starts;
    order_by_triangle(starts, stage_.caster().mesh().triangle_count(), workspace_);
    rules_.stream.count = std::bit_ceil(starts.size() + 1);
    // Part of a lattice must be spread over all of it, and its first coordinate, which grows with
    // the number, is left out: a surface would send all its light one way.
    const bool spread = rules_.sampler->needs_power_of_two();
    rules_.scatter_dimension = spread ? 1 : 0;
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const SurfaceStart& start = starts[workspace_.order[i]];
        const SurfaceBeam& beam = workspace_.beams[start.beam];
        const std::uint64_t place = spread ? i * rules_.stream.count / starts.size() : i;
        const LightPath path{beam.light, rules_.stream.first + place, beam.direction, start.weight};
        rays += follow(
            rules_, path, {RayEnd::hit, hit_at(stage_.caster().mesh(), start)},
            FirstHit::surely_scattered, workspace_, tally_);
    }
    tally_.add(tally_.layout().rays(), static_cast<std::int64_t>(rays));
}

}  // namespace quasimc
