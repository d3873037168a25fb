// Reads the light of sunlit and shaded parts: docs/theory/sunlit-and-shaded.md.

#include "results/sun_shade_samples.h"

#include <algorithm>
#include <functional>

#include "sums/statistics.h"

namespace quasimc {
namespace {

using Surface = SunShadeSurface;

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

double per_area_of(double area) {
    return area > 0 ? 1 / area : 0;
}

}  // namespace

SunShadeSamples samples_of_organ(
    const OrganReader& reader, Surface surface, std::size_t band, double area) {
    SunShadeSamples samples = read_parts(reader, surface, band);
    samples.other_on_lit = product_of_means(samples.lit, times(samples.other, per_area_of(area)));
    return samples;
}

SunShadeSamples samples_for_group(
    const OrganReader& reader, Surface surface, std::size_t band, double area) {
    SunShadeSamples samples = read_parts(reader, surface, band);
    samples.other_on_lit =
        product_across_replicates(samples.lit, times(samples.other, per_area_of(area)));
    return samples;
}

void add_to(SunShadeSamples& group, const SunShadeSamples& organ) {
    add_to(group.direct, organ.direct);
    add_to(group.beam, organ.beam);
    add_to(group.other, organ.other);
    add_to(group.lit, organ.lit);
    add_to(group.other_on_lit, organ.other_on_lit);
}

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

SunlitContributions sunlit_contributions(const OrganReader& reader) {
    SunlitContributions all;
    std::ranges::transform(kSunShadeSurfaces, all.begin(), [&](Surface surface) {
        return OrganContributions::sunlit(reader, side_of(surface));
    });
    return all;
}

void add_to(std::vector<double>& sum, const std::vector<double>& values) {
    std::transform(sum.begin(), sum.end(), values.begin(), sum.begin(), std::plus());
}

std::vector<double> times(std::vector<double> values, double factor) {
    for (double& each : values) {
        each *= factor;
    }
    return values;
}

}  // namespace quasimc
