#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "solvers/ray_bundles/band_packs.h"
#include "solvers/ray_bundles/line_statistics.h"
#include "solvers/ray_bundles/patch_scene.h"
#include "solvers/ray_bundles/patch_sides.h"

namespace quasimc {

/// Approximate memory for the light on and from patches, and the sum of exitances.
[[nodiscard]] constexpr double bytes_of_patch_light(double patches, std::size_t bands) {
    constexpr double kBytesEach = 48;
    return kBytesEach * patches * static_cast<double>(bands);
}

/// Memory for a field of light on all patches of a scene, in its solved bands. Numbers are sorted
/// by pack of bands, in each [2 * patch + side][band of the pack].
class PatchLight {
  public:
    explicit PatchLight(const PatchScene& scene);

    [[nodiscard]] const PatchScene& scene() const { return scene_; }
    /// Number of columns: solved bands of all origins of light.
    [[nodiscard]] std::size_t bands() const { return bands_; }
    [[nodiscard]] const std::vector<BandPack>& packs() const { return packs_; }
    /// Exitance B, and incident flux E A in units of sums, in the bands of a pack.
    [[nodiscard]] PatchSides<0> sides(std::size_t pack) {
        return {packs_[pack].bands, &numbers_[4 * patches_ * packs_[pack].first]};
    }
    /// Sets all light to zero.
    void clear();

  private:
    const PatchScene& scene_;
    std::size_t patches_, bands_;
    std::vector<BandPack> packs_;
    std::vector<double> numbers_;
};

/// A field on all patches, which passes its memory on to the field that is computed from it.
struct PatchField {
    std::unique_ptr<PatchLight> light;
    std::vector<std::size_t> packs;  ///< packs of bands in which the light is not negligible
};
/// Irradiance E of patches.
struct PatchIrradiance : PatchField {
    std::optional<LineStatistics> lines;  ///< along which it came; none: direct light
};
/// Exitance B of patches.
struct PatchExitance : PatchField {};

/// E = 0: no light on patches.
[[nodiscard]] PatchIrradiance no_irradiance(std::unique_ptr<PatchLight> memory);

/// Flux of scattered light that leaves surfaces, by solved band: of all origins, which so have the
/// same orders, and as many lines as their sum has by itself.
struct ScatteredFlux {
    std::vector<double> first;   ///< flux of the first order
    std::vector<double> before;  ///< flux of the order before the last
    std::vector<double> last;    ///< flux of the last order in which the band was scattered
    std::vector<double> last_by_column;

    /// The last order and all further ones over the last, as a geometric series; infinite if light
    /// does not decrease.
    [[nodiscard]] double series(std::size_t band) const {
        const double decrease = before[band] - last[band];
        return decrease > 0 ? before[band] / decrease : std::numeric_limits<double>::infinity();
    }
};
/// Light of one order that leaves patches.
struct ScatteredOrder {
    PatchExitance exitance;
    ScatteredFlux flux;
};

/// B = R E: the exitance of surfaces that scatter their irradiance.
/// @param direct  direct light
[[nodiscard]] ScatteredOrder scatter(PatchIrradiance direct);

/// The sum of B over orders.
class ExitanceSum {
  public:
    /// Begins with 0.
    /// @param memory  for it, which must outlive it
    ExitanceSum(const PatchScene& scene, std::vector<double>& memory);

    /// Adds the exitance that an exchange sent, which the memory of the irradiance still holds, and
    /// scatters the irradiance, in one pass over patches, up to 3 % faster than two.
    /// @param before  flux of the order that was sent
    [[nodiscard]] ScatteredOrder add_and_scatter(PatchIrradiance irradiance, ScatteredFlux before);
    /// Adds the last order and a geometric series of all further ones, in packs that are not sent
    /// on.
    void add_series(const ScatteredOrder& last);
    /// The sum as an exitance, in all packs.
    /// @param memory  of the exitance
    [[nodiscard]] PatchExitance exitance(std::unique_ptr<PatchLight> memory) const;

    /// Size of its memory, in numbers.
    [[nodiscard]] static std::size_t size(const PatchScene& scene);

  private:
    std::vector<double>& numbers_;  // by pack, in each [2 * patch + side][band of the pack]
};

/// Light on each side of each region.
class RegionFlux {
  public:
    /// No light.
    RegionFlux(std::size_t regions, std::size_t bands);
    /// The light on patches that came along lines, corrected for the areas that these met.
    /// @param corrections  further factors, by 2 * region + side
    RegionFlux(const PatchIrradiance& irradiance, std::span<const double> corrections);

    /// The flux on a side of a region, [column].
    [[nodiscard]] std::span<const double> of(std::uint32_t region, SurfaceSide side) const {
        return {&sums_[(std::size_t{2} * region + index_of(side)) * bands_], bands_};
    }
    /// Adds light on all sides, [2 * region + side][column]; empty: none.
    void add(std::span<const double> flux) {
        for (std::size_t i = 0; i < flux.size(); ++i) {
            sums_[i] += flux[i];
        }
    }
    /// The flux that misses slivers, [column].
    [[nodiscard]] const std::vector<double>& missed() const { return missed_; }

  private:
    void add(
        const PatchIrradiance& irradiance, const PatchScene::Surface& surface, std::size_t pack);

    std::size_t bands_;
    std::vector<double> sums_;  // [2 * region + side][column]
    std::vector<double> missed_;
};

}  // namespace quasimc
