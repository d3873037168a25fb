// Upper limits of energy conservation: docs/theory/statistics.md.

#include "results/bounds/physical_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/vec3.h"
#include "light/models/source.h"
#include "results/bounds/organ_reader.h"
#include "scene/sensors.h"
#include "transport/prepared_scene.h"

namespace quasimc {
namespace {

constexpr double kUnlimited = std::numeric_limits<double>::infinity();

/// An upper bound of a source's irradiance on any orientation: bounds that are linear or convex in
/// the normal allow the diagonal of those along the axes.
double most_facing(const Source& source) {
    double squares = 0;
    for (const Vec3& axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const double most = std::max(
            model_of(source).most_irradiance(axis), model_of(source).most_irradiance(-axis));
        squares += most * most;
    }
    return std::sqrt(squares);
}

/// Whether some of the organ transmits light undisturbed, so that light may hit it repeatedly.
bool has_sensor(const Scene& scene, const Organ& organ) {
    for (std::uint32_t i = 0; i < organ.region_count; ++i) {
        if (data_of(scene).material(scene.regions()[organ.first_region + i]).is_transparent()) {
            return true;
        }
    }
    return false;
}

/// The smallest absorptance of any side of the organ.
double least_absorptance(const Scene& scene, const Organ& organ, std::size_t band) {
    double least = 1;
    for (std::uint32_t i = 0; i < organ.region_count; ++i) {
        const Material& material = data_of(scene).material(scene.regions()[organ.first_region + i]);
        for (const SurfaceSide side : kSurfaceSides) {
            least = std::min(least, material.side(side).absorptance()[band]);
        }
    }
    return least;
}

}  // namespace

double OrganLimits::of(Quantity quantity, std::size_t band) const {
    const LightParts& parts = parts_of(quantity);
    const double most = light(parts, band);
    return parts.is_absorbed ? std::min(emitted[band], most) : most;  // absorbed light fell on it
}

double OrganLimits::light(const LightParts& parts, std::size_t band) const {
    double most = 0;
    most += parts.direct && parts.upper ? direct_upper[band] : 0;
    most += parts.direct && parts.lower ? direct_lower[band] : 0;
    most += parts.scattered ? scattered[band] : 0;
    return most;
}

void OrganLimits::add(const OrganLimits& other, double weight) {
    const auto add_to = [&](std::vector<double>& to, const std::vector<double>& from) {
        for (std::size_t b = 0; b < to.size(); ++b) {
            to[b] += weight * from[b];
        }
    };
    add_to(direct_upper, other.direct_upper);
    add_to(direct_lower, other.direct_lower);
    add_to(scattered, other.scattered);
    sunlit_area += weight * other.sunlit_area;
}

PhysicalBounds::PhysicalBounds(
    const Scene& scene, const EvaluationSpec& spec, std::span<const double> emitted)
    : scene_(scene),
      facing_(scene.bands().size()),
      lamps_(scene.bands().size()),
      emitted_(emitted.begin(), emitted.end()),
      is_known_(!spec.sources.empty()),
      knows_suns_(is_known_) {
    emitted_.resize(scene.bands().size(), kUnlimited);
    for (const auto& source : spec.sources) {
        const bool is_lamp = source->is_lamp();
        if (!is_lamp && single_sources_.size() < kMaxDirectLights) {
            single_sources_.push_back(source.get());
            continue;
        }
        knows_suns_ = knows_suns_ && !source->is_sun();
        std::vector<double>& sum = is_lamp ? lamps_ : facing_;
        for (std::size_t b = 0; b < sum.size(); ++b) {
            const double own = source->spectrum()[b];
            sum[b] += own > 0 ? own * (is_lamp ? 1 : most_facing(*source)) : 0;
        }
    }
    const std::vector<double> albedo = largest_albedos(scene);
    for (std::size_t b = 0; b < emitted_.size(); ++b) {
        // At most this share of the light on surfaces leaves them, and so on.
        const double all = albedo[b] < 1 ? emitted_[b] * albedo[b] / (1 - albedo[b]) : kUnlimited;
        scattered_.push_back(albedo[b] > 0 ? all : 0);
    }
}

PhysicalBounds::UnoccludedSides PhysicalBounds::unoccluded_sides(const Organ& organ) const {
    UnoccludedSides sides;
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        const Triangle triangle =
            data_of(scene_).triangles()[std::size_t{organ.first_triangle} + i];
        const Vec3 across = 0.5 * area_vector(triangle);
        const double area = length(across);
        const Vec3 normal = area > 0 ? across / area : Vec3{};
        bool is_sunlit = false;
        for (std::size_t s = 0; area > 0 && s < single_sources_.size(); ++s) {
            const double above = model_of(*single_sources_[s]).most_irradiance(normal);
            const double below = model_of(*single_sources_[s]).most_irradiance(-normal);
            sides.upper[s] += area * above;
            sides.lower[s] += area * below;
            is_sunlit =
                is_sunlit || (single_sources_[s]->is_sun() && std::max(above, below) > kEdgeOn);
        }
        sides.sunlit_area += is_sunlit ? area : 0;
    }
    return sides;
}

void PhysicalBounds::find(const Organ& organ, OrganLimits& limits) const {
    if (is_point_sensor(organ)) {
        limits = OrganLimits(emitted_);
        for (std::vector<double>* light :
             {&limits.direct_upper, &limits.direct_lower, &limits.scattered}) {
            std::fill(light->begin(), light->end(), kUnlimited);
        }
        limits.sunlit_area = organ.area;
        return;
    }
    const UnoccludedSides sides = unoccluded_sides(organ);
    // All area of an organ, within rounding.
    const bool is_all = !knows_suns_ || sides.sunlit_area >= kFullyLit * organ.area;
    limits.sunlit_area = is_all ? organ.area : sides.sunlit_area;
    const bool is_sensor = has_sensor(scene_, organ);
    for (std::size_t b = 0; b < emitted_.size(); ++b) {
        const double lamps = is_sensor && lamps_[b] > 0 ? kUnlimited : lamps_[b];
        const double others = is_known_ ? facing_[b] * organ.area + lamps : kUnlimited;
        limits.direct_upper[b] = limits.direct_lower[b] = others;
        for (std::size_t s = 0; s < single_sources_.size(); ++s) {
            const double own = single_sources_[s]->spectrum()[b];
            limits.direct_upper[b] += own > 0 ? own * sides.upper[s] : 0;
            limits.direct_lower[b] += own > 0 ? own * sides.lower[s] : 0;
        }
        const double absorptance = least_absorptance(scene_, organ, b);
        // The incident light of a surface that absorbs some of it.
        const double before = absorptance > 0 ? emitted_[b] / absorptance : kUnlimited;
        limits.scattered[b] = is_sensor ? kUnlimited : std::min(scattered_[b], before);
    }
}

}  // namespace quasimc
