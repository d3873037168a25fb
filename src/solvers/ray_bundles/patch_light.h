#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/parallel.h"
#include "solvers/ray_bundles/band_packs.h"
#include "solvers/ray_bundles/line_statistics.h"
#include "solvers/ray_bundles/patch_scene.h"
#include "solvers/ray_bundles/patch_sides.h"

namespace quasimc {

/// Memory that the light on and from patches takes, about.
[[nodiscard]] constexpr double bytes_of_patch_light(double patches, std::size_t bands) {
    constexpr double kBytesEach = 96;
    return kBytesEach * patches * static_cast<double>(bands);
}

/// Memory for the fields of a replicate on all patches of a scene, in all bands, on two levels: as
/// light is where each patch is equally bright, and where each four of them are.
///
/// A column is [level * bands + band], level 0 the finer one. Numbers are sorted by pack of bands,
/// in each [2 * patch + side][level * bands of the pack + band]. Those of a patch, on and from both
/// of its sides, lie next to each other in whole cache lines: light that goes along lines, from
/// patch to patch all over the scene, waits for them alone.
class PatchLight {
  public:
    explicit PatchLight(const PatchScene& scene);

    [[nodiscard]] const PatchScene& scene() const { return scene_; }
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] const std::vector<BandPack>& packs() const { return packs_; }
    /// The column of one of a pack.
    [[nodiscard]] std::size_t column(std::size_t pack, std::size_t own) const {
        const BandPack& bands = packs_[pack];
        return own / bands.bands * bands_ + bands.first + own % bands.bands;
    }
    /// Exitance B, and incident flux E A in units of sums, in the bands of a pack.
    [[nodiscard]] PatchSides<0> sides(std::size_t pack) {
        return {2 * packs_[pack].bands, lines_[patches_ * packs_[pack].first].numbers.data()};
    }
    /// The sum of the exitances of several orders, [2 * patch + side][column of the pack].
    [[nodiscard]] double* total_exitance(std::size_t pack) {
        return total_.data() + 2 * patches_ * 2 * packs_[pack].first;
    }
    /// Sets all light to zero.
    void clear();

  private:
    struct alignas(kCacheLine) CacheLine {
        std::array<double, kCacheLine / sizeof(double)> numbers{};
    };

    const PatchScene& scene_;
    std::size_t patches_, bands_, columns_;
    std::vector<BandPack> packs_;
    std::vector<CacheLine> lines_;
    std::vector<double> total_;
};

/// A field on all patches, which passes its memory on to the field that is computed of it.
struct PatchField {
    std::unique_ptr<PatchLight> light;
    /// Flux that left surfaces of the first order, and of the last one, [column].
    std::vector<double> first, leaving;
    /// Packs of bands in which the last order is negligible: it is not exchanged.
    std::vector<bool> converged;
};
/// Irradiance E of patches.
struct PatchIrradiance : PatchField {
    std::optional<LineStatistics> lines;  ///< along which it came; none: straight from sources
};
/// Exitance B of patches.
struct PatchExitance : PatchField {};

/// E = 0: no light on patches.
[[nodiscard]] PatchIrradiance no_irradiance(std::unique_ptr<PatchLight> memory);

/// B = R E: what surfaces scatter of the light on them. The cosine law: light leaves a patch
/// equally bright in all directions. The exitance of the last order is added to the sum of all.
[[nodiscard]] PatchExitance scatter(PatchIrradiance irradiance);

/// The sum of B over all orders that were exchanged, in all packs.
/// @param last  the exitance of the first order that was not
[[nodiscard]] PatchExitance sum_of_orders(PatchExitance last);

/// Light on each side of each region.
class RegionFlux {
  public:
    /// No light.
    RegionFlux(std::size_t regions, std::size_t columns);
    /// The light on patches that came along lines, corrected for the areas that these met.
    /// @param corrections  further factors, by 2 * region + side
    RegionFlux(const PatchIrradiance& irradiance, std::span<const double> corrections);

    /// The flux on a side of a region, [column].
    [[nodiscard]] std::span<const double> of(std::uint32_t region, SurfaceSide side) const {
        return {&sums_[(std::size_t{2} * region + index_of(side)) * columns_], columns_};
    }
    /// The flux that misses thin triangles, [column].
    [[nodiscard]] const std::vector<double>& missed() const { return missed_; }

  private:
    void add(
        const PatchIrradiance& irradiance, const PatchScene::Surface& surface, std::size_t pack);

    std::size_t columns_;
    std::vector<double> sums_;  // [2 * region + side][column]
    std::vector<double> missed_;
};

}  // namespace quasimc
