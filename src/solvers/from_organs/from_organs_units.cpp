#include "solvers/from_organs/from_organs_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene/scene.h"
#include "scene/sensors.h"
#include "solvers/from_organs/from_organs.h"
#include "sums/fixed_point.h"
#include "transport/organ_shares.h"

namespace quasimc {
namespace {

/// Whether light comes from suns or lamps, or from skies.
bool has_small_light(const PreparedScene& prepared) {
    const auto& lights = prepared.lights();
    return std::any_of(lights.begin(), lights.end(), [](const BoundSource& light) {
        return !light.is_extended();
    });
}
bool has_sky(const PreparedScene& prepared) {
    const auto& lights = prepared.lights();
    return std::any_of(
        lights.begin(), lights.end(), [](const BoundSource& light) { return light.is_extended(); });
}

/// Whether light subpaths sample light of suns or lamps through narrow lobes.
bool has_followed_lobes(const PreparedScene& prepared) {
    return has_small_light(prepared) &&
           prepared.optics().largest_peak >= followed_peak(prepared.scene());
}

/// The largest fraction of incident light that a material of the scene scatters to one of its
/// sides. Twice this is the irradiance that a point samples from a Lambertian surface (pi for the
/// cosine law over pi, 2 for the choice of a side). A contribution through a Phong lobe is on
/// average half as bright as its peak; through narrow lobes points sample only skies.
/// @param narrow_from  peak_brightness() from which on lobes are narrow
double brightest(const PreparedScene& prepared, std::size_t band, double narrow_from) {
    constexpr double kUsual = 0.5;
    const double by_narrow = has_sky(prepared) ? 1 : 0;
    double most = 0;
    for (std::uint32_t region = 0; region < prepared.scene().regions().size(); ++region) {
        const Material& material = prepared.material(region);
        for (const SurfaceSide side : kSurfaceSides) {
            std::array<double, 2> sum{};
            for (const Lobe& lobe : material.side(side).lobes()) {
                const double peak = peak_brightness(*lobe.shape);
                sum[lobe.shape->hemisphere() == Hemisphere::reflected ? 0 : 1] +=
                    lobe.albedo[band] *
                    (peak < narrow_from ? std::max(1.0, kUsual * peak) : by_narrow);
            }
            most = material.is_transparent() ? most : std::max({most, sum[0], sum[1]});
        }
    }
    return most;
}

/// Approximate irradiance that a light vertex contributes to a point by way of another surface,
/// over the square of the albedo: all light of a lamp, for a spectrum of 1, spread over a
/// hemisphere of the radius of its near field.
double irradiance_by_vertex(const LampNearField& near, const BoundSource& light) {
    const double radius = near.scatter_radius(light);
    return radius > 0 ? light.source_sampler->flux() / (2 * std::numbers::pi * radius * radius) : 0;
}

Bounds local_bounds(const PreparedScene& prepared, const Organ& organ) {
    Bounds box;
    for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
        for (const Vec3& corner :
             data_of(prepared.scene()).triangles()[std::size_t{organ.first_triangle} + i]) {
            box.add(prepared.caster().mesh().to_local(corner));
        }
    }
    return box;
}

/// Organs that receive less than this fraction of the light that leaves the near field of lamps are
/// connected with points there. Others are hit by enough paths.
constexpr double kFewOfPaths = 0.05;

double part_by_vertices(
    const PreparedScene& prepared,
    const MeasuredArea& measured,
    const LampNearField& near,
    const Organ& organ) {
    if (is_point_sensor(organ)) {
        return 0;  // no path hits it
    }
    constexpr double kConnections = 2;  // in a row
    const Bounds box = local_bounds(prepared, organ);
    const double area = organ.area / prepared.projection().world_area();
    double part = 0;
    for (const BoundSource& light : prepared.lights()) {
        const double gap = light.source->is_lamp() ? near.gap_to(light, box)
                                                   : std::numeric_limits<double>::infinity();
        const double all = static_cast<double>(measured.organs.size()) * area;
        part = std::max(
            part, gap < kConnections * near.min_connection_distance(light)
                      ? 1
                      : all / (std::numbers::pi * gap * gap));
    }
    return std::min(1.0, part);
}

void set_light_paths(
    const PreparedScene& prepared,
    const MeasuredArea& measured,
    const std::vector<double>& parts,
    SumMeaning& meaning) {
    const Scene& scene = prepared.scene();
    ContributionBound bound{"light_path", {}};
    for (const double flux : prepared.lights().flux()) {
        bound.largest.push_back(flux / static_cast<double>(measured.organs.size()));
    }
    for (std::size_t i = 0; const double coarser : coarseness_of(scene, measured)) {
        meaning.units.region_scale[i++] *= coarser;
    }
    // Light through narrow lobes may reach all organs.
    if (!has_followed_lobes(prepared)) {
        bound.scale = parts;
        for (double& part : bound.scale) {
            part = part < kFewOfPaths ? part : 1;
        }
    }
    meaning.bounds.push_back(std::move(bound));
}

}  // namespace

MeasuredArea measured_area(const Scene& scene) {
    MeasuredArea measured;
    for (std::uint32_t i = 0; i < scene.organs().size(); ++i) {
        if (scene.organs()[i].measured) {
            measured.organs.push_back(i);
            measured.area += scene.organs()[i].area;
        }
    }
    return measured;
}

double units_of_light_path(const MeasuredArea& measured, double own_area) {
    return own_area > 0 ? kFinerQuanta * measured.area /
                              (own_area * static_cast<double>(measured.organs.size()))
                        : 0;
}

std::vector<double> coarseness_of(const Scene& scene, const MeasuredArea& measured) {
    constexpr double kMaxUnits = 1U << 21U;
    static_assert(kMaxUnits * kPointsPerBlock <= kLargestAmount);
    std::vector<double> coarseness;
    for (const Region& region : scene.regions()) {
        const double units = units_of_light_path(measured, scene.organs()[region.organ.value].area);
        coarseness.push_back(std::exp2(std::ceil(std::log2(std::max(1.0, units / kMaxUnits)))));
    }
    return coarseness;
}

std::vector<double> parts_of_unit(
    const PreparedScene& prepared, const MeasuredArea& measured, const LampNearField& near) {
    const bool needs_coarser = needs_light_paths(prepared, near);
    std::vector<double> parts = coarseness_of(prepared.scene(), measured);
    for (double& part : parts) {
        part = needs_coarser ? 1 / part : 1;
    }
    return parts;
}

std::vector<double> parts_by_vertices(
    const PreparedScene& prepared, const MeasuredArea& measured, const LampNearField& near) {
    const Scene& scene = prepared.scene();
    std::vector<double> parts;
    for (const Region& region : scene.regions()) {
        const Organ& organ = scene.organs()[region.organ.value];
        parts.push_back(organ.measured ? part_by_vertices(prepared, measured, near, organ) : 1);
    }
    return parts;
}

std::vector<char> connected_regions(
    const PreparedScene& prepared, const std::vector<double>& parts) {
    const Scene& scene = prepared.scene();
    std::vector<char> connected;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const bool is_measured = scene.organs()[scene.regions()[i].organ.value].measured;
        connected.push_back(!is_measured || parts[i] < kFewOfPaths ? 1 : 0);
    }
    return connected;
}

bool needs_light_paths(const PreparedScene& prepared, const LampNearField& near) {
    return near.any() || has_followed_lobes(prepared);
}

SumMeaning from_organs_meaning(const PreparedScene& prepared, const RunSpec&) {
    const Scene& scene = prepared.scene();
    const MeasuredArea measured = measured_area(scene);
    SumMeaning meaning{.units = {}, .measured = MeasuredOrgans::requested};
    // Unoccluded direct light: the contribution that a sample of an organ could have had.
    declare_sides(
        "unoccluded", columns_of(SumColumn::Of::spectrum, prepared.lights().spectra().size()),
        meaning.blocks);
    SumUnits& units = meaning.units;
    ContributionBound direct{"direct", {}}, scattered{"scattered", {}}, sunlit{"sunlit", {0}};
    const LampNearField near(prepared);
    const std::vector<double> albedo = largest_albedos(scene);
    const double narrow_from = has_small_light(prepared) ? followed_peak(scene) : kNarrowPeak;
    const std::vector<double> parts =
        near.any() ? parts_by_vertices(prepared, measured, near) : std::vector<double>{};
    const bool has_connected =
        std::any_of(parts.begin(), parts.end(), [](double part) { return part < kFewOfPaths; });
    for (std::size_t b = 0; b < prepared.bands(); ++b) {
        units.flux.push_back(prepared.lights().flux()[b] / measured.area);
        double irradiance = 0, on_surfaces = 0, by_vertex = 0;
        for (const BoundSource& light : prepared.lights()) {
            const double usual = light.usual_irradiance;
            const double own = light.source->spectrum()[b];
            irradiance += own * usual;
            on_surfaces += own * std::max(usual, near.irradiance(light));
            by_vertex += has_connected && light.source->is_lamp()
                             ? own * albedo[b] * albedo[b] * irradiance_by_vertex(near, light)
                             : 0;
        }
        direct.largest.push_back(irradiance * kFinerQuanta);
        scattered.largest.push_back(
            kFinerQuanta * (2 * brightest(prepared, b, narrow_from) * on_surfaces + by_vertex));
    }
    units.sunlit_area = prepared.lights().sun_area() > 0 ? 1 : 0;
    for (const BoundSource& light : prepared.lights()) {
        sunlit.largest[0] =
            std::max(sunlit.largest[0], kFinerQuanta * light.sun_share / light.probability);
    }
    // A power of two: the division is exact.
    for (const Region& region : scene.regions()) {
        units.region_scale.push_back(scene.organs()[region.organ.value].area / kFinerQuanta);
    }
    for (ContributionBound* bound : {&direct, &scattered, &sunlit}) {
        bound->scale = units.region_scale;
        meaning.bounds.push_back(std::move(*bound));
    }
    if (needs_light_paths(prepared, near)) {
        set_light_paths(prepared, measured, parts, meaning);
    }
    return meaning;
}

}  // namespace quasimc
