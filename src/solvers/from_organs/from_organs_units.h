#pragma once

// What from_organs sums, and in which units.

#include <cstdint>
#include <vector>

#include "solvers/from_organs/lamp_near_field.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Points a block holds: of one organ, or of several if they have few each.
inline constexpr std::uint64_t kPointsPerBlock = 8192;
/// Steps of the fixed point are finer by this: weights of big organs are small (2^40 steps a unit).
inline constexpr double kFinerSteps = 4096;

/// The organs that points are placed on, and the area of all of them.
struct MeasuredArea {
    std::vector<std::uint32_t> organs;
    double area = 0;
};
[[nodiscard]] MeasuredArea measured_area(const Scene& scene);

/// From the flux of a light path to units of a region.
/// @param own_area  of the region's organ
[[nodiscard]] double units_of_light_path(const MeasuredArea& measured, double own_area);

/// By region, how much coarser its units are, a power of two; 1 for all but the smallest organs. A
/// light path brings an organ the more units the smaller it is: of as many as this all paths of a
/// block may meet one.
[[nodiscard]] std::vector<double> coarseness_of(const Scene& scene, const MeasuredArea& measured);

/// By region, the part of a unit that light of 1 brings: 1 over coarseness_of() where light
/// subpaths are needed, else 1.
[[nodiscard]] std::vector<double> parts_of_unit(
    const PreparedScene& prepared, const MeasuredArea& measured, const LampNearField& near);

/// An upper bound, by region, of the fraction of the light from the near field of lamps that
/// reaches the region's organ; 1 for organs so near that they sample none of it there, and for
/// organs that are not measured.
[[nodiscard]] std::vector<double> parts_by_vertices(
    const PreparedScene& prepared, const MeasuredArea& measured, const LampNearField& near);

/// By region, whether its points take light from vertices (VertexLight): those that hardly any
/// light path meets.
/// @param parts  parts_by_vertices()
[[nodiscard]] std::vector<char> connected_regions(
    const PreparedScene& prepared, const std::vector<double>& parts);

/// Whether points do not look for all light.
[[nodiscard]] bool needs_light_paths(const PreparedScene& prepared, const LampNearField& near);

}  // namespace quasimc
