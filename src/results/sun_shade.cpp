// The light of sunlit and shaded parts: docs/theory/sunlit-and-shaded.md.

#include "results/sun_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <utility>

#include "base/parallel.h"
#include "results/bounds/organ_contributions.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

using Part = SunShadePart;
using Surface = SunShadeSurface;

constexpr std::array kSurfaces{Surface::upper, Surface::lower, Surface::absorbed_by_both};

/// The light of a surface.
LightParts light_of(Surface surface) {
    LightParts parts;
    parts.upper = surface != Surface::lower;
    parts.lower = surface != Surface::upper;
    parts.is_absorbed = surface == Surface::absorbed_by_both;
    return parts;
}

LightParts without_beam(LightParts parts) {
    parts.suns = false;
    return parts;
}

LightParts without_scattered(LightParts parts) {
    parts.scattered = false;
    return parts;
}

/// The side of a surface; none: both.
std::optional<SurfaceSide> side_of(Surface surface) {
    return surface == Surface::absorbed_by_both ? std::nullopt
           : surface == Surface::upper          ? std::optional(SurfaceSide::upper)
                                                : std::optional(SurfaceSide::lower);
}

double beam_on(const Beam& beam, Surface surface) {
    switch (surface) {
        case Surface::upper:
            return beam.upper;
        case Surface::lower:
            return beam.lower;
        default:
            return beam.absorbed;
    }
}

/// Reads an organ, without SunShadeSamples::other_on_lit.
SunShadeSamples read_parts(const OrganReader& reader, Surface surface, std::size_t band) {
    SunShadeSamples samples(reader.replicates());
    const LightParts parts = light_of(surface);
    for (std::uint32_t r = 0; r < reader.replicates(); ++r) {
        const Incident in = reader.incident(r, band);
        samples.direct[r] = in.of(without_scattered(parts));
        samples.beam[r] = beam_on(reader.beam(r, band), surface);
        samples.other[r] = std::max(0.0, in.of(parts) - samples.beam[r]);  // but for rounding
        samples.lit[r] = reader.sunlit_area(r, side_of(surface));
    }
    return samples;
}

/// The product of the means of two lists, per replicate: its mean, and to first order its error,
/// are those of the product.
std::vector<double> product_of_means(std::span<const double> a, std::span<const double> b) {
    const double mean_a = mean_of(a), mean_b = mean_of(b);
    std::vector<double> product;
    for (std::size_t r = 0; r < a.size(); ++r) {
        product.push_back(a[r] * mean_b + mean_a * b[r] - mean_a * mean_b);
    }
    return product;
}

/// The same without bias, as the mean over pairs of different replicates: a U-statistic (Hoeffding
/// 1948), which differs by the covariance of the two means. A single replicate has no pair.
std::vector<double> product_across_replicates(
    std::span<const double> a, std::span<const double> b) {
    const auto count = static_cast<double>(a.size());
    const double mean_a = mean_of(a), mean_b = mean_of(b);
    double together = 0;
    for (std::size_t r = 0; r < a.size(); ++r) {
        together += (a[r] - mean_a) * (b[r] - mean_b);
    }
    std::vector<double> product = product_of_means(a, b);
    for (double& each : product) {
        each -= a.size() > 1 ? together / (count * (count - 1)) : 0;
    }
    return product;
}

std::vector<double> times(std::vector<double> values, double factor) {
    for (double& each : values) {
        each *= factor;
    }
    return values;
}

void add(std::vector<double>& to, const std::vector<double>& from) {
    std::transform(to.begin(), to.end(), from.begin(), to.begin(), std::plus());
}

/// Adds the light of an organ to that of its group.
void add_parts(const SunShadeSamples& own, double area, SunShadeSamples& sum) {
    add(sum.direct, own.direct);
    add(sum.beam, own.beam);
    add(sum.other, own.other);
    add(sum.lit, own.lit);
    const double per_area = area > 0 ? 1 / area : 0;
    add(sum.other_on_lit, product_across_replicates(own.lit, times(own.other, per_area)));
}

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
    add(light, samples.other_on_lit);
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

/// Contributions to the sunlit areas of all surfaces.
using SunlitContributions = std::array<OrganContributions, kSurfaces.size()>;

SunlitContributions sunlit_contributions(const OrganReader& reader) {
    SunlitContributions all;
    std::transform(kSurfaces.begin(), kSurfaces.end(), all.begin(), [&](Surface surface) {
        return OrganContributions::sunlit(reader, side_of(surface));
    });
    return all;
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
    const double per_area = organ.area > 0 ? 1 / organ.area : 0;
    const SunlitContributions sunlit = sunlit_contributions(reader);
    for (std::size_t band = 0; band < sums_->bands(); ++band) {
        const OrganContributions light(reader, band);
        for (std::size_t i = 0; i < kSurfaces.size(); ++i) {
            SunShadeSamples samples = read_parts(reader, kSurfaces[i], band);
            samples.other_on_lit = product_of_means(samples.lit, times(samples.other, per_area));
            put_parts(
                {samples, organ.area, light_of(kSurfaces[i]), light, sunlit[i], reader.is_flat()},
                kSurfaces[i], false, band, values);
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
            kSurfaces.size(), SunShadeSamples(sums_->replicates.size()));
        for (const std::uint32_t index : group.organs) {
            const Organ& organ = scene_.organs()[index];
            const OrganReader reader(reader_, scene_, spec_, organ);
            light.include(OrganContributions(reader, band));
            for (std::size_t i = 0; i < kSurfaces.size(); ++i) {
                add_parts(read_parts(reader, kSurfaces[i], band), organ.area, all[i]);
            }
        }
        for (std::size_t i = 0; i < kSurfaces.size(); ++i) {
            put_parts(
                {all[i], group.area, light_of(kSurfaces[i]), light, sunlit[i]}, kSurfaces[i], true,
                band, values);
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
