#include "planner/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "detectors/catalogue.h"
#include "planner/near_lamp.h"
#include "solvers/ray_bundles/suits_bundles.h"
#include "transport/organ_shares.h"

namespace quasimc {
namespace {

/// Instances of meshes may have more triangles than memory could hold; projections store data of
/// each.
constexpr std::size_t kMaxForRasters = 100'000'000;
/// The gain of equal shares from which on paths from organs are most likely the most efficient.
constexpr double kLargeGain = 14;
/// Fewer organs are not first tried by ray bundles: each has many paths. Of a few more, images of
/// far light may be worse than paths from the sources.
constexpr std::size_t kVeryFewOrgans = 16, kFewOrgans = 100;

/// The kinds of sources with light.
struct Lighting {
    bool lamp = false, near_lamp = false, sun = false, sky = false;
    [[nodiscard]] bool is_far() const { return sun || sky; }
};

Lighting lighting_of(const Scene& scene, const Sources& sources) {
    Lighting lighting;
    for (const auto& source : sources) {
        const auto spectrum = source->spectrum();
        if (std::any_of(spectrum.begin(), spectrum.end(), [](double x) { return x > 0; })) {
            (source->is_lamp()  ? lighting.lamp
             : source->is_sun() ? lighting.sun
                                : lighting.sky) = true;
            lighting.near_lamp = lighting.near_lamp || is_near_lamp(*source, scene.bounds());
        }
    }
    return lighting;
}

/// The mean projected area of the scene over that of its organs (Cauchy: a quarter of the surface
/// of its box, half the area of leaves; for an infinite stand its cell). Most light in an empty
/// scene meets nothing.
double emptiness(const Scene& scene) {
    double organs = 0;
    for (const Organ& organ : scene.organs()) {
        organs += 0.5 * organ.area;
    }
    return organs > 0 ? std::max(1.0, seen_area(scene) / organs) : 1;
}

}  // namespace

double gain_of_equal_shares(const Scene& scene) {
    double all = 0;
    double measured = 0;
    for (const Organ& organ : scene.organs()) {
        all += organ.area;
        measured += organ.measured && organ.area > 0 ? 1 : 0;
    }
    return measured > 0 ? all / (measured * median_measured_area(scene))
                        : std::numeric_limits<double>::infinity();
}

bool hides_light(const Scene& scene, const Sources& sources) {
    const Lighting lighting = lighting_of(scene, sources);
    const double narrow_from = followed_peak(scene);
    const std::vector<bool> is_used = used_materials(scene);
    const auto is_narrow = [&](const Lobe& lobe) {
        return peak_brightness(*lobe.shape) >= narrow_from;
    };
    bool any = false;
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = data_of(scene).materials[m];
        for (const SurfaceSide side : kSurfaceSides) {
            any = any || (is_used[m] && !material.is_transparent() &&
                          std::ranges::any_of(material.side(side).lobes(), is_narrow));
        }
    }
    return any && (lighting.sun || lighting.lamp);
}

std::vector<Method> candidate_methods(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<bool()>& refuse_bundles) {
    const Lighting lighting = lighting_of(scene, sources);
    const bool has_images = lighting.is_far() && scene.triangle_count() <= kMaxForRasters;
    std::vector<Method> methods;
    if (has_images && !lighting.near_lamp && suits_bundles(scene, sources, spec) &&
        !refuse_bundles()) {
        methods.push_back(Method::ray_bundles);
    }
    const std::size_t organs = scene.organs().size();
    if (has_images) {
        methods.insert(
            organs < kVeryFewOrgans ? methods.begin() : methods.end(), Method::first_hits);
    }
    if (lighting.lamp || !has_images) {
        methods.push_back(Method::light_tracing);
    } else if (methods.front() == Method::ray_bundles && organs < kFewOrgans) {
        // Pilot runs of few paths may have no images, and find the two alike.
        methods.insert(std::ranges::find(methods, Method::first_hits), Method::light_tracing);
    }
    // Lamps repeat with the scene; paths from organs would have to pick one of infinitely many.
    // They do not sample light that escapes.
    const double gain = (lighting.is_far() ? emptiness(scene) : 1) * gain_of_equal_shares(scene);
    if (std::isfinite(gain) && !(lighting.lamp && scene.cell().periodic()) &&
        !need_escaped_light(scene.detectors())) {
        methods.insert(gain >= kLargeGain ? methods.begin() : methods.end(), Method::from_organs);
    }
    return methods;
}

}  // namespace quasimc
