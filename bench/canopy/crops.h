#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "quasimc/run.h"
#include "scene/scene.h"

namespace quasimc::bench {

/// Canopies as people bring them, made by code alone, the same on every machine: two bands (PAR and
/// NIR), metres. tests/statistical compares all methods on small ones.
enum class Crop {
    maize,       ///< a plot of plants in rows over soil; every leaf a bent strip
    tree,        ///< a crown whose leaves stand in tufts and pass through each other
    greenhouse,  ///< rows of plants below lamps, over a bright floor
    row_crop,    ///< a few plants in a cell that repeats along x and y, over soil
    solid_tree,  ///< such a tree that is a single organ, as a file without groups gives it
    bad_faces,   ///< flowers of an OBJ file: faces that cross, are bow-ties, or have no area
};
inline constexpr std::array kCrops{Crop::maize,    Crop::tree,       Crop::greenhouse,
                                   Crop::row_crop, Crop::solid_tree, Crop::bad_faces};

[[nodiscard]] std::string name_of(Crop crop);

/// Triangles of the canopies at full size.
[[nodiscard]] std::uint32_t full_size(Crop crop);

/// @param triangles  about so many (fewer plants, smaller leaves for the crown), at least one plant
[[nodiscard]] Scene make_crop(Crop crop, std::uint32_t triangles);

/// What shines on a canopy.
struct CropLight {
    std::string name;
    Sources sources;
};

/// Suns at 90, 30, 5, 1, .1 and .02 degrees of elevation, each as its own light, and a sky.
[[nodiscard]] std::vector<CropLight> suns_and_sky();
/// Those and, in the greenhouse, its lamps alone and with the sun of 30 degrees.
[[nodiscard]] std::vector<CropLight> lights_of(Crop crop);

/// The text of an OBJ file of such flowers, some of whose faces are faulty.
[[nodiscard]] std::string flowers_with_bad_faces(std::uint32_t flowers);

}  // namespace quasimc::bench
