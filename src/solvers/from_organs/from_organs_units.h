#pragma once

// The quantities that from_organs sums, and their units.

#include <cstdint>
#include <vector>

#include "solvers/from_organs/lamp_near_field.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Points per block: of one organ, or of several with few points each.
inline constexpr std::uint64_t kPointsPerBlock = 8192;
/// Quanta of the fixed point are finer by this factor: weights of large organs are small (2^40
/// quanta a unit).
inline constexpr double kFinerQuanta = 4096;

/// The organs that points are placed on, and the area of all of them.
struct MeasuredArea {
    std::vector<std::uint32_t> organs;
    double area = 0;
};
[[nodiscard]] MeasuredArea measured_area(const Scene& scene);

/// Factor from the flux of a light path to units of a region.
/// @param own_area  of the region's organ
[[nodiscard]] double units_of_light_path(const MeasuredArea& measured, double own_area);

/// By region, the factor by which its units are coarser, a power of two; 1 for all but the smallest
/// organs. The smaller an organ, the more units a light path contributes. With coarser units, all
/// paths of a block may hit the same organ.
[[nodiscard]] std::vector<double> coarseness_of(const Scene& scene, const MeasuredArea& measured);

/// By region, the units per light of 1: 1 over coarseness_of() if light subpaths are needed, else
/// 1.
[[nodiscard]] std::vector<double> parts_of_unit(
    const PreparedScene& prepared, const MeasuredArea& measured, const LampNearField& near);

/// An upper bound, by region, of the fraction of the light from the near field of lamps that
/// reaches the region's organ; 1 for organs so near that they sample none of it there, and for
/// organs that are not measured.
[[nodiscard]] std::vector<double> parts_by_vertices(
    const PreparedScene& prepared, const MeasuredArea& measured, const LampNearField& near);

/// By region, whether its points are connected with light vertices (VertexLight): regions that
/// hardly any light subpath hits.
/// @param parts  parts_by_vertices()
[[nodiscard]] std::vector<char> connected_regions(
    const PreparedScene& prepared, const std::vector<double>& parts);

/// Whether light subpaths are needed, as points do not sample all light.
[[nodiscard]] bool needs_light_paths(const PreparedScene& prepared, const LampNearField& near);

}  // namespace quasimc
