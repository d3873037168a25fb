#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "quasimc/sun_shade.h"
#include "results/bounds/organ_contributions.h"
#include "results/bounds/organ_reader.h"

namespace quasimc {

inline constexpr std::array kSunShadeSurfaces{
    SunShadeSurface::upper, SunShadeSurface::lower, SunShadeSurface::absorbed_by_both};

/// The light of a surface of organs in a band, and its sunlit area: per replicate.
struct SunShadeSamples {
    explicit SunShadeSamples(std::size_t replicates)
        : direct(replicates),
          beam(replicates),
          other(replicates),
          lit(replicates),
          other_on_lit(replicates) {}

    std::vector<double> direct;  ///< flux straight from sources
    std::vector<double> beam;    ///< flux straight from suns
    std::vector<double> other;   ///< all other flux
    std::vector<double> lit;     ///< sunlit area
    /// The other flux on sunlit area, if it is evenly distributed over each organ.
    std::vector<double> other_on_lit;
};

/// The samples of an organ.
[[nodiscard]] SunShadeSamples samples_of_organ(
    const OrganReader& reader, SunShadeSurface surface, std::size_t band, double area);
/// The samples of an organ, for those of a group. Without a bias of the products: groups may have
/// many organs.
[[nodiscard]] SunShadeSamples samples_for_group(
    const OrganReader& reader, SunShadeSurface surface, std::size_t band, double area);
/// Adds those of an organ to those of its group.
void add_to(SunShadeSamples& group, const SunShadeSamples& organ);

/// The light of a surface.
[[nodiscard]] LightParts light_of(SunShadeSurface surface);
[[nodiscard]] LightParts without_beam(LightParts parts);
[[nodiscard]] LightParts without_scattered(LightParts parts);

/// Contributions to the sunlit areas of all surfaces.
using SunlitContributions = std::array<OrganContributions, kSunShadeSurfaces.size()>;
[[nodiscard]] SunlitContributions sunlit_contributions(const OrganReader& reader);

/// Adds replicates to those of the same number.
void add_to(std::vector<double>& sum, const std::vector<double>& values);
[[nodiscard]] std::vector<double> times(std::vector<double> values, double factor);

}  // namespace quasimc
