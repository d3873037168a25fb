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

/// Reads sums: caches the handles of their blocks and bounds, and converts bins to flux after all
/// samples.
class SumReader {
  public:
    explicit SumReader(const Sums& sums)
        : data_(*sums),
          blocks_(data_.layout),
          unoccluded_(data_.layout, "unoccluded"),
          squares_(data_.layout, "squares"),
          direct_(data_.bound("direct")),
          scattered_(data_.bound("scattered")),
          light_path_(data_.bound("light_path")),
          sunlit_(data_.bound("sunlit")),
          samples_(static_cast<double>(data_.samples)) {}

    [[nodiscard]] const SumData& data() const { return data_; }
    [[nodiscard]] const LightBlocks& blocks() const { return blocks_; }
    /// Unoccluded direct light; may be missing.
    [[nodiscard]] const SideBlocks& unoccluded() const { return unoccluded_; }
    /// The sum of squared contributions of each strategy that counts them.
    [[nodiscard]] const SideBlocks& squares() const { return squares_; }
    [[nodiscard]] double samples() const { return samples_; }

    /// Flux in `band` of a unit of scattered light, or of direct light of a spectrum of 1.
    [[nodiscard]] double flux(std::size_t region, std::size_t band) const {
        return data_.units.flux[band] * data_.units.scale(region) / samples_;
    }
    [[nodiscard]] double sunlit_area(std::size_t region) const {
        return data_.units.sunlit_area * data_.units.scale(region) / samples_;
    }
    /// The largest contribution of a single sample: flux, or sunlit area.
    [[nodiscard]] double largest_direct(std::size_t region, std::size_t band) const {
        return direct_.of(region, band) / samples_;
    }
    [[nodiscard]] double largest_scattered(std::size_t region, std::size_t band) const {
        return scattered_.of(region, band) / samples_;
    }
    [[nodiscard]] double largest_by_light_path(std::size_t region, std::size_t band) const {
        return light_path_.of(region, band) / samples_;
    }
    [[nodiscard]] double largest_sunlit(std::size_t region) const {
        return sunlit_.of(region) / samples_;
    }

  private:
    const SumData& data_;
    LightBlocks blocks_;
    SideBlocks unoccluded_, squares_;
    const ContributionBound &direct_, &scattered_, &light_path_, &sunlit_;
    double samples_;
};

/// Whether the light of an organ was summed.
inline bool is_measured(const Sums& sums, const Organ& organ) {
    return sums->measured == MeasuredOrgans::all || organ.measured;
}

/// Reads an organ's sums.
class OrganReader {
  public:
    OrganReader(
        const SumReader& sums, const Scene& scene, const EvaluationSpec& spec, const Organ& organ)
        : sums_(sums.data()), reader_(sums), scene_(scene), spec_(spec), organ_(organ) {}

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
            sum += bins.value(reader_.blocks().sunlit(region)) * reader_.sunlit_area(region);
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

    /// A concave side, and its self view factor: the part of diffuse light leaving it that falls on
    /// it again, 1 less the opening's area over that of the side.
    struct Hollow {
        SurfaceSide side{};
        double part = 0;  ///< 0 for flat organs
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
        double outwards = 0;  // sum over the upper side
        for_each_triangle([&](const Triangle& t) {
            outwards += dot(t[0] + t[1] + t[2] - middle, area_vector(t));
        });
        return {
            outwards > 0 ? SurfaceSide::lower : SurfaceSide::upper,
            twice_area > 0 ? std::max(0.0, 1 - length(opening) / twice_area) : 0};
    }

    /// The largest contribution of a sample to the organ's direct light, as flux; 0 for an organ of
    /// no area.
    [[nodiscard]] double largest_direct(std::size_t band) const {
        return organ_.area > 0 ? reader_.largest_direct(organ_.first_region, band) : 0;
    }
    /// The largest contribution of a sample to its scattered light.
    [[nodiscard]] double largest_scattered(std::size_t band) const {
        return organ_.area > 0 ? reader_.largest_scattered(organ_.first_region, band) : 0;
    }
    /// The part of the light of uniform surroundings that lies within the field of view.
    [[nodiscard]] double part_in_view() const {
        return 1 - organ_.least_cosine * organ_.least_cosine;
    }
    /// The largest contribution of a light subpath that accompanies a sample; 0 without subpaths.
    [[nodiscard]] double largest_by_light_path(std::size_t band) const {
        return organ_.area > 0 ? reader_.largest_by_light_path(organ_.first_region, band) : 0;
    }
    /// Number of samples per replicate.
    [[nodiscard]] double samples() const { return reader_.samples(); }
    [[nodiscard]] std::uint32_t replicates() const {
        return static_cast<std::uint32_t>(sums_.replicates.size());
    }
    /// Whether all triangles are parallel, so that a sun shines equally on all of them.
    [[nodiscard]] bool is_flat() const {
        constexpr double kParallel = 1 - 1e-9;
        const auto across = [&](std::size_t i) {
            return area_vector(data_of(scene_).triangles()[organ_.first_triangle + i]);
        };
        Vec3 sum = across(0);
        for (std::size_t i = 1; i < organ_.triangle_count; ++i) {
            const Vec3 own = across(i);
            if (dot(sum, own) < kParallel * length(sum) * length(own)) {
                return false;  // closed bodies fail at the second triangle
            }
            sum += own;
        }
        return true;
    }
    /// Whether the unoccluded light is known.
    [[nodiscard]] bool knows_unoccluded() const { return reader_.unoccluded().exists(); }
    [[nodiscard]] double largest_sunlit() const {
        return reader_.largest_sunlit(organ_.first_region);
    }

    /// Number of strategies with contributions of known size; 0: see largest_direct().
    [[nodiscard]] std::size_t strategies() const { return sums_.strategies.size(); }
    [[nodiscard]] const SamplingStrategy& strategy(std::size_t i) const {
        return sums_.strategies[i];
    }
    /// Light of a strategy on a side, summed over replicates.
    struct Found {
        double units = 0;    ///< of light
        double squares = 0;  ///< sum of squared contributions

        /// Equivalent number of contributions of equal size; without light: NaN.
        [[nodiscard]] double contributions() const { return units * units / squares; }
        /// Mean size of a contribution; without light: 0.
        [[nodiscard]] double mean_size() const { return units > 0 ? squares / units : 0; }
    };
    /// @param replicates  number of replicates, from the first
    [[nodiscard]] Found found(
        std::size_t strategy, SurfaceSide side, std::size_t replicates) const {
        Found sum;
        const SideBlocks& squares = reader_.squares();
        const SamplingStrategy& light = sums_.strategies[strategy];
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            double units = 0;
            for (const std::size_t spectrum : light.spectra) {
                units += sum_of(reader_.blocks().direct(region, side, spectrum), replicates);
            }
            const double step = reach_of(region, strategy, side) * light.step;
            sum.units += units;
            sum.squares +=
                strategy < squares.columns()
                    ? sum_of(squares.bin(region, side, strategy), replicates) * step * step
                    : units;
        }
        return sum;
    }
    /// Whether the light of a strategy on a side differs between replicates by less than half a
    /// contribution, as is usual for the directions within a sun's disk.
    [[nodiscard]] bool found_alike(std::size_t strategy, SurfaceSide side) const {
        const double half = found(strategy, side, 1).mean_size() / 2;
        const double first = units_of(0, strategy, side);
        for (std::uint32_t r = 1; r < replicates(); ++r) {
            if (std::abs(units_of(r, strategy, side) - first) > half) {
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
            const std::size_t bin = reader_.blocks().scattered(region, side) + band;
            sum += sum_of(bin, sums_.replicates.size()) * reader_.flux(region, band);
        }
        return sum;
    }
    /// Upper bound of the units of light that one contribution of a strategy delivers to a side.
    /// @param is_seen  whether the strategy sampled some light
    [[nodiscard]] double units_per_contribution(
        std::size_t strategy, SurfaceSide side, bool is_seen) const {
        const double most = is_seen ? std::numeric_limits<double>::infinity()
                                    : this->strategy(strategy).unseen_reach;
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            sum += std::min(most, reach_of(organ_.first_region + i, strategy, side));
        }
        return organ_.area > 0 ? sum * sums_.per_contribution[strategy] : 0;
    }
    /// Upper bound of the sunlit area of one contribution, in units of largest_sunlit().
    /// @param is_seen  whether the strategy sampled some light
    [[nodiscard]] double sunlit_per_contribution(std::size_t strategy, bool is_seen) const {
        const SamplingStrategy& light = this->strategy(strategy);
        double sum = light.sunlit_reach.empty() ? 1 : 0;
        for (std::uint32_t i = 0; !light.sunlit_reach.empty() && i < organ_.region_count; ++i) {
            const std::uint32_t region = organ_.first_region + i;
            const double longest = std::max(
                reach_of(region, strategy, SurfaceSide::upper),
                reach_of(region, strategy, SurfaceSide::lower));
            const double part =
                is_seen || longest <= light.unseen_reach ? 1 : light.unseen_reach / longest;
            sum += part * light.sunlit_reach[region];
        }
        return sum * sums_.per_contribution[strategy];
    }
    /// Flux in `band` of a unit of a strategy's light; 0 where direct light is excluded.
    [[nodiscard]] double flux_per_unit(std::size_t strategy, std::size_t band) const {
        return spec_.direct_light == DirectLight::included
                   ? this->strategy(strategy).flux[band] * sums_.units.scale(organ_.first_region) /
                         samples()
                   : 0;
    }

  private:
    /// Sum of read(region, side) over both sides of all regions.
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

    /// Sum of a bin over the first replicates.
    [[nodiscard]] double sum_of(std::size_t bin, std::size_t replicates) const {
        double sum = 0;
        for (std::size_t r = 0; r < replicates; ++r) {
            sum += sums_.replicates[r].value(bin);
        }
        return sum;
    }

    /// Units of a strategy's light on a side in one replicate.
    [[nodiscard]] double units_of(
        std::uint32_t replicate, std::size_t strategy, SurfaceSide side) const {
        double sum = 0;
        for (std::uint32_t i = 0; i < organ_.region_count; ++i) {
            for (const std::size_t spectrum : sums_.strategies[strategy].spectra) {
                sum += sums_.replicates[replicate].value(
                    reader_.blocks().direct(organ_.first_region + i, side, spectrum));
            }
        }
        return sum;
    }
    [[nodiscard]] double reach_of(
        std::uint32_t region, std::size_t strategy, SurfaceSide side) const {
        const auto& reach = this->strategy(strategy).reach;
        return reach.empty() ? (region == organ_.first_region ? 1 : 0)
                             : reach[std::size_t{2} * region + index_of(side)];
    }
    [[nodiscard]] const Material& material_of(std::uint32_t region) const {
        return data_of(scene_).material(scene_.regions()[region]);
    }

    [[nodiscard]] Incident region_incident(
        std::uint32_t replicate, std::uint32_t region, std::size_t band) const {
        const LightBlocks& blocks = reader_.blocks();
        const SideBlocks& unoccluded = reader_.unoccluded();
        const ExactBins& bins = sums_.replicates[replicate];
        const double unit = reader_.flux(region, band);
        Incident sum;
        const bool is_counted = spec_.direct_light == DirectLight::included;
        for (std::size_t s = 0; is_counted && s < sums_.spectra.size(); ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            sum.direct_upper += bins.value(blocks.direct(region, SurfaceSide::upper, s)) * weight;
            sum.direct_lower += bins.value(blocks.direct(region, SurfaceSide::lower, s)) * weight;
        }
        for (std::size_t s = 0; is_counted && s < unoccluded.columns(); ++s) {
            const double weight = sums_.spectra[s][band] * unit;
            sum.unoccluded_upper +=
                bins.value(unoccluded.bin(region, SurfaceSide::upper, s)) * weight;
            sum.unoccluded_lower +=
                bins.value(unoccluded.bin(region, SurfaceSide::lower, s)) * weight;
        }
        sum.scattered_upper =
            bins.value(blocks.scattered(region, SurfaceSide::upper) + band) * unit;
        sum.scattered_lower =
            bins.value(blocks.scattered(region, SurfaceSide::lower) + band) * unit;
        sum.absorbed = absorbed(bins, region, band, sum);
        return sum;
    }

    /// Light that a region absorbs: summed directly, or derived from its incident light.
    [[nodiscard]] double absorbed(
        const ExactBins& bins, std::uint32_t region, std::size_t band, const Incident& in) const {
        const LightBlocks& blocks = reader_.blocks();
        if (blocks.has_absorbed()) {
            const bool is_counted = spec_.direct_light == DirectLight::included;
            const double direct = bins.value(blocks.absorbed_direct(region) + band);
            const double scattered = bins.value(blocks.absorbed_scattered(region) + band);
            return ((is_counted ? direct : 0) + scattered) * reader_.flux(region, band);
        }
        const Material& material = material_of(region);
        return (in.direct_upper + in.scattered_upper) *
                   material.side(SurfaceSide::upper).absorptance()[band] +
               (in.direct_lower + in.scattered_lower) *
                   material.side(SurfaceSide::lower).absorptance()[band];
    }

    const SumData& sums_;
    const SumReader& reader_;
    const Scene& scene_;
    const EvaluationSpec& spec_;
    const Organ& organ_;
};

}  // namespace quasimc
