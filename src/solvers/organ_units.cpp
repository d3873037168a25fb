#include "solvers/organ_units.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "solvers/from_organs.h"

namespace quasimc {
namespace {

/// The most that a material of the scene sends to one of its sides, of light that falls on it:
/// twice that is the irradiance that a point finds on a matt surface (pi for the cosine law over
/// pi, 2 for the choice of a side). A find through a lobe of Phong's is on average half as bright
/// as its peak; sharp ones are not looked through.
double brightest(const PreparedScene& prepared, std::size_t band) {
    constexpr double kUsual = 0.5;
    // By a sharp lobe points find a sky and nothing else.
    const auto& lights = prepared.lights();
    const bool has_sky = std::any_of(
        lights.begin(), lights.end(), [](const BoundSource& light) { return light.is_extended(); });
    const double by_sharp = has_sky ? 1 : 0;
    double most = 0;
    for (std::uint32_t region = 0; region < prepared.scene().regions().size(); ++region) {
        const Material& material = prepared.material(region);
        for (const SurfaceSide side : kSurfaceSides) {
            std::array<double, 2> sum{};
            for (const Lobe& lobe : material.side(side).lobes()) {
                const double peak = is_sharp(*lobe.shape)
                                        ? by_sharp
                                        : std::max(1.0, kUsual * peak_brightness(*lobe.shape));
                sum[lobe.shape->hemisphere() == Hemisphere::reflected ? 0 : 1] +=
                    peak * lobe.albedo[band];
            }
            most = material.is_transparent() ? most : std::max({most, sum[0], sum[1]});
        }
    }
    return most;
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
    return own_area > 0 ? kOrganGain * measured.area /
                              (own_area * static_cast<double>(measured.organs.size()))
                        : 0;
}

std::vector<double> coarseness_of(const Scene& scene, const MeasuredArea& measured) {
    constexpr double kMostUnits = 1U << 21U;
    static_assert(kMostUnits * kOrganPointsPerBlock <= kLargestAmount);
    std::vector<double> coarseness;
    for (const Region& region : scene.regions()) {
        const double units = units_of_light_path(measured, scene.organs()[region.organ.value].area);
        coarseness.push_back(std::exp2(std::ceil(std::log2(std::max(1.0, units / kMostUnits)))));
    }
    return coarseness;
}

bool needs_light_paths(const PreparedScene& prepared, const NearLamps& near) {
    const auto& lights = prepared.lights();
    const bool is_small = std::any_of(lights.begin(), lights.end(), [](const BoundSource& light) {
        return !light.is_extended();
    });
    return near.any() || (is_small && prepared.has_sharp());
}

SumMeaning from_organs_meaning(const PreparedScene& prepared, const RunSpec&) {
    const Scene& scene = prepared.scene();
    const MeasuredArea measured = measured_area(scene);
    SumMeaning meaning{
        .units = {},
        .measured = MeasuredOrgans::asked_for,
        .unoccluded_light = UnoccludedLight::summed};
    SumUnits& units = meaning.units;
    const NearLamps near(prepared);
    for (std::size_t b = 0; b < prepared.bands(); ++b) {
        units.flux.push_back(prepared.flux()[b] / measured.area);
        double irradiance = 0;
        double on_surfaces = 0;
        for (const BoundSource& light : prepared.lights()) {
            const double usual = light.usual_irradiance;
            irradiance += light.source->spectrum()[b] * usual;
            on_surfaces += light.source->spectrum()[b] * std::max(usual, near.irradiance(light));
        }
        units.flux_per_find.push_back(irradiance * kOrganGain);
        units.scattered_flux_per_find.push_back(
            2 * brightest(prepared, b) * on_surfaces * kOrganGain);
    }
    if (needs_light_paths(prepared, near)) {
        for (const double flux : prepared.flux()) {
            units.flux_per_light_path.push_back(flux / static_cast<double>(measured.organs.size()));
        }
    }
    units.sunlit_area = prepared.sun_area() > 0 ? 1 : 0;
    units.sunlit_area_per_find = 0;
    for (const BoundSource& light : prepared.lights()) {
        units.sunlit_area_per_find =
            std::max(units.sunlit_area_per_find, kOrganGain * light.sun_share / light.probability);
    }
    // A power of two: the division is exact.
    for (const Region& region : scene.regions()) {
        units.region_scale.push_back(scene.organs()[region.organ.value].area / kOrganGain);
    }
    if (needs_light_paths(prepared, near)) {
        units.find_scale = units.region_scale;
        for (std::size_t i = 0; const double coarser : coarseness_of(scene, measured)) {
            units.region_scale[i++] *= coarser;
        }
    }
    return meaning;
}

bool do_from_organs_rounds_add_up(const Scene& scene, std::uint64_t first_paths) {
    return first_paths >= measured_area(scene).organs.size();
}

}  // namespace quasimc
