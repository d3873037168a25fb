// The largest contributions to each side of the regions: docs/theory/statistics.md.

#include "solvers/sampling_strategies.h"

#include <algorithm>
#include <cmath>

#include "base/vec3.h"
#include "transport/sky_directions.h"

namespace quasimc {
namespace {

bool is_sun(const BoundSource& light) {
    return light.source->is_sun();
}
bool is_lamp(const BoundSource& light) {
    return light.source->is_lamp();
}

/// A strategy for the lights that are `wanted`, sampled by paths.
template <typename Wanted>
SamplingStrategy strategy_of(const PreparedScene& prepared, const Wanted& wanted) {
    SamplingStrategy strategy;
    strategy.flux.assign(prepared.bands(), 0);
    std::vector<bool> has(prepared.lights().spectra().size());
    for (const BoundSource& light : prepared.lights()) {
        if (!wanted(light)) {
            continue;
        }
        strategy.has_suns = strategy.has_suns || is_sun(light);
        if (!has[light.spectrum]) {
            has[light.spectrum] = true;
            strategy.spectra.push_back(light.spectrum);
        }
        for (std::size_t b = 0; b < strategy.flux.size(); ++b) {
            strategy.flux[b] =
                std::max(strategy.flux[b], prepared.lights().flux()[b] * light.start_weights[b]);
        }
    }
    return strategy;
}

/// Calls `visit(triangle, region, area vector)` for each triangle once, not for its images.
template <typename Visit>
void for_each_triangle(const PreparedScene& prepared, const Visit& visit) {
    const RayCaster& caster = prepared.caster();
    const bool repeats = prepared.scene().cell().periodic();
    for (std::uint32_t i = 0; i < caster.mesh().triangle_count(); ++i) {
        if (!repeats || i == 0 || caster.source(i) != caster.source(i - 1)) {
            visit(i, prepared.region(i), caster.mesh().across(i) / 2);
        }
    }
}

/// By region, the diameter of a box around it.
std::vector<double> diameters(const PreparedScene& prepared) {
    std::vector<Bounds> boxes(prepared.scene().regions().size());
    for_each_triangle(prepared, [&](std::uint32_t i, std::uint32_t region, const Vec3&) {
        for (int corner = 0; corner < 3; ++corner) {
            boxes[region].add(prepared.caster().mesh().vertex(i, corner));
        }
    });
    std::vector<double> all;
    all.reserve(boxes.size());
    for (const Bounds& box : boxes) {
        all.push_back(box.low.x <= box.high.x ? length(box.size()) : 0);
    }
    return all;
}

/// The direction of light from the centre of a sun.
Vec3 direction_of(const BoundSource& sun) {
    const SourceSampler& sampler = *sun.source_sampler;
    return sampler.beam_direction() ? *sampler.beam_direction()
                                    : sampler.draw_direction(0.5, 0.5).direction;
}

/// Projected area of a region along the light of a sun, and its area.
struct LitAreas {
    double projected = 0, area = 0;

    /// Adds a triangle, unless it is edge-on to the light.
    void add(const Vec3& triangle, const Vec3& direction) {
        const double along = std::abs(dot(triangle, direction));
        if (along > kEdgeOn * length(triangle)) {
            projected += along;
            area += length(triangle);
        }
    }
};

/// If there are very many suns, every n-th of them represents all: their directions are close.
std::size_t stride_of_suns(const PreparedScene& prepared) {
    constexpr double kMaxVisits = 1e7;
    const double visits =
        static_cast<double>(prepared.lights().size()) * prepared.caster().mesh().triangle_count();
    return static_cast<std::size_t>(std::ceil(std::max(1.0, visits / kMaxVisits)));
}

/// By region, the largest ratio of lit area to projected area for a sun.
/// @param wanted  which suns
template <typename Wanted>
std::vector<double> slants(const PreparedScene& prepared, const Wanted& wanted) {
    const std::size_t stride = stride_of_suns(prepared);
    std::vector<double> most(prepared.scene().regions().size());
    for (std::size_t light = 0; light < prepared.lights().size(); light += stride) {
        if (!wanted(prepared.lights()[light])) {
            continue;
        }
        const Vec3 direction = direction_of(prepared.lights()[light]);
        std::vector<LitAreas> regions(most.size());
        for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
            regions[region].add(area, direction);
        });
        for (std::size_t i = 0; i < most.size(); ++i) {
            most[i] = std::max(
                most[i], regions[i].projected > 0 ? regions[i].area / regions[i].projected : 0);
        }
    }
    return most;
}

/// By region, the largest area that a path of a sun lights, relative to the unit of a contribution:
/// a path of the sun with the smallest probability.
template <typename Wanted>
std::vector<double> sunlit_by_path(const PreparedScene& prepared, const Wanted& wanted) {
    double largest = 0;
    double own = 0;
    for (const BoundSource& light : prepared.lights()) {
        largest = std::max(largest, light.lit_area);
        own = std::max(own, wanted(light) ? light.lit_area : 0);
    }
    std::vector<double> lit = slants(prepared, wanted);
    for (double& area : lit) {
        area *= own / largest;
    }
    return lit;
}

/// Adds strategies for the lights that are `wanted`, sampled by paths: one for each spectrum, so
/// that many contributions of bright lights do not hide few of a faint one; a single one if spectra
/// are many.
template <typename Wanted>
void add_strategies(
    const PreparedScene& prepared,
    const Wanted& wanted,
    std::vector<SamplingStrategy>& strategies) {
    constexpr std::size_t kMaxSeparate = 8;
    const std::vector<std::size_t> spectra = strategy_of(prepared, wanted).spectra;
    const std::size_t count = spectra.size() <= kMaxSeparate ? spectra.size() : 1;
    for (std::size_t i = 0; i < count; ++i) {
        const auto is_own = [&](const BoundSource& light) {
            return wanted(light) && (count == 1 || light.spectrum == spectra[i]);
        };
        strategies.push_back(strategy_of(prepared, is_own));
        if (strategies.back().has_suns) {
            strategies.back().sunlit_reach = sunlit_by_path(prepared, is_own);
        }
    }
}

/// In a periodic scene light enters only through the top: without a lowest height of directions,
/// the fraction of it that a region receives would have no bound. This is the least part of the
/// largest face.
constexpr double kMinBeam = 0.125;

}  // namespace

std::vector<SamplingStrategy> strategies_by_path(const PreparedScene& prepared) {
    std::vector<SamplingStrategy> strategies;
    add_strategies(prepared, is_sun, strategies);
    add_strategies(
        prepared, [](const BoundSource& light) { return light.is_extended(); }, strategies);
    add_strategies(prepared, is_lamp, strategies);
    return strategies;
}

/// A region receives the fraction of the light along a direction that its projected area is of the
/// projected box of the scene. Both are sums over the axes, so this is at most the largest fraction
/// along an axis.
SamplingStrategy strategy_by_direction(const PreparedScene& prepared, double step) {
    SamplingStrategy strategy =
        strategy_of(prepared, [](const BoundSource& light) { return light.is_extended(); });
    strategy.by = SampledBy::directions;
    // Directions are even, and more replicates than of paths have the same number of contributions.
    strategy.many = 7;
    strategy.step = step;
    std::vector<Vec3> up(prepared.scene().regions().size());
    std::vector<Vec3> down(up.size());
    for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
        const Vec3 sideways{std::abs(area.x), std::abs(area.y), 0};
        up[region] += sideways + Vec3{0, 0, std::max(0.0, area.z)};
        down[region] += sideways + Vec3{0, 0, std::max(0.0, -area.z)};
    });
    Vec3 face = prepared.projection().entry_box().face_area;
    const double least = kMinBeam * std::max({face.x, face.y, face.z});
    face = prepared.scene().cell().periodic()
               ? Vec3{std::max(face.x, least), std::max(face.y, least), std::max(face.z, least)}
               : face;
    const auto part = [&](const Vec3& area) {
        const auto of = [](double a, double whole) { return a > 0 && whole > 0 ? a / whole : 0; };
        return std::min(
            1.0, std::max({of(area.x, face.x), of(area.y, face.y), of(area.z, face.z)}));
    };
    for (std::size_t i = 0; i < up.size(); ++i) {
        strategy.reach.push_back(part(up[i]));
        strategy.reach.push_back(part(down[i]));
    }
    return strategy;
}

/// A line contributes to a region at most the light on a segment as long as the region.
///
/// Lines of a replicate are `spacing` apart, in a random orientation, and meet every lit part that
/// is wider across them. A part that no replicate has met is thus about as narrow in all of their
/// orientations, and a line that met it would have a segment of at most twice that length.
SamplingStrategy strategy_by_line(
    const PreparedScene& prepared,
    const std::vector<bool>& has_lines,
    double step,
    double spacing) {
    SamplingStrategy strategy = strategy_of(prepared, is_sun);
    strategy.by = SampledBy::lines;
    strategy.step = step;
    strategy.unseen_reach = 2 * spacing;
    const std::vector<double> longest = diameters(prepared);
    strategy.reach.assign(2 * longest.size(), 0);
    strategy.sunlit_reach.assign(longest.size(), 0);
    for (std::size_t light = 0; light < has_lines.size(); ++light) {
        if (!has_lines[light]) {
            continue;
        }
        const Vec3 direction = direction_of(prepared.lights()[light]);
        std::vector<LitAreas> regions(longest.size());
        for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
            const double along = dot(area, direction);
            regions[region].add(area, direction);
            // At smaller cosines a triangle counts as edge-on to the light.
            if (std::abs(along) > kEdgeOn * length(area)) {
                strategy.reach[std::size_t{2} * region + (along > 0 ? 1 : 0)] = longest[region];
            }
        });
        for (std::size_t i = 0; i < regions.size(); ++i) {
            const double slant =
                regions[i].projected > 0 ? regions[i].area / regions[i].projected : 0;
            strategy.sunlit_reach[i] = std::max(strategy.sunlit_reach[i], longest[i] * slant);
        }
    }
    return strategy;
}

SamplingStrategy strategy_by_pick(
    const PreparedScene& prepared, const std::vector<bool>& has_lines, double step) {
    SamplingStrategy strategy = strategy_of(prepared, is_sun);
    strategy.by = SampledBy::lines;
    strategy.step = step;
    const EntryBox& box = prepared.projection().entry_box();
    const double least = prepared.scene().cell().periodic() ? kMinBeam * box.face_area.z : 0;
    const std::size_t regions = prepared.scene().regions().size();
    strategy.reach.assign(2 * regions, 0);
    strategy.sunlit_reach.assign(regions, 0);
    const std::size_t stride = stride_of_suns(prepared);
    for (std::size_t light = 0; light < has_lines.size(); light += stride) {
        if (!has_lines[light]) {
            continue;
        }
        const Vec3 direction = direction_of(prepared.lights()[light]);
        const double beam = std::max(least, box.projected_area(direction));
        std::vector<double> sides(2 * regions);
        std::vector<double> areas(regions);
        for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
            const double along = dot(area, direction);
            sides[std::size_t{2} * region + (along > 0 ? 1 : 0)] += std::abs(along) / beam;
            areas[region] += length(area) / beam;
        });
        for (std::size_t i = 0; i < sides.size(); ++i) {
            strategy.reach[i] = std::max(strategy.reach[i], std::min(1.0, sides[i]));
        }
        for (std::size_t i = 0; i < regions; ++i) {
            strategy.sunlit_reach[i] = std::max(strategy.sunlit_reach[i], areas[i]);
        }
    }
    return strategy;
}

SamplingStrategy strategy_of_traced_suns(
    const PreparedScene& prepared, const std::vector<bool>& has_lines) {
    const auto is_wanted = [&](const BoundSource& light) {
        const auto number = prepared.lights().index_of(light);
        return is_sun(light) && !has_lines[number];
    };
    SamplingStrategy strategy = strategy_of(prepared, is_wanted);
    strategy.spectra.clear();
    strategy.sunlit_reach = slants(prepared, is_wanted);
    const Scene& scene = prepared.scene();
    strategy.reach.assign(2 * scene.regions().size(), 0);
    for (const BoundSource& light : prepared.lights()) {
        if (!is_wanted(light)) {
            continue;
        }
        const Vec3 direction = direction_of(light);
        for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
            // A path is one contribution to an organ, for any of its regions.
            const Organ& organ = scene.organs()[scene.regions()[region].organ.value];
            const double along = dot(area, direction);
            if (std::abs(along) > kEdgeOn * length(area)) {
                strategy.reach[std::size_t{2} * organ.first_region + (along > 0 ? 1 : 0)] = 1;
            }
        });
    }
    return strategy;
}

}  // namespace quasimc
