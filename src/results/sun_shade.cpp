// The light of sunlit and shaded parts: docs/theory/sunlit-and-shaded.md.

#include "results/sun_shade.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "results/bounds/organ_contributions.h"
#include "results/sun_shade_samples.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

using Part = SunShadePart;
using Surface = SunShadeSurface;

/// The input of the estimates of a surface in a band.
struct PartInput {
    const SunShadeSamples& samples;
    double area = 0;
    LightParts parts;
    const OrganContributions& light;   ///< contributions to the light of the band
    const OrganContributions& sunlit;  ///< contributions to the sunlit area
    bool is_flat = false;              ///< whether the sun lights all sunlit area at one angle

    [[nodiscard]] double per_area() const { return area > 0 ? 1 / area : 0; }
};

/// (beam + other light on sunlit area) / sunlit area.
Estimate sunlit_light(const PartInput& given) {
    const SunShadeSamples& samples = given.samples;
    std::vector<double> light = samples.beam;
    add_to(light, samples.other_on_lit);
    const double lit = mean_of(samples.lit);
    if (!(lit > 0)) {
        return kUnknownEstimate;
    }
    const Estimate ratio = widened(
        not_negative(estimate_ratio(light, samples.lit)),
        given.light.size(without_beam(given.parts)) * given.per_area());
    // One contribution more may be of another angle.
    const double beam = mean_of(samples.beam) / lit;
    return given.is_flat ? ratio : widened(ratio, given.sunlit.size() * (beam / lit));
}

/// Other light on shaded area / shaded area, of a group.
Estimate shaded_light(const PartInput& given) {
    const SunShadeSamples& samples = given.samples;
    std::vector<double> light = samples.other, shaded = samples.lit;
    for (std::size_t r = 0; r < light.size(); ++r) {
        light[r] -= samples.other_on_lit[r];
        shaded[r] = given.area - samples.lit[r];
    }
    if (!(mean_of(shaded) > (1 - kFullyLit) * given.area)) {
        return kUnknownEstimate;
    }
    return widened(
        not_negative(estimate_ratio(light, shaded)),
        given.light.size(without_beam(given.parts)) * given.per_area());
}

Estimate estimate_of(Part part, const PartInput& given, bool is_group) {
    const SunShadeSamples& samples = given.samples;
    const double per_area = given.per_area();
    switch (part) {
        case Part::direct:
            return given.light.estimate(
                without_scattered(given.parts), per_area, times(samples.direct, per_area));
        case Part::fraction:
            return given.sunlit.estimate_sunlit(given.area, times(samples.lit, per_area));
        case Part::sunlit:
            return sunlit_light(given);
        default:
            return is_group
                       ? shaded_light(given)
                       : given.light.estimate(
                             without_beam(given.parts), per_area, times(samples.other, per_area));
    }
}

/// Puts all estimates of a surface in a band.
void put_parts(
    const PartInput& given,
    Surface surface,
    bool is_group,
    std::size_t band,
    std::span<Estimate> values) {
    const std::size_t bands = values.size() / kSunShadeQuantities;
    for (const SunShadeEntry& entry : sun_shade_table()) {
        if (entry.surface == surface) {
            values[static_cast<std::size_t>(entry.quantity) * bands + band] =
                estimate_of(entry.part, given, is_group);
        }
    }
}

}  // namespace

void SunShadeEvaluator::evaluate(const Organ& organ, std::span<Estimate> values) const {
    const OrganReader reader(reader_, scene_, spec_, organ);
    const SunlitContributions sunlit = sunlit_contributions(reader);
    for (std::size_t band = 0; band < sums_->bands(); ++band) {
        const OrganContributions light(reader, band);
        for (std::size_t i = 0; i < kSunShadeSurfaces.size(); ++i) {
            const SunShadeSamples samples =
                samples_of_organ(reader, kSunShadeSurfaces[i], band, organ.area);
            put_parts(
                {samples, organ.area, light_of(kSunShadeSurfaces[i]), light, sunlit[i],
                 reader.is_flat()},
                kSunShadeSurfaces[i], false, band, values);
        }
    }
}

void SunShadeEvaluator::evaluate(const OrganGroup& group, std::span<Estimate> values) const {
    SunlitContributions sunlit;
    for (const std::uint32_t index : group.organs) {
        const SunlitContributions own =
            sunlit_contributions({reader_, scene_, spec_, scene_.organs()[index]});
        for (std::size_t i = 0; i < sunlit.size(); ++i) {
            sunlit[i].include(own[i]);
        }
    }
    for (std::size_t band = 0; band < sums_->bands(); ++band) {
        OrganContributions light;
        std::vector<SunShadeSamples> all(
            kSunShadeSurfaces.size(), SunShadeSamples(sums_->replicates.size()));
        for (const std::uint32_t index : group.organs) {
            const Organ& organ = scene_.organs()[index];
            const OrganReader reader(reader_, scene_, spec_, organ);
            light.include(OrganContributions(reader, band));
            for (std::size_t i = 0; i < kSunShadeSurfaces.size(); ++i) {
                add_to(all[i], samples_for_group(reader, kSunShadeSurfaces[i], band, organ.area));
            }
        }
        for (std::size_t i = 0; i < kSunShadeSurfaces.size(); ++i) {
            put_parts(
                {all[i], group.area, light_of(kSunShadeSurfaces[i]), light, sunlit[i]},
                kSunShadeSurfaces[i], true, band, values);
        }
    }
}

SunShadeLight evaluate_sun_shade(
    const Sums& sums,
    const Scene& scene,
    const EvaluationSpec& spec,
    const std::vector<OrganGroup>& groups) {
    SunShadeLight light{sums->bands()};
    light.values.resize(groups.size() * light.values_per_row());
    const SunShadeEvaluator evaluator(sums, scene, spec);
    parallel_blocks(groups.size(), spec.threads, [&](std::uint64_t g, unsigned) {
        const std::size_t size = light.values_per_row();
        evaluator.evaluate(groups[g], std::span(light.values).subspan(g * size, size));
    });
    return light;
}

SunShadeLight zero_sun_shade(std::size_t rows, std::size_t bands) {
    SunShadeLight light{bands};
    light.values.resize(rows * light.values_per_row());
    for (std::size_t i = 0; i < light.values.size(); ++i) {
        const SunShadeEntry& entry = sun_shade_table()[i / bands % kSunShadeQuantities];
        light.values[i] = entry.part == Part::sunlit ? kUnknownEstimate : Estimate{};
    }
    return light;
}

}  // namespace quasimc
