#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/item_buffer.h"
#include "solvers/ray_bundles/line_statistics.h"
#include "transport/sky_directions.h"

namespace quasimc {

// Sky view of the sides of regions.
//
// Lines that reach the sky deliver no scattered light to a side, and their random number has most
// of the noise of scattered light in surroundings of uniform brightness. The item buffers of direct
// skylight give the open area more precisely. So light along lines is divided by the surrounded
// area of the side according to these lines, and multiplied by that according to the item buffers.

/// Areas of sides that see the sky, by 2 * region + side; empty where skies are not viewed.
using OpenAreas = std::vector<double>;

/// The weight of a direction, regardless of the sky's radiance there: 1, or less for directions
/// that skies sample with a much lower than uniform density. @param travel  of the light
[[nodiscard]] double sky_weight(const SkyDirections& skies, const Vec3& travel);

/// Adds the areas of sides that a view along a direction shows.
/// @param weight  of a pixel
void add_open_pixels(
    const PatchScene& scene, const ItemBuffer& image, double weight, OpenAreas& open);

/// Adds the ends of lines on the sky.
/// @param sides  sides of patches that lines leave last, [2 * patch + side]
/// @param weight  of each
void add_open_ends(
    const PatchScene& scene, std::span<const std::uint32_t> sides, double weight, OpenAreas& open);

/// The sides, by 2 * region + side, that are surrounded enough for a useful correction.
/// @param lines  of a step other than the one that is corrected
[[nodiscard]] std::vector<bool> surrounded_sides(const LineStatistics& lines);

/// The factor for light that came along lines, by 2 * region + side.
/// @param pixels  open areas according to item buffers
[[nodiscard]] std::vector<double> sky_view_corrections(
    const PatchScene& scene,
    const OpenAreas& pixels,
    const LineStatistics& lines,
    const std::vector<bool>& is_surrounded);

}  // namespace quasimc
