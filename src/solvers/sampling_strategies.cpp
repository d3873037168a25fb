// What one contribution may bring to each side of the regions: docs/theory/statistics.md.

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

/// A direction of the middle of a sun.
Vec3 direction_of(const BoundSource& sun) {
    const SourceSampler& sampler = *sun.source_sampler;
    return sampler.beam_direction() ? *sampler.beam_direction()
                                    : sampler.draw_direction(0.5, 0.5).direction;
}

/// How large a region looks to a sun, and its area.
struct QuadratureNode {
    double seen = 0, area = 0;
};

/// By region, how much area a sun lights for each unit of area across its light, at most.
/// @param wanted  which suns
template <typename Wanted>
std::vector<double> slants(const PreparedScene& prepared, const Wanted& wanted) {
    // Of very many suns some stand for all: their directions lie close.
    constexpr double kMaxDirectLights = 1e8;
    const double looks =
        static_cast<double>(prepared.lights().size()) * prepared.caster().mesh().triangle_count();
    const auto stride =
        static_cast<std::size_t>(std::ceil(std::max(1.0, looks / kMaxDirectLights)));
    std::vector<double> most(prepared.scene().regions().size());
    for (std::size_t light = 0; light < prepared.lights().size(); light += stride) {
        if (!wanted(prepared.lights()[light])) {
            continue;
        }
        const Vec3 direction = direction_of(prepared.lights()[light]);
        std::vector<QuadratureNode> seen(most.size());
        for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
            seen[region].seen += std::abs(dot(area, direction));
            seen[region].area += length(area);
        });
        for (std::size_t i = 0; i < most.size(); ++i) {
            most[i] = std::max(most[i], seen[i].seen > 0 ? seen[i].area / seen[i].seen : 0);
        }
    }
    return most;
}

/// By region, the area that a path of a sun lights at most: of the unit of a contribution, which is
/// a path of the sun that is picked most seldom.
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

/// The strategies for the lights that are `wanted`, found by paths: a spectrum is one, so that what
/// many paths of bright lights tell does not hide that a faint one has few; all are one if they are
/// many.
template <typename Wanted>
void add_strategies(
    const PreparedScene& prepared,
    const Wanted& wanted,
    std::vector<SamplingStrategy>& strategies) {
    constexpr std::size_t kMaxDistance = 8;
    const std::vector<std::size_t> spectra = strategy_of(prepared, wanted).spectra;
    const std::size_t count = spectra.size() <= kMaxDistance ? spectra.size() : 1;
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

}  // namespace

std::vector<SamplingStrategy> strategies_by_path(const PreparedScene& prepared) {
    std::vector<SamplingStrategy> strategies;
    add_strategies(prepared, is_sun, strategies);
    add_strategies(
        prepared, [](const BoundSource& light) { return light.is_extended(); }, strategies);
    add_strategies(prepared, is_lamp, strategies);
    return strategies;
}

/// Of the light along a direction a region gets the part that it takes of the box around the scene,
/// as seen along it: at most what it is along one of the axes, since both are sums over these.
SamplingStrategy strategy_by_direction(
    const PreparedScene& prepared, std::uint32_t directions, double step) {
    SamplingStrategy strategy =
        strategy_of(prepared, [](const BoundSource& light) { return light.is_extended(); });
    strategy.by = SampledBy::directions;
    // Not sheared, as many are, more replicates see the same number.
    constexpr double kManyAlike = 7;
    strategy.many = directions > kMaxShearedDirections ? kManyAlike : strategy.many;
    strategy.step = step;
    std::vector<Vec3> up(prepared.scene().regions().size());
    std::vector<Vec3> down(up.size());
    for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
        const Vec3 sideways{std::abs(area.x), std::abs(area.y), 0};
        up[region] += sideways + Vec3{0, 0, std::max(0.0, area.z)};
        down[region] += sideways + Vec3{0, 0, std::max(0.0, -area.z)};
    });
    // Of a scene without end only the top lets light in: what comes in flatter than so does not
    // count, or the part would have no bound.
    constexpr double kFlat = 0.125;
    Vec3 face = prepared.projection().entry_box().face_area;
    const double least = kFlat * std::max({face.x, face.y, face.z});
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

/// A line brings a region at most what falls on a stretch as long as the region.
///
/// Lines of a replicate lie `spacing` apart, in a direction of their own: a lit part that is wider
/// across them is met. One that no replicate has met is thus about as narrow in all of their
/// directions, and a line that met it would cut no more than twice that.
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
        std::vector<QuadratureNode> looks(longest.size());
        for_each_triangle(prepared, [&](std::uint32_t, std::uint32_t region, const Vec3& area) {
            const double along = dot(area, direction);
            looks[region].seen += std::abs(along);
            looks[region].area += length(area);
            // What is seen at less is seen edge-on, as along the lines.
            if (std::abs(along) > kEdgeOn * length(area)) {
                strategy.reach[std::size_t{2} * region + (along > 0 ? 1 : 0)] = longest[region];
            }
        });
        for (std::size_t i = 0; i < looks.size(); ++i) {
            const double slant = looks[i].seen > 0 ? looks[i].area / looks[i].seen : 0;
            strategy.sunlit_reach[i] = std::max(strategy.sunlit_reach[i], longest[i] * slant);
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
            // A path is one contribution, whichever region of the organ it meets.
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
