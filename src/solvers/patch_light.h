#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "base/parallel.h"
#include "geometry/raster/columns.h"
#include "geometry/raster/patches.h"
#include "solvers/patch_scatter.h"
#include "solvers/patch_sides.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// How finely light that leaves surfaces is told apart: by triangle of the caster's mesh, patches
/// of about equal areas (solvers/patch_size.h), at least four a triangle, and cut where surfaces
/// cross. Images of triangles have none.
/// @param most  about so many patches, unless that loses the shadows of organs
/// @throws InputError  if looking for what crosses would take too long
/// @throws StopRequested  if a stop was requested
[[nodiscard]] Patches make_patches(
    const PreparedScene& prepared,
    std::span<const VisibilityRole> roles,
    double most,
    const std::stop_token& stop);

/// What the matt surfaces of a scene are made of, patch by patch: const, shared by all threads.
struct PatchScene {
    /// @param seen  the scene as beams see it
    PatchScene(const PreparedScene& scene, const ProjectedScene& seen, Patches cut);

    /// A triangle that has patches.
    struct Surface {
        std::uint32_t triangle = 0, region = 0, material = 0;
        double area = 0;  ///< local units squared
        /// Light on it over light on its rounded corners: 1 but for thin triangles.
        double exact_share = 1;
        bool is_sensor = false;
    };

    const PreparedScene& prepared;
    Patches patches;
    std::vector<Surface> surfaces;
    std::vector<PatchOptics> optics;  ///< [2 * material + side]
    ColumnTriangles drawn;
    double area = 0;         ///< of all surfaces
    double mean_albedo = 0;  ///< by area, in the band where it is largest

    [[nodiscard]] const PatchOptics& of(std::uint32_t material, SurfaceSide side) const {
        return optics[std::size_t{2} * material + index_of(side)];
    }
    /// The first of a triangle in Patches of the representative of images.
    [[nodiscard]] std::uint32_t representative(std::uint32_t triangle) const {
        return representatives.empty() ? triangle : representatives[triangle];
    }
    std::vector<std::uint32_t> representatives;  ///< of images, by triangle; empty: itself
};

/// Bands that a source lights: those outside have none of its light.
struct LitBands {
    std::size_t first = 0;
    std::span<const double> weights;  ///< of the bands from the first on
};
/// @param weights  of all bands
[[nodiscard]] LitBands lit_bands(std::span<const double> weights);

/// Memory that the light on and from so many patches takes, about.
[[nodiscard]] constexpr double bytes_of_patch_light(double patches, std::size_t bands) {
    constexpr double kBytesEach = 96;
    return kBytesEach * patches * static_cast<double>(bands);
}

/// The light on and from all patches of a scene in one step of the exchange, in all bands, twice:
/// as it is where each patch is equally bright, and where each four of them are.
///
/// Numbers stand [2 * patch + side][level * bands + band], level 0 the finer one. Those of a patch,
/// on and from both of its sides, stand next to each other in whole cache lines: light that goes
/// along lines, from patch to patch all over the scene, waits for them alone.
class PatchLight {
  public:
    explicit PatchLight(const PatchScene& scene);

    [[nodiscard]] std::size_t columns() const { return columns_; }
    /// What leaves each side, and what came to it in units of sums.
    [[nodiscard]] PatchSides<0> sides() { return {columns_, lines_.data()->numbers.data()}; }

    /// No light anywhere.
    void clear();
    /// Adds light straight from a source, per band `amount` times its weight; what misses thin
    /// triangles is left out of it.
    void add_direct(std::uint32_t patch, SurfaceSide side, double amount, const LitBands& bands);

    /// Sets the exitance to what surfaces send on of the light that came, which it takes away.
    /// Remembers the exitance that was.
    /// @param is_direct  it came straight from the sources
    /// @returns flux that leaves surfaces, [column]
    [[nodiscard]] std::vector<double> scatter(bool is_direct);
    /// Sets the exitance to all that was remembered.
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
    void scatter_all(bool is_direct, std::vector<double>& scattered);
    void copy_to_coarse();
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
    [[nodiscard]] std::size_t side_count() const { return kept_.size() / columns_; }

    const PatchScene& scene_;
    std::size_t bands_, columns_;
    std::vector<CacheLine> lines_;
    std::vector<double> kept_;  // exitance of all steps, [side][column]
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
