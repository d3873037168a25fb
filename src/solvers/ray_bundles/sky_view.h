#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "raster/item_buffer.h"
#include "solvers/ray_bundles/line_statistics.h"
#include "transport/sky_directions.h"

namespace quasimc {

// How much of what the sides of regions see is the sky.
//
// Lines that meet nothing carry no scattered light to a side, and how many of them do so by chance
// is most of the noise of scattered light where surroundings are equally bright. The item buffers
// of direct skylight know that much better; so the light along lines is divided by the area of a
// side that they found to be surrounded, and multiplied by what it is according to the item
// buffers.

/// Areas of sides that see the sky, by 2 * region + side; empty where skies are not viewed.
using OpenAreas = std::vector<double>;

/// The weight of a direction, whatever the sky's radiance there: not more than a few times the
/// density with which skies draw it. @param travel  of the light
[[nodiscard]] double sky_weight(const SkyDirections& skies, const Vec3& travel);

/// Adds the areas of sides that are seen along a direction.
/// @param weight  of a pixel
void add_open_pixels(
    const PatchScene& scene, const ItemBuffer& image, double weight, OpenAreas& open);

/// Adds the ends of lines on the sky.
/// @param sides  of the patches that they leave last, [2 * patch + side]
/// @param weight  of each
void add_open_ends(
    const PatchScene& scene, std::span<const std::uint32_t> sides, double weight, OpenAreas& open);

/// The sides, by 2 * region + side, that are surrounded so much that a correction is of use.
/// @param lines  of a step other than the one that is corrected
[[nodiscard]] std::vector<bool> surrounded_sides(const LineStatistics& lines);

/// The factor for light that came along lines, by 2 * region + side.
/// @param pixels  open areas as item buffers have them
[[nodiscard]] std::vector<double> sky_view_corrections(
    const PatchScene& scene,
    const OpenAreas& pixels,
    const LineStatistics& lines,
    const std::vector<bool>& is_surrounded);

}  // namespace quasimc
