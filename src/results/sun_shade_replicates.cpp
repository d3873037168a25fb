// Sums of the light of sunlit and shaded parts: docs/theory/sunlit-and-shaded.md.

#include "results/sun_shade_replicates.h"

#include <algorithm>
#include <array>
#include <cstdint>

#include "base/parallel.h"
#include "results/sun_shade_samples.h"
#include "sums/statistics.h"

namespace quasimc {
namespace {

using Part = SunShadePart;

/// Light of a surface in a band, as flux: straight from sources; on sunlit area; on shaded area.
constexpr std::size_t kDirect = 0, kOnLit = 1, kOnShade = 2, kAmounts = 3;
constexpr std::size_t kSurfaceCount = kSunShadeSurfaces.size();

/// The samples of a row on a surface in a band.
SunShadeSamples samples_of_row(
    const ComputedSums& from,
    const SumReader& reader,
    const SunShadeRows& rows,
    std::size_t row,
    std::size_t surface,
    std::size_t band) {
    const SunShadeSurface of = kSunShadeSurfaces[surface];
    SunShadeSamples sum(from.sums->replicates.size());
    for (const std::uint32_t index : rows.organs[row].organs) {
        const Organ& organ = from.scene.organs()[index];
        const OrganReader own(reader, from.scene, from.spec, organ);
        add_to(
            sum, rows.are_groups ? samples_for_group(own, of, band, organ.area)
                                 : samples_of_organ(own, of, band, organ.area));
    }
    return sum;
}

/// One contribution to each amount. In the quotients it is that of a single computation
/// (sun_shade.cpp).
/// @param is_flat  whether the sun lights all sunlit area at one angle
std::array<ContributionSize, kAmounts> sizes_of(
    const SunShadeSamples& samples,
    const ContributionSize& direct,
    const ContributionSize& other,
    const ContributionSize& sunlit,
    double area,
    bool is_flat) {
    const double lit = mean_of(samples.lit);
    const double fraction = area > 0 ? lit / area : 0;
    const double beam = lit > 0 && !is_flat ? mean_of(samples.beam) / lit : 0;
    return {direct, both(other * fraction, sunlit * beam), other * std::max(0.0, 1 - fraction)};
}

}  // namespace

SunShadeReplicateSum::SunShadeReplicateSum(
    std::size_t replicates, std::size_t rows, std::size_t bands)
    : rows_(rows),
      bands_(bands),
      light_(replicates, rows * kSurfaceCount * bands * kAmounts),
      lit_(replicates, rows * kSurfaceCount) {}

void SunShadeReplicateSum::add(
    const ComputedSums& from, const SunShadeRows& rows, const Weight& weight) {
    const std::size_t replicates = from.sums->replicates.size();
    const auto unknown = [&](std::size_t amounts) {
        return CombinedReplicates{
            std::vector<double>(replicates * amounts, kUnknownEstimate.mean),
            std::vector<ContributionSize>(amounts)};
    };
    Amounts amounts{
        unknown(rows_ * kSurfaceCount * bands_ * kAmounts), unknown(rows_ * kSurfaceCount)};
    parallel_blocks(rows_, from.spec.threads, [&](std::uint64_t row, unsigned) {
        put_row(from, rows, row, amounts);
    });
    light_.add(amounts.light, weight.light);
    lit_.add(amounts.lit, weight.time);
}

/// Puts the amounts of a row, whose organs are all measured.
void SunShadeReplicateSum::put_row(
    const ComputedSums& from, const SunShadeRows& rows, std::size_t row, Amounts& amounts) const {
    const auto put = [&](std::size_t at, const std::vector<double>& values,
                         const ContributionSize& size, CombinedReplicates& to) {
        for (std::size_t r = 0; r < values.size(); ++r) {
            to.values[r * to.sizes.size() + at] = values[r];
        }
        to.sizes[at] = size;
    };
    const SumReader reader(from.sums);
    std::vector<OrganContributions> light(bands_);
    SunlitContributions sunlit;
    bool is_flat = !rows.are_groups;
    for (const std::uint32_t index : rows.organs[row].organs) {
        const Organ& organ = from.scene.organs()[index];
        if (!is_measured(from.sums, organ)) {
            return;
        }
        const OrganReader own(reader, from.scene, from.spec, organ);
        is_flat = is_flat && own.is_flat();
        const SunlitContributions of_organ = sunlit_contributions(own);
        for (std::size_t s = 0; s < kSurfaceCount; ++s) {
            sunlit[s].include(of_organ[s]);
        }
        for (std::size_t b = 0; b < bands_; ++b) {
            light[b].include(OrganContributions(own, b));
        }
    }
    for (std::size_t s = 0; s < kSurfaceCount; ++s) {
        const LightParts parts = light_of(kSunShadeSurfaces[s]);
        for (std::size_t b = 0; b < bands_; ++b) {
            const SunShadeSamples samples = samples_of_row(from, reader, rows, row, s, b);
            const ContributionSize of_lit = sunlit[s].size(kIncidentLight, samples.lit);
            const std::array sizes = sizes_of(
                samples, light[b].size(without_scattered(parts), samples.direct),
                light[b].size(without_beam(parts), samples.other), of_lit, rows.areas[row],
                is_flat);
            const std::size_t first = ((row * kSurfaceCount + s) * bands_ + b) * kAmounts;
            std::vector<double> on_lit = samples.beam;
            add_to(on_lit, samples.other_on_lit);
            std::vector<double> on_shade = samples.other;
            add_to(on_shade, times(samples.other_on_lit, -1));
            put(first + kDirect, samples.direct, sizes[kDirect], amounts.light);
            put(first + kOnLit, on_lit, sizes[kOnLit], amounts.light);
            put(first + kOnShade, on_shade, sizes[kOnShade], amounts.light);
            put(row * kSurfaceCount + s, samples.lit, of_lit, amounts.lit);
        }
    }
}

void SunShadeReplicateSum::end_point() {
    light_.end_point();
    lit_.end_point();
}

/// The light of a part per area of the part.
/// @param light  index of the flux on the part. @param lit  area x time per replicate
/// @param whole  the same of the row
Estimate SunShadeReplicateSum::quotient(
    std::size_t light, std::vector<double> lit, Part part, double whole) const {
    if (part == Part::shaded) {
        for (double& each : lit) {
            each = whole - each;
        }
    }
    const double area = mean_of(lit);
    const bool exists = part == Part::shaded ? area > (1 - kFullyLit) * whole : area > 0;
    if (!exists) {
        return kUnknownEstimate;
    }
    return estimate_share(light_.values(light), lit, light_.size(light));
}

SunShadeLight SunShadeReplicateSum::estimates(
    std::span<const double> areas, const Units& units) const {
    SunShadeLight all{bands_};
    for (std::size_t row = 0; row < rows_; ++row) {
        const double per_area = areas[row] > 0 ? 1 / areas[row] : 0;
        for (const SunShadeEntry& entry : sun_shade_table()) {
            const std::size_t surface =
                row * kSurfaceCount + static_cast<std::size_t>(entry.surface);
            for (std::size_t b = 0; b < bands_; ++b) {
                const std::size_t first = (surface * bands_ + b) * kAmounts;
                const double whole = areas[row] * units.whole;
                all.values.push_back(
                    entry.part == Part::direct
                        ? light_.estimate(first + kDirect, units.light * per_area)
                    : entry.part == Part::fraction
                        ? not_above(
                              lit_.estimate(surface, units.time * per_area),
                              units.time * units.whole)
                        : quotient(
                              first + (entry.part == Part::sunlit ? kOnLit : kOnShade),
                              lit_.values(surface), entry.part, whole));
            }
        }
    }
    return all;
}

}  // namespace quasimc
