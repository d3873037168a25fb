// The most efficient method: rules of thumb, each from a measurement
// (docs/develop/notebook/choosing.md; `./dev bench choice` repeats them).

#include "planner/planner.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "detectors/catalogue.h"
#include "planner/near_lamp.h"
#include "solvers/ray_bundles/suits_bundles.h"
#include "sums/statistics.h"
#include "transport/organ_shares.h"

namespace quasimc {
namespace {

/// The gain of equal shares from which on paths from organs are more efficient than paths of light.
struct Thresholds {
    double dark, bright;  ///< for leaves that absorb most light, or scatter most
};
// First hits have direct light almost without noise: the more of the light is direct, the larger
// the gain must be.
constexpr Thresholds kSun{8, 5};
constexpr Thresholds kSky{7, 4};
constexpr Thresholds kLamps{2, 5};
/// If bundles would be chosen, with many paths for each organ.
constexpr Thresholds kBundles{14, 7};
constexpr double kPathsForBundles = 8;
/// Lamps outside the scene's box, if organs have at least kPathsToSpare paths each: hardly any
/// surface is near enough to a lamp to be much brighter than others.
constexpr double kDarkBelowFarLamps = 0.5;
constexpr double kPathsToSpare = 16;
/// The mean albedo from which on leaves count as bright.
constexpr double kBright = 0.5;
/// The fraction of all scattered light in narrow lobes from which on paths from organs are not used
/// for dark leaves under a sun: the noise is in the light of these lobes, which is sampled by paths
/// from the sun.
constexpr double kMuchNarrowLight = 0.3;
/// Minimum number of paths from the source that hit a typical organ. With fewer, light through
/// narrow lobes dominates the error of every method, and methods with paths from sources only are
/// faster.
constexpr double kFewPaths = 5;
/// The largest factor by which glossy surfaces reduce the gain: that of narrow lobes and mirrors,
/// whose light has paths of its own.
constexpr double kMaxLostToGloss = 12;

/// The kinds of sources with light.
struct Lighting {
    bool lamp = false, sun = false, sky = false;
    bool near_lamp =
        false;  ///< a lamp in the scene's box, or near enough to make a part of it much brighter
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

/// Scattering of surfaces, means over organs (by area) and sides; without sensors.
struct Scattering {
    double mean_albedo = 0;     ///< mean over bands
    double brightest_band = 0;  ///< the largest albedo of a band
    double narrow_part = 0;     ///< fraction of the scattered light in narrow lobes
    [[nodiscard]] bool is_bright() const { return mean_albedo >= kBright; }
};

Scattering scattering_of(const Scene& scene) {
    const double narrow_from = followed_peak(scene);
    double area = 0, narrow = 0;
    std::vector<double> scattered(scene.bands().size());
    for (const Region& region : scene.regions()) {
        const Material& material = data_of(scene).material(region);
        for (const SurfaceSide side : kSurfaceSides) {
            if (material.is_transparent()) {
                continue;
            }
            area += region.area;
            for (std::size_t b = 0; b < scattered.size(); ++b) {
                scattered[b] += region.area * material.side(side).albedo()[b];
            }
            for (const Lobe& lobe : material.side(side).lobes()) {
                const bool is_narrow = peak_brightness(*lobe.shape) >= narrow_from;
                narrow += is_narrow ? region.area * mean_of(lobe.albedo) : 0;
            }
        }
    }
    if (!(area > 0) || scattered.empty()) {
        return {};
    }
    const double all = mean_of(scattered);
    return {
        all / area, *std::max_element(scattered.begin(), scattered.end()) / area,
        all > 0 ? narrow / all : 0};
}

double brightest_peak(const Side& side, double narrow_from) {
    double brightest = 0;
    for (const Lobe& lobe : side.lobes()) {
        const double peak = peak_brightness(*lobe.shape);
        brightest = std::max(
            brightest, peak < narrow_from ? peak * mean_of(lobe.albedo)
                                          : std::numeric_limits<double>::infinity());
    }
    return brightest;
}

bool has_paths_to_spare(const Scene& scene, const RunSpec& spec, double for_each) {
    const auto measured = std::count_if(
        scene.organs().begin(), scene.organs().end(),
        [](const Organ& organ) { return organ.measured && organ.area > 0; });
    return static_cast<double>(spec.paths) >= for_each * static_cast<double>(measured);
}

/// Approximate number of paths from far away that hit a typical organ.
double paths_per_organ(const Scene& scene, const RunSpec& spec) {
    return static_cast<double>(spec.paths) * median_measured_area(scene) / seen_area(scene);
}

/// The gain of equal shares from which on paths from organs are more efficient. They hardly sample
/// light of a sun or a lamp through a narrow lobe, which costs the square root of the lobe's peak.
/// @param bundles  whether bundles would be used otherwise
double required_gain(
    const Scene& scene, const Lighting& lighting, const RunSpec& spec, bool bundles) {
    const Scattering scattering = scattering_of(scene);
    const double peak = brightest_peak(scene);
    const bool is_small = lighting.sun || lighting.lamp;
    if (is_small && std::isinf(peak) && paths_per_organ(scene, spec) < kFewPaths) {
        return std::numeric_limits<double>::infinity();
    }
    if (lighting.sun && !scattering.is_bright() && scattering.narrow_part >= kMuchNarrowLight) {
        return std::numeric_limits<double>::infinity();
    }
    const Thresholds& table = bundles && has_paths_to_spare(scene, spec, kPathsForBundles)
                                  ? kBundles
                              : lighting.sun ? kSun
                              : lighting.sky ? kSky
                                             : kLamps;
    const bool has_far_lamps_alone = !lighting.sun && !lighting.sky && !lighting.near_lamp;
    double gain = scattering.is_bright() ? table.bright : table.dark;
    if (has_far_lamps_alone && has_paths_to_spare(scene, spec, kPathsToSpare) &&
        scattering.brightest_band < kBright) {
        gain = kDarkBelowFarLamps;
    }
    return is_small ? gain * std::clamp(std::sqrt(peak), 1.0, kMaxLostToGloss) : gain;
}

/// Approximate number of scan lines across the scene that meet a typical organ.
double lines_per_organ(const Scene& scene, std::uint64_t paths) {
    constexpr double kPathsPerLine = 80, kMinLines = 128;
    const double lines = std::max(kMinLines, static_cast<double>(paths) / kPathsPerLine);
    return lines * std::sqrt(median_measured_area(scene)) / length(scene.bounds().size());
}

/// The mean projected area of the scene over that of its organs (Cauchy: a quarter of the surface
/// of its box, half the area of leaves; for an infinite stand its cell), if organs are so small
/// that lines miss them; else 1. Most light in such a scene meets nothing.
double emptiness(const Scene& scene, std::uint64_t paths) {
    constexpr double kFewLines = 2;
    double organs = 0;
    for (const Organ& organ : scene.organs()) {
        organs += 0.5 * organ.area;
    }
    const Cell& cell = scene.cell();
    if (!(organs > 0) || cell.along_x != cell.along_y ||
        lines_per_organ(scene, paths) >= kFewLines) {
        return 1;
    }
    return std::max(1.0, seen_area(scene) / organs);
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

double brightest_peak(const Scene& scene) {
    double brightest = 0;
    const double narrow_from = followed_peak(scene);
    const std::vector<bool> is_used = used_materials(scene);
    for (std::size_t m = 0; m < is_used.size(); ++m) {
        const Material& material = data_of(scene).materials[m];
        if (is_used[m] && !material.is_transparent()) {
            brightest = std::max(
                {brightest, brightest_peak(material.side(SurfaceSide::upper), narrow_from),
                 brightest_peak(material.side(SurfaceSide::lower), narrow_from)});
        }
    }
    return brightest;
}

/// Instances of meshes may have more triangles than memory could hold; projections store data of
/// each.
constexpr std::size_t kMaxForRasters = 100'000'000;

ChosenMethod plan_method(const Scene& scene, const Sources& sources, const RunSpec& spec) {
    return plan_method(scene, sources, spec, [] { return false; });
}

ChosenMethod plan_method(
    const Scene& scene,
    const Sources& sources,
    const RunSpec& spec,
    const std::function<bool()>& refuse_bundles) {
    if (spec.method != Method::automatic) {
        return {spec.method, "requested"};
    }
    const Lighting lighting = lighting_of(scene, sources);
    const bool is_far = lighting.sun || lighting.sky;
    const double gain = (is_far ? emptiness(scene, spec.paths) : 1) * gain_of_equal_shares(scene);
    // Lamps repeat with the scene; paths from organs would have to pick one of infinitely many.
    // They do not sample light that escapes.
    const bool can_start_from_organs = std::isfinite(gain) &&
                                       !(lighting.lamp && scene.cell().periodic()) &&
                                       !need_escaped_light(scene.detectors());
    const bool takes_bundles = is_far && !lighting.lamp && gain < kBundles.dark &&
                               suits_bundles(scene, spec, gain, lighting.sun) && !refuse_bundles();
    if (can_start_from_organs && gain >= required_gain(scene, lighting, spec, takes_bundles)) {
        if (gain < kLamps.dark) {
            return {
                Method::from_organs,
                "every organ can have many paths, and the lamps are far from all organs"};
        }
        return {
            Method::from_organs,
            fmt::format(
                "few measured organs: starting paths on them is {:.2g} times as efficient", gain)};
    }
    if (!lighting.sun && !lighting.sky) {
        return {Method::light_tracing, "all light comes from lamps"};
    }
    if (scene.triangle_count() > kMaxForRasters) {
        return {
            Method::light_tracing,
            fmt::format("projecting {} triangles would take too long", scene.triangle_count())};
    }
    if (takes_bundles) {
        return {Method::ray_bundles, "all surfaces are Lambertian"};
    }
    return {
        Method::first_hits, fmt::format(
                                "direct light by projection{}",
                                lighting.lamp ? "; paths from lamps start at the lamps" : "")};
}

}  // namespace quasimc
