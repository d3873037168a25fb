#pragma once

// Reads the sums of a run organ by organ and replicate by replicate.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "quasimc/result.h"
#include "quasimc/sums.h"
#include "results/quantities.h"
#include "scene/scene.h"
#include "sums/light_blocks.h"
#include "sums/sum_data.h"

namespace quasimc {

/// Light that fell on one organ in one replicate: flux per band and side.
struct Incident {
    double direct_upper = 0, direct_lower = 0, scattered_upper = 0, scattered_lower = 0;
    double absorbed = 0;
    double unoccluded_upper = 0, unoccluded_lower = 0;  ///< 0 where it is not summed

    /// The flux of the given parts.
    [[nodiscard]] double of(const LightParts& parts) const {
        double sum = 0;
        sum += parts.direct && parts.upper ? direct_upper : 0;
        sum += parts.direct && parts.lower ? direct_lower : 0;
        sum += parts.scattered && parts.upper ? scattered_upper : 0;
        sum += parts.scattered && parts.lower ? scattered_lower : 0;
        return parts.is_absorbed ? absorbed : sum;
    }
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
    friend Incident operator*(double weight, const Incident& in) {
        return {weight * in.direct_upper,    weight * in.direct_lower, weight * in.scattered_upper,
                weight * in.scattered_lower, weight * in.absorbed,     weight * in.unoccluded_upper,
                weight * in.unoccluded_lower};
    }
};

/// Light of suns on one organ in one replicate that came straight from them: flux.
struct Beam {
    double upper = 0, lower = 0, absorbed = 0;

    Beam& operator+=(const Beam& part) {
        upper += part.upper;
        lower += part.lower;
        absorbed += part.absorbed;
        return *this;
    }
};

/// The quantities that follow from the incident light.
/// @param per_area  1 / area of the surface; 0 for no area, which receives nothing
inline std::array<double, kQuantities> quantities_of(const Incident& in, double per_area) {
    std::array<double, kQuantities> all{};
    const auto put = [&]<std::size_t... q>(std::index_sequence<q...>) {
        const auto unit = [&](const QuantityEntry& entry) { return entry.is_flux ? 1 : per_area; };
        ((all[q] = in.of(kQuantityRows[q].parts) * unit(kQuantityRows[q].entry)), ...);
    };
    put(std::make_index_sequence<kQuantities>());  // unrolled, for everything else in a row is
                                                   // constant
    return all;
}

/// The values of each quantity, per replicate.
using QuantitySamples = std::array<std::vector<double>, kQuantities>;

/// Stores the quantities that follow from the light of a replicate.
inline void put_sample(
    std::uint32_t replicate, const Incident& in, double per_area, QuantitySamples& samples) {
    const std::array<double, kQuantities> all = quantities_of(in, per_area);
    for (std::size_t q = 0; q < kQuantities; ++q) {
        samples[q][replicate] = all[q];
    }
}

/// A sunlit fraction of at least this counts as 1.
inline constexpr double kFullyLit = 1 - 1e-12;

/// Reads sums: caches the handles of their blocks and bounds.
class SumReader {
  public:
    explicit SumReader(const Sums& sums)
        : data_(*sums),
          blocks(data_.layout),
          unoccluded(data_.layout, "unoccluded"),
          squares(data_.layout, "squares"),
          direct(data_.bound("direct")),
          scattered(data_.bound("scattered")),
          light_path(data_.bound("light_path")),
          sunlit(data_.bound("sunlit")),
          samples(static_cast<double>(data_.samples)),
          scattered_samples(samples_of_scattered(data_)) {}

    [[nodiscard]] const SumData& data() const { return data_; }

    /// Whether samples are points of organs, whose light without obstruction is summed too.
    [[nodiscard]] bool has_points() const { return unoccluded.exists(); }
    /// Flux in `band` of a unit of scattered light, or of direct light of a spectrum of 1.
    [[nodiscard]] double flux(std::size_t region, std::size_t band) const {
        return data_.units.flux[band] * data_.units.scale(region) / samples;
    }

  private:
    const SumData& data_;

  public:
    const LightBlocks blocks;
    const SideBlocks unoccluded;
    const SideBlocks squares;  ///< sums of squared contributions, per strategy that counts them
    const ContributionBound &direct, &scattered, &light_path,
        &sunlit;                     ///< contributions of one sample
    const double samples;            ///< per replicate
    const double scattered_samples;  ///< samples of `scattered`, per replicate
};

/// Whether the light of an organ was summed.
inline bool is_measured(const Sums& sums, const Organ& organ) {
    return sums->measured == MeasuredOrgans::all || organ.measured;
}

/// The contributions of a strategy to a side, in all replicates.
struct CountedLight {
    double units = 0;    ///< amount of light
    double squares = 0;  ///< sum of squared contributions
    /// Whether all replicates have the same light, to within half a contribution, as is usual for
    /// paths of point sets.
    bool is_alike = true;

    /// Equivalent number of contributions of equal size. Light of less than one quantum consists of
    /// an unknown number: one is assumed.
    [[nodiscard]] double number() const {
        return units == 0 ? 0 : squares > 0 && units * units > 0 ? units * units / squares : 1;
    }
};

/// Reads an organ's sums.
class OrganReader {
  public:
    OrganReader(
        const SumReader& sums, const Scene& scene, const EvaluationSpec& spec, const Organ& organ)
        : sums_(sums.data()), reader_(sums), scene_(scene), spec_(spec), organ_(organ) {}

    [[nodiscard]] const SumReader& sums() const { return reader_; }
    [[nodiscard]] std::uint32_t replicates() const {
        return static_cast<std::uint32_t>(sums_.replicates.size());
    }

    [[nodiscard]] Incident incident(std::uint32_t replicate, std::size_t band) const {
        Incident sum;
        for_each_region(
            [&](std::uint32_t region) { sum += region_incident(replicate, region, band); });
        return sum;
    }
    /// The area of which a given side is lit, or either.
    /// @param side  with LightBlocks::has_sun_shade()
    [[nodiscard]] double sunlit_area(
        std::uint32_t replicate, std::optional<SurfaceSide> side = std::nullopt) const {
        const auto area = [&](auto bin) {
            return area_of(
                replicate, [&](std::uint32_t region) { return (reader_.blocks.*bin)(region); });
        };
        const double upper = side ? area(&LightBlocks::sunlit_upper) : 0;
        return side == SurfaceSide::upper ? upper : area(&LightBlocks::sunlit) - upper;
    }
    /// With LightBlocks::has_sun_shade().
    [[nodiscard]] Beam beam(std::uint32_t replicate, std::size_t band) const {
        Beam sum;
        for_each_region([&](std::uint32_t region) { sum += region_beam(replicate, region, band); });
        return sum;
    }

    /// Sum of all replicates.
    [[nodiscard]] Incident incident(std::size_t band) const {
        Incident sum;
        for (std::uint32_t r = 0; r < replicates(); ++r) {
            sum += incident(r, band);
        }
        return sum;
    }
    [[nodiscard]] CountedLight counted(std::size_t strategy, SurfaceSide side) const {
        CountedLight sum;
        double first = 0, half = 0;
        for (std::uint32_t r = 0; r < replicates(); ++r) {
            const CountedLight own = counted(r, strategy, side);
            first = r == 0 ? own.units : first;
            half = r == 0 && own.units > 0 ? own.squares / own.units / 2 : half;
            sum.units += own.units;
            sum.squares += own.squares;
            sum.is_alike = sum.is_alike && std::abs(own.units - first) <= half;
        }
        return sum;
    }

    /// The largest fraction of light that a side of the organ absorbs.
    [[nodiscard]] double largest_absorptance(std::size_t band) const {
        return largest([&](const Side& side) { return side.absorptance()[band]; });
    }
    /// The largest fraction of light that a side of the organ reflects.
    [[nodiscard]] double largest_reflectance(std::size_t band, SurfaceSide of) const {
        double most = 0;
        for_each_region([&](std::uint32_t region) {
            most = std::max(
                most, scattered(material_of(region).side(of), Hemisphere::reflected, band));
        });
        return most;
    }
    /// Whether any surface of the scene scatters light of a band.
    [[nodiscard]] bool may_scatter(std::size_t band) const {
        return std::ranges::any_of(data_of(scene_).materials, [&](const Material& material) {
            return std::ranges::any_of(kSurfaceSides, [&](SurfaceSide side) {
                return material.side(side).albedo()[band] > 0;
            });
        });
    }
    /// The largest contribution of a sample to the organ's light, as flux; 0 for an organ of no
    /// area.
    [[nodiscard]] double largest(const ContributionBound& bound, std::size_t band) const {
        return organ_.area > 0 ? bound.of(organ_.first_region, band) / reader_.samples : 0;
    }
    /// The largest contribution of a sample to the organ's scattered light, as flux.
    [[nodiscard]] double largest_scattered(std::size_t band) const {
        return largest(reader_.scattered, band) * reader_.samples / reader_.scattered_samples;
    }
    /// The largest sunlit area of a sample.
    [[nodiscard]] double largest_sunlit() const {
        return reader_.sunlit.of(organ_.first_region) / reader_.samples;
    }
    /// Upper bound of the units of light that one contribution of a strategy delivers to a side.
    /// @param is_seen  whether the strategy sampled some light
    [[nodiscard]] double units_per_contribution(
        std::size_t strategy, SurfaceSide side, bool is_seen) const {
        const double most = is_seen ? std::numeric_limits<double>::infinity()
                                    : sums_.strategies[strategy].unseen_reach;
        double sum = 0;
        for_each_region(
            [&](std::uint32_t region) { sum += std::min(most, reach_of(region, strategy, side)); });
        return organ_.area > 0 ? sum * sums_.per_contribution[strategy] : 0;
    }
    /// Upper bound of the sunlit area of one contribution, in units of largest_sunlit().
    /// @param is_seen  whether the strategy sampled some light
    [[nodiscard]] double sunlit_per_contribution(std::size_t strategy, bool is_seen) const {
        const SamplingStrategy& light = sums_.strategies[strategy];
        double sum = light.sunlit_reach.empty() ? 1 : 0;
        for_each_region([&](std::uint32_t region) {
            const double longest = std::max(
                reach_of(region, strategy, SurfaceSide::upper),
                reach_of(region, strategy, SurfaceSide::lower));
            const double part =
                is_seen || longest <= light.unseen_reach ? 1 : light.unseen_reach / longest;
            sum += light.sunlit_reach.empty() ? 0 : part * light.sunlit_reach[region];
        });
        return sum * sums_.per_contribution[strategy];
    }
    /// Flux in `band` of a unit of a strategy's light; 0 where direct light is excluded.
    [[nodiscard]] double flux_per_unit(std::size_t strategy, std::size_t band) const {
        return counts_direct() ? sums_.strategies[strategy].flux[band] *
                                     sums_.units.scale(organ_.first_region) / reader_.samples
                               : 0;
    }

    /// The part of the light of uniform surroundings that lies within the field of view.
    [[nodiscard]] double part_in_view() const {
        return 1 - organ_.least_cosine * organ_.least_cosine;
    }
    /// Whether all triangles are parallel, so that a sun shines equally on all of them.
    [[nodiscard]] bool is_flat() const {
        constexpr double kParallel = 1 - 1e-9;
        Vec3 sum = area_vector(triangle(0));
        for (std::size_t i = 1; i < organ_.triangle_count; ++i) {
            const Vec3 own = area_vector(triangle(i));
            if (dot(sum, own) < kParallel * length(sum) * length(own)) {
                return false;  // closed bodies fail at the second triangle
            }
            sum += own;
        }
        return true;
    }
    /// Self view factor of a side: the part of diffuse light leaving a concave side that falls on
    /// it again, 1 less the opening's area over that of the side; 0 for flat and convex sides, and
    /// where no light of the band gets in.
    [[nodiscard]] double self_view_factor(SurfaceSide side, std::size_t band) const {
        Vec3 middle, opening;
        double twice_area = 0, outwards = 0;  // outwards: a sum over the upper side
        for (std::size_t i = 0; i < organ_.triangle_count; ++i) {
            const Triangle t = triangle(i);
            const Vec3 across = area_vector(t);
            middle += length(across) * (t[0] + t[1] + t[2]);
            opening += across;
            twice_area += length(across);
        }
        for (std::size_t i = 0; twice_area > 0 && i < organ_.triangle_count; ++i) {
            const Triangle t = triangle(i);
            outwards += dot(t[0] + t[1] + t[2] - 1 / twice_area * middle, area_vector(t));
        }
        const SurfaceSide inner = outwards > 0 ? SurfaceSide::lower : SurfaceSide::upper;
        constexpr double kClosed = 1e-9;
        const double open = twice_area > 0 ? length(opening) / twice_area : 1;
        const bool is_reached = open > kClosed || transmits_inwards(inner, band);
        return side == inner && is_reached ? std::max(0.0, 1 - open) : 0;
    }

  private:
    static double scattered(const Side& side, Hemisphere into, std::size_t band) {
        double sum = 0;
        for (const Lobe& lobe : side.lobes()) {
            sum += lobe.shape->hemisphere() == into ? lobe.albedo[band] : 0;
        }
        return sum;
    }
    [[nodiscard]] bool transmits_inwards(SurfaceSide inner, std::size_t band) const {
        const SurfaceSide outer =
            inner == SurfaceSide::upper ? SurfaceSide::lower : SurfaceSide::upper;
        bool transmits = false;
        for_each_region([&](std::uint32_t region) {
            transmits =
                transmits ||
                scattered(material_of(region).side(outer), Hemisphere::transmitted, band) > 0;
        });
        return transmits;
    }
    [[nodiscard]] Triangle triangle(std::size_t i) const {
        return data_of(scene_).triangles()[organ_.first_triangle + i];
    }
    [[nodiscard]] const Material& material_of(std::uint32_t region) const {
        return data_of(scene_).material(scene_.regions()[region]);
    }
    [[nodiscard]] bool counts_direct() const { return spec_.direct_light == DirectLight::included; }

    template <typename Visit>
    void for_each_region(const Visit& visit) const {
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            visit(organ_.first_region + i);
        }
    }
    /// The largest of read(side) over both sides of all regions.
    template <typename Read>
    [[nodiscard]] double largest(const Read& read) const {
        double most = 0;
        for_each_region([&](std::uint32_t region) {
            for (const SurfaceSide side : kSurfaceSides) {
                most = std::max(most, read(material_of(region).side(side)));
            }
        });
        return most;
    }

    /// @param bin_of  the bin of a region
    template <typename BinOf>
    [[nodiscard]] double area_of(std::uint32_t replicate, const BinOf& bin_of) const {
        double sum = 0;
        for_each_region([&](std::uint32_t region) {
            const double unit =
                sums_.units.sunlit_area * sums_.units.scale(region) / reader_.samples;
            sum += value(replicate, bin_of(region)) * unit;
        });
        return sum;
    }
    [[nodiscard]] double value(std::uint32_t replicate, std::size_t bin) const {
        return sums_.replicates[replicate].value(bin);
    }
    [[nodiscard]] CountedLight counted(
        std::uint32_t replicate, std::size_t strategy, SurfaceSide side) const {
        CountedLight sum;
        const SamplingStrategy& light = sums_.strategies[strategy];
        for_each_region([&](std::uint32_t region) {
            double units = 0;
            for (const std::size_t spectrum : light.spectra) {
                units += value(replicate, reader_.blocks.direct(region, side, spectrum));
            }
            const double step = reach_of(region, strategy, side) * light.step;
            sum.units += units;
            sum.squares +=
                strategy < reader_.squares.columns()
                    ? value(replicate, reader_.squares.bin(region, side, strategy)) * step * step
                    : units;
        });
        return sum;
    }
    [[nodiscard]] double reach_of(
        std::uint32_t region, std::size_t strategy, SurfaceSide side) const {
        const auto& reach = sums_.strategies[strategy].reach;
        return reach.empty() ? (region == organ_.first_region ? 1 : 0)
                             : reach[std::size_t{2} * region + index_of(side)];
    }

    [[nodiscard]] Incident region_incident(
        std::uint32_t replicate, std::uint32_t region, std::size_t band) const {
        const LightBlocks& blocks = reader_.blocks;
        const double unit = reader_.flux(region, band);
        const auto light = [&](std::size_t bin) { return value(replicate, bin); };
        Incident sum;
        for (std::size_t s = 0; counts_direct() && s < sums_.spectra.size(); ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            sum.direct_upper += light(blocks.direct(region, SurfaceSide::upper, s)) * weight;
            sum.direct_lower += light(blocks.direct(region, SurfaceSide::lower, s)) * weight;
        }
        for (std::size_t s = 0; counts_direct() && s < reader_.unoccluded.columns(); ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            const auto bin = [&](SurfaceSide side) {
                return reader_.unoccluded.bin(region, side, s);
            };
            sum.unoccluded_upper += light(bin(SurfaceSide::upper)) * weight;
            sum.unoccluded_lower += light(bin(SurfaceSide::lower)) * weight;
        }
        sum.scattered_upper = light(blocks.scattered(region, SurfaceSide::upper) + band) * unit;
        sum.scattered_lower = light(blocks.scattered(region, SurfaceSide::lower) + band) * unit;
        if (blocks.has_absorbed()) {
            sum.absorbed = (counts_direct() ? light(blocks.absorbed_direct(region) + band) : 0) +
                           light(blocks.absorbed_scattered(region) + band);
            sum.absorbed *= unit;
            return sum;
        }
        const Material& material = material_of(region);
        sum.absorbed = (sum.direct_upper + sum.scattered_upper) *
                           material.side(SurfaceSide::upper).absorptance()[band] +
                       (sum.direct_lower + sum.scattered_lower) *
                           material.side(SurfaceSide::lower).absorptance()[band];
        return sum;
    }

    [[nodiscard]] Beam region_beam(
        std::uint32_t replicate, std::uint32_t region, std::size_t band) const {
        const LightBlocks& blocks = reader_.blocks;
        const double unit = counts_direct() ? reader_.flux(region, band) : 0;
        Beam sum;
        for (const std::size_t s : sums_.sun_spectra) {
            const double weight = sums_.spectra[s][band] * unit;
            sum.upper += value(replicate, blocks.direct(region, SurfaceSide::upper, s)) * weight;
            sum.lower += value(replicate, blocks.direct(region, SurfaceSide::lower, s)) * weight;
        }
        const Material& material = material_of(region);
        sum.absorbed = blocks.has_absorbed()
                           ? value(replicate, blocks.absorbed_beam(region) + band) * unit
                           : sum.upper * material.side(SurfaceSide::upper).absorptance()[band] +
                                 sum.lower * material.side(SurfaceSide::lower).absorptance()[band];
        return sum;
    }

    const SumData& sums_;
    const SumReader& reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    const Organ& organ_;
};

}  // namespace quasimc
