#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "solvers/ray_bundles/band_packs.h"
#include "solvers/ray_bundles/patch_scatter.h"
#include "solvers/ray_bundles/patch_scene.h"
#include "solvers/ray_bundles/patch_sides.h"

namespace quasimc {

/// Memory that the light on and from so many patches takes, about.
[[nodiscard]] constexpr double bytes_of_patch_light(double patches, std::size_t bands) {
    constexpr double kBytesEach = 96;
    return kBytesEach * patches * static_cast<double>(bands);
}

/// Bands of a pack that a source lights, and what it brings to each.
struct LitBands {
    PatchSides<0> sides;              ///< in the bands of the pack
    std::size_t first = 0;            ///< in the pack
    std::span<const double> weights;  ///< of the bands from the first on

    /// Adds `amount` times the weights to what came to a side.
    void add(std::size_t side, double amount) const {
        double* to = sides.incident(side) + first;
        for (std::size_t i = 0; i < weights.size(); ++i) {
            to[i] += amount * weights[i];
        }
    }
    void fetch(std::size_t side) const { sides.fetch_incident(side, first, weights.size()); }
};

/// The light on and from all patches of a scene in one step of the exchange, in all bands, twice:
/// as it is where each patch is equally bright, and where each four of them are.
///
/// A column is [level * bands + band], level 0 the finer one. Numbers stand pack by pack of bands,
/// in each [2 * patch + side][level * bands of the pack + band]. Those of a patch, on and from both
/// of its sides, stand next to each other in whole cache lines: light that goes along lines, from
/// patch to patch all over the scene, waits for them alone.
class PatchLight {
  public:
    explicit PatchLight(const PatchScene& scene);

    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] const std::vector<BandPack>& packs() const { return packs_; }
    /// What leaves each side in the bands of a pack, and what came to it in units of sums.
    [[nodiscard]] PatchSides<0> sides(std::size_t pack) {
        return {2 * packs_[pack].bands, lines_[patches_ * packs_[pack].first].numbers.data()};
    }
    /// The column of one of a pack.
    [[nodiscard]] std::size_t column(std::size_t pack, std::size_t own) const {
        const BandPack& bands = packs_[pack];
        return own / bands.bands * bands_ + bands.first + own % bands.bands;
    }

    /// No light anywhere.
    void clear();
    /// All bands that a source lights, pack by pack; of those between them, some may get 0. Light
    /// straight from it is added to them, without what misses thin triangles.
    /// @param weights  of all bands, which must outlive it
    [[nodiscard]] std::vector<LitBands> lit_bands(std::span<const double> weights);

    /// Sets the exitance to what surfaces send on of the light that came, which it takes away.
    /// Remembers the exitance that was.
    /// @param is_direct  it came straight from the sources
    /// @returns flux that leaves surfaces, [column]; of packs that rest, as it was
    const std::vector<double>& scatter(bool is_direct);
    /// Lets packs rest, in all columns of which little leaves surfaces, until send_all_kept().
    /// @param is_little  by column
    void rest(const std::vector<bool>& is_little);
    [[nodiscard]] bool rests(std::size_t pack) const { return rests_[pack]; }
    [[nodiscard]] bool all_rest() const {
        return std::find(rests_.begin(), rests_.end(), false) == rests_.end();
    }
    /// Sets the exitance to all that was remembered, in all packs.
    void send_all_kept();
    /// Sums the light that came, by side of each region.
    /// @returns of thin triangles, what misses them, [column]
    [[nodiscard]] std::vector<double> collect();
    /// Counts the lines of a bundle that meet each surface (in the order of PatchScene): times
    /// `weight`, of which the area of the surface comes in the mean.
    void count_lines(std::span<const std::uint32_t> lines, double weight);
    /// Corrects what came along lines for how often they met each region: divides it by the area
    /// that they found of it, and multiplies by the true one.
    /// @param lines_per_area  of the bundles, in the mean. Regions that are met seldom are left as
    ///        they are
    void correct_areas(double lines_per_area);
    /// The factor, and whether the region is met so often that it is one.
    [[nodiscard]] double correction(std::uint32_t region) const { return corrections_[region]; }
    [[nodiscard]] bool is_corrected(std::uint32_t region) const { return is_corrected_[region]; }
    /// Of a region but for its sensors, the true area, and what the last lines found of it.
    [[nodiscard]] double area_of(std::uint32_t region) const { return region_areas_[region]; }
    [[nodiscard]] double area_met(std::uint32_t region) const { return met_areas_[region]; }

    /// Of a side of a region, what collect() found, [column].
    [[nodiscard]] std::span<const double> sum(std::uint32_t region, SurfaceSide side) const {
        return {&sums_[(std::size_t{2} * region + index_of(side)) * columns_], columns_};
    }

  private:
    template <std::size_t kBands>
    void scatter_pack(std::size_t pack, bool is_direct, std::span<double> scattered);
    void copy_to_coarse();
    void collect_from(
        const PatchScene::Surface& surface, std::size_t pack, std::vector<double>& passed_by);
    template <std::size_t kBands>
    void even_out(const PatchScene::Surface& surface, const PatchScatter<kBands>& each);
    template <std::size_t kBands>
    void even_out_cut(
        const PatchScene::Surface& surface,
        const CutTriangle& cut,
        const PatchScatter<kBands>& each);
    struct alignas(kCacheLine) CacheLine {
        std::array<double, kCacheLine / sizeof(double)> numbers{};
    };
    [[nodiscard]] std::size_t side_count() const { return 2 * patches_; }
    /// Exitance of all steps in the bands of a pack, as PatchSides has it.
    [[nodiscard]] double* kept(std::size_t pack) {
        return kept_.data() + side_count() * 2 * packs_[pack].first;
    }

    const PatchScene& scene_;
    std::size_t patches_, bands_, columns_;
    std::vector<BandPack> packs_;
    std::vector<bool> rests_;      // by pack
    std::vector<double> leaving_;  // by column, see scatter()
    std::vector<CacheLine> lines_;
    std::vector<double> kept_;
    std::vector<double> sums_;  // [2 * region + side][column]
    std::vector<double> means_, areas_;
    std::vector<double> found_areas_;                  // by surface, in this step
    std::vector<double> region_areas_;                 // but for sensors
    std::vector<double> corrections_;                  // by region, of what came in this step
    std::vector<double> met_areas_;                    // by region, in this step
    std::vector<bool> is_corrected_;                   // by region
    std::vector<std::vector<std::uint32_t>> parents_;  // by level and part
};

}  // namespace quasimc
