#pragma once

// What the sums of a run say of an organ, replicate by replicate.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// Light that one replicate saw fall on one organ, flux per band and side.
struct Incident {
    double direct_upper = 0, direct_lower = 0, scattered_upper = 0, scattered_lower = 0;
    double absorbed = 0;
    double unoccluded_upper = 0, unoccluded_lower = 0;  ///< 0 where it is not summed

    Incident& operator+=(const Incident& part) {
        direct_upper += part.direct_upper;
        direct_lower += part.direct_lower;
        scattered_upper += part.scattered_upper;
        scattered_lower += part.scattered_lower;
        absorbed += part.absorbed;
        unoccluded_upper += part.unoccluded_upper;
        unoccluded_lower += part.unoccluded_lower;
        return *this;
    }
};

/// The quantities that follow from light.
/// @param per_area  1 / area of what it fell on; 0 for no area, which receives nothing
inline std::array<double, kQuantities> quantities_of(const Incident& in, double per_area) {
    std::array<double, kQuantities> all{};
    const auto put = [&](Quantity q, double value) { all[static_cast<std::size_t>(q)] = value; };
    put(Quantity::absorbed_flux, in.absorbed);
    put(Quantity::absorbed_flux_density, in.absorbed * per_area);
    put(Quantity::incident_upper, (in.direct_upper + in.scattered_upper) * per_area);
    put(Quantity::incident_lower, (in.direct_lower + in.scattered_lower) * per_area);
    put(Quantity::incident_direct, (in.direct_upper + in.direct_lower) * per_area);
    put(Quantity::incident_scattered, (in.scattered_upper + in.scattered_lower) * per_area);
    return all;
}

/// What each replicate says of each quantity.
using QuantitySamples = std::array<std::vector<double>, kQuantities>;

/// Puts the quantities that follow from the light which a replicate saw.
inline void put_sample(
    std::uint32_t replicate, const Incident& in, double per_area, QuantitySamples& samples) {
    const std::array<double, kQuantities> all = quantities_of(in, per_area);
    for (std::size_t q = 0; q < kQuantities; ++q) {
        samples[q][replicate] = all[q];
    }
}

/// What a fraction of 1 comes out as, or more.
inline constexpr double kFullyLit = 1 - 1e-12;

/// What sums mean, band by band: the units of Sums after all its samples.
class Units {
  public:
    explicit Units(const Sums& sums) : sums_(sums), samples_(static_cast<double>(sums.samples)) {}

    /// Flux in `band` of a unit of scattered light, or of direct light of a spectrum of 1.
    [[nodiscard]] double flux(std::size_t region, std::size_t band) const {
        return sums_.units.flux[band] * sums_.units.scale(region) / samples_;
    }
    [[nodiscard]] double flux_per_find(std::size_t region, std::size_t band) const {
        return sums_.units.flux_per_find[band] * sums_.units.scale_of_find(region) / samples_;
    }
    [[nodiscard]] double scattered_flux_per_find(std::size_t region, std::size_t band) const {
        const auto& own = sums_.units.scattered_flux_per_find;
        return (own.empty() ? sums_.units.flux_per_find : own)[band] *
               sums_.units.scale_of_find(region) / samples_;
    }
    [[nodiscard]] double sunlit_area(std::size_t region) const {
        return sums_.units.sunlit_area * sums_.units.scale(region) / samples_;
    }
    [[nodiscard]] double sunlit_area_per_find(std::size_t region) const {
        return sums_.units.sunlit_area_per_find * sums_.units.scale_of_find(region) / samples_;
    }

  private:
    const Sums& sums_;
    double samples_;
};

/// Whether the light of an organ was summed.
inline bool is_measured(const Sums& sums, const Organ& organ) {
    return sums.measured == MeasuredOrgans::all || organ.measured;
}

/// Reads an organ's sums.
class OrganReader {
  public:
    OrganReader(
        const Sums& sums, const Scene& scene, const EvaluationSpec& spec, const Organ& organ)
        : sums_(sums), units_(sums), scene_(scene), spec_(spec), organ_(organ) {}

    [[nodiscard]] Incident incident(std::uint32_t replicate, std::size_t band) const {
        Incident sum;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            sum += region_incident(replicate, region, band);
        }
        return sum;
    }

    [[nodiscard]] double sunlit_area(std::uint32_t replicate) const {
        const ExactBins& bins = sums_.replicates[replicate];
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            sum += bins.value(sums_.layout.sunlit(region)) * units_.sunlit_area(region);
        }
        return sum;
    }

    /// The largest share of light that a side of the organ absorbs.
    [[nodiscard]] double largest_absorptance(std::size_t band) const {
        return largest([&](const Side& side) { return side.absorptance()[band]; });
    }
    /// The largest share of light that a side of the organ scatters.
    [[nodiscard]] double largest_albedo(std::size_t band) const {
        return largest([&](const Side& side) { return side.albedo()[band]; });
    }

    /// A side that sees itself, and the part of what leaves it that falls on it again, were it
    /// even: 1 less the opening's area over that of the side (a view factor).
    struct Hollow {
        SurfaceSide side{};
        double part = 0;  ///< 0 of flat organs
    };
    [[nodiscard]] Hollow hollow() const {
        Vec3 middle, opening;
        double twice_area = 0;
        for_each_triangle([&](const Triangle& t) {
            const Vec3 across = area_vector(t);
            middle += length(across) * (t[0] + t[1] + t[2]);
            opening += across;
            twice_area += length(across);
        });
        middle = 1 / twice_area * middle;
        double outwards = 0;  // of the upper side
        for_each_triangle([&](const Triangle& t) {
            outwards += dot(t[0] + t[1] + t[2] - middle, area_vector(t));
        });
        return {
            outwards > 0 ? SurfaceSide::lower : SurfaceSide::upper,
            twice_area > 0 ? std::max(0.0, 1 - length(opening) / twice_area) : 0};
    }

    /// SumUnits::flux_per_find of the organ; nothing falls on one of no area.
    [[nodiscard]] double flux_per_find(std::size_t band) const {
        return organ_.area > 0 ? units_.flux_per_find(organ_.first_region, band) : 0;
    }
    /// The same of scattered light.
    [[nodiscard]] double scattered_flux_per_find(std::size_t band) const {
        return organ_.area > 0 ? units_.scattered_flux_per_find(organ_.first_region, band) : 0;
    }
    /// The part of the light from an even surrounding that lies within the field of view.
    [[nodiscard]] double part_in_view() const {
        return 1 - organ_.least_cosine * organ_.least_cosine;
    }
    /// flux_per_find() of a light path; 0 if there are none.
    [[nodiscard]] double flux_per_light_path(std::size_t band) const {
        const auto& flux = sums_.units.flux_per_light_path;
        const auto& parts = sums_.units.light_path_part;
        const double part = parts.empty() ? 1 : parts[organ_.first_region];
        return organ_.area > 0 && !flux.empty() ? part * flux[band] / samples() : 0;
    }
    /// Samples of a replicate.
    [[nodiscard]] double samples() const { return static_cast<double>(sums_.samples); }
    [[nodiscard]] std::uint32_t replicates() const {
        return static_cast<std::uint32_t>(sums_.replicates.size());
    }
    /// Whether it is known what light could have been found.
    /// Whether its triangles lie in parallel planes, so that a sun shines on all of them alike.
    [[nodiscard]] bool is_flat() const {
        constexpr double kParallel = 1 - 1e-9;
        const auto across = [&](std::size_t i) {
            return area_vector(data_of(scene_).triangles()[organ_.first_triangle + i]);
        };
        Vec3 sum = across(0);
        for (std::size_t i = 1; i < organ_.triangle_count; ++i) {
            const Vec3 own = across(i);
            if (dot(sum, own) < kParallel * length(sum) * length(own)) {
                return false;  // of a body the second triangle tells
            }
            sum += own;
        }
        return true;
    }
    [[nodiscard]] bool knows_unoccluded() const {
        return sums_.layout.unoccluded_light == UnoccludedLight::summed;
    }
    [[nodiscard]] double sunlit_area_per_find() const {
        return units_.sunlit_area_per_find(organ_.first_region);
    }

    /// Kinds of lights of which it is known what one find brings; 0: see flux_per_find().
    [[nodiscard]] std::size_t kinds() const { return sums_.units.kinds.size(); }
    [[nodiscard]] const LightKind& kind(std::size_t i) const { return sums_.units.kinds[i]; }
    /// What replicates together found of a kind of light on a side.
    struct Found {
        double units = 0;    ///< of light
        double squares = 0;  ///< sum of squares of what each find brought

        /// As how many finds of one size they count; of no light: not a number.
        [[nodiscard]] double finds() const { return units * units / squares; }
        /// Of one of them; of no light: 0.
        [[nodiscard]] double usual() const { return units > 0 ? squares / units : 0; }
    };
    /// @param replicates  the first so many
    [[nodiscard]] Found found(std::size_t kind, SurfaceSide side, std::size_t replicates) const {
        Found sum;
        const SumLayout& layout = sums_.layout;
        const LightKind& light = sums_.units.kinds[kind];
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            double units = 0;
            for (const std::size_t spectrum : light.spectra) {
                units += sum_of(layout.direct(region, side, spectrum), replicates);
            }
            const double step = reach_of(region, kind, side) * light.step;
            sum.units += units;
            sum.squares +=
                kind < layout.counted_kinds
                    ? sum_of(layout.squares(region, side, kind), replicates) * step * step
                    : units;
        }
        return sum;
    }
    /// Whether each replicate found as much of a kind of light on a side as every other, but for
    /// less than half of what a find brings: as the directions of a sun's disk make it.
    [[nodiscard]] bool found_alike(std::size_t kind, SurfaceSide side) const {
        const double half = found(kind, side, 1).usual() / 2;
        const double first = units_of(0, kind, side);
        for (std::uint32_t r = 1; r < replicates(); ++r) {
            if (std::abs(units_of(r, kind, side) - first) > half) {
                return false;
            }
        }
        return true;
    }
    /// Scattered light on a side, sum of all replicates.
    [[nodiscard]] double scattered(SurfaceSide side, std::size_t band) const {
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            const std::size_t bin = sums_.layout.scattered(region, side) + band;
            sum += sum_of(bin, sums_.replicates.size()) * units_.flux(region, band);
        }
        return sum;
    }
    /// The most units of light that one find of a kind may bring to a side.
    /// @param is_seen  whether some was found
    [[nodiscard]] double units_per_find(std::size_t kind, SurfaceSide side, bool is_seen) const {
        const double most =
            is_seen ? std::numeric_limits<double>::infinity() : this->kind(kind).unseen_reach;
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            sum += std::min(most, reach_of(organ_.first_region + i, kind, side));
        }
        return organ_.area > 0 ? sum * sums_.per_find[kind] : 0;
    }
    /// The same of area lit by suns, units of sunlit_area_per_find().
    /// @param is_seen  whether some was found
    [[nodiscard]] double sunlit_per_find(std::size_t kind, bool is_seen) const {
        const LightKind& light = this->kind(kind);
        double sum = light.sunlit_reach.empty() ? 1 : 0;
        for (std::uint32_t i = 0; !light.sunlit_reach.empty() && i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            const double longest = std::max(
                reach_of(region, kind, SurfaceSide::upper),
                reach_of(region, kind, SurfaceSide::lower));
            const double part =
                is_seen || longest <= light.unseen_reach ? 1 : light.unseen_reach / longest;
            sum += part * light.sunlit_reach[region];
        }
        return sum * sums_.per_find[kind];
    }
    /// Flux in `band` of a unit of light of a kind; 0 where direct light does not count.
    [[nodiscard]] double flux_per_unit(std::size_t kind, std::size_t band) const {
        return spec_.direct_light == DirectLight::counted
                   ? this->kind(kind).flux[band] * sums_.units.scale(organ_.first_region) /
                         samples()
                   : 0;
    }

  private:
    /// Of both sides of all regions.
    template <typename Read>
    [[nodiscard]] double largest(const Read& read) const {
        double most = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const Material& material = material_of(organ_.first_region + i);
            for (const SurfaceSide side : kSurfaceSides) {
                most = std::max(most, read(material.side(side)));
            }
        }
        return most;
    }

    template <typename Visit>
    void for_each_triangle(const Visit& visit) const {
        for (std::size_t i = 0; i < organ_.triangle_count; ++i) {
            visit(data_of(scene_).triangles()[organ_.first_triangle + i]);
        }
    }

    /// Of a bin, over the first replicates.
    [[nodiscard]] double sum_of(std::size_t bin, std::size_t replicates) const {
        double sum = 0;
        for (std::size_t r = 0; r < replicates; ++r) {
            sum += sums_.replicates[r].value(bin);
        }
        return sum;
    }

    /// Units of light of a kind that a replicate found on a side.
    [[nodiscard]] double units_of(
        std::uint32_t replicate, std::size_t kind, SurfaceSide side) const {
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            for (const std::size_t spectrum : sums_.units.kinds[kind].spectra) {
                sum += sums_.replicates[replicate].value(
                    sums_.layout.direct(organ_.first_region + i, side, spectrum));
            }
        }
        return sum;
    }
    [[nodiscard]] double reach_of(std::uint32_t region, std::size_t kind, SurfaceSide side) const {
        const auto& reach = this->kind(kind).reach;
        return reach.empty() ? (region == organ_.first_region ? 1 : 0)
                             : reach[std::size_t{2} * region + index_of(side)];
    }
    [[nodiscard]] const Material& material_of(std::uint32_t region) const {
        return data_of(scene_).material(scene_.regions()[region]);
    }

    [[nodiscard]] Incident region_incident(
        std::uint32_t replicate, std::uint32_t region, std::size_t band) const {
        const SumLayout& layout = sums_.layout;
        const ExactBins& bins = sums_.replicates[replicate];
        const double unit = units_.flux(region, band);
        Incident sum;
        const bool is_counted = spec_.direct_light == DirectLight::counted;
        for (std::size_t s = 0; is_counted && s < layout.spectra; ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            sum.direct_upper += bins.value(layout.direct(region, SurfaceSide::upper, s)) * weight;
            sum.direct_lower += bins.value(layout.direct(region, SurfaceSide::lower, s)) * weight;
        }
        for (std::size_t s = 0; is_counted && s < layout.unoccluded_spectra(); ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            sum.unoccluded_upper +=
                bins.value(layout.unoccluded(region, SurfaceSide::upper, s)) * weight;
            sum.unoccluded_lower +=
                bins.value(layout.unoccluded(region, SurfaceSide::lower, s)) * weight;
        }
        sum.scattered_upper =
            bins.value(layout.scattered(region, SurfaceSide::upper) + band) * unit;
        sum.scattered_lower =
            bins.value(layout.scattered(region, SurfaceSide::lower) + band) * unit;
        sum.absorbed = absorbed(bins, region, band, sum);
        return sum;
    }

    /// What a region absorbs: summed, or what follows from the light that falls on it.
    [[nodiscard]] double absorbed(
        const ExactBins& bins, std::uint32_t region, std::size_t band, const Incident& in) const {
        if (sums_.layout.absorbed_light == AbsorbedLight::summed) {
            const SumLayout& layout = sums_.layout;
            const bool is_counted = spec_.direct_light == DirectLight::counted;
            const double direct = bins.value(layout.absorbed_direct(region) + band);
            const double scattered = bins.value(layout.absorbed_scattered(region) + band);
            return ((is_counted ? direct : 0) + scattered) * units_.flux(region, band);
        }
        const Material& material = material_of(region);
        return (in.direct_upper + in.scattered_upper) *
                   material.side(SurfaceSide::upper).absorptance()[band] +
               (in.direct_lower + in.scattered_lower) *
                   material.side(SurfaceSide::lower).absorptance()[band];
    }

    const Sums& sums_;
    Units units_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    const Organ& organ_;
};

}  // namespace quasimc
