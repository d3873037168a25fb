#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/ids.h"
#include "base/input_error.h"
#include "scene/scene_builder.h"

namespace quasimc {

/// Coordinates beyond this are faults: areas of such triangles, and their squares, must stay
/// finite.
inline constexpr double kLargestCoordinate = 1e30;

/// Faults of organs. A file of ten million faulty organs must not fill the memory with words, so
/// only the first thousand are kept.
class OrganFaults {
  public:
    explicit OrganFaults(Faults& faults) : faults_(faults) {}
    /// Adds a fault at the place of `organ`.
    void add(const OrganSpec& organ, Fault fault);
    /// Adds one fault that counts those left out, if any.
    void finish();

  private:
    Faults& faults_;
    std::size_t count_ = 0;
};

/// Where an organ was stated, and which it is: "leaves.toml:12: organ 'leaf 7'".
[[nodiscard]] std::string place_of(const OrganSpec& organ);

/// Where a material was stated, and which it is: "leaves.toml:3: material 'leaf'".
[[nodiscard]] std::string place_of(const MaterialSpec& material, const std::string& place);

/// Adds the faults of wavebands: none, no name, names that are not unique.
void check_bands(const std::vector<Band>& bands, Faults& faults);

/// Adds a fault for each organ whose field of view is no angle up to 90 degrees, or narrower though
/// it is made of more than transparent materials.
void check_fields_of_view(
    std::span<const OrganSpec> organs,
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    OrganFaults& faults);

/// Organ::least_cosine of a half angle.
[[nodiscard]] double least_cosine(double field_of_view_deg);

/// Adds a fault if north is not a horizontal direction.
void check_north(const Orientation& orientation, Faults& faults);

/// Adds the faults of a periodic cell's borders: sizes that are not positive, or next to nothing
/// beside the organs.
/// @param organs  their bounds, z up
void check_cell(const Cell& cell, const Bounds& organs, Faults& faults);

/// Adds a fault if the organs, finite and z up, reach over so many cells that tracing would drown
/// in images. The cell has no fault.
void check_images(const Cell& cell, std::span<const OrganSpec> organs, Faults& faults);

/// Gives an id and a name to each organ that has none; adds ids that are not unique to `faults`.
/// Returns the first free id.
std::int64_t number_organs(std::vector<OrganSpec>& organs, OrganFaults& faults);

/// Turns the triangles of an organ to z up and returns their bounds; adds a fault if it has no
/// triangles, or coordinates that are not finite or too large (the bounds are then empty).
[[nodiscard]] Bounds take_inward(
    OrganSpec& organ, const Orientation& orientation, OrganFaults& faults);

/// Checks the materials, and returns those that the parts of all organs name, in order. A part
/// whose material is missing gets number 0, and a fault.
[[nodiscard]] std::vector<MaterialId> resolve_materials(
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    std::span<const OrganSpec> organs,
    std::size_t bands,
    Faults& faults);

}  // namespace quasimc
