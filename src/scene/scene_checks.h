#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/mesh.h"
#include "quasimc/scene.h"
#include "scene/scene_draft.h"

namespace quasimc {

/// Largest valid coordinate: areas of triangles, and their squares, must stay finite.
inline constexpr double kLargestCoordinate = 1e30;

/// Faults of organs; only the first thousand are kept, to limit the memory.
class OrganFaults {
  public:
    explicit OrganFaults(Faults& faults) : faults_(faults) {}
    /// Adds a fault at the location of an organ of the draft.
    void add(const SceneDraft& draft, std::size_t organ, Fault fault);
    /// Adds one fault that counts the omitted ones, if any.
    void finish();

  private:
    Faults& faults_;
    std::size_t count_ = 0;
};

/// Location and name of an organ: "leaves.toml:12: organ 'leaf 7'".
[[nodiscard]] std::string location_of(const SceneDraft& draft, std::size_t organ);

/// Location and name of a material: "leaves.toml:3: material 'leaf'".
[[nodiscard]] std::string location_of(const MaterialSpec& material, const std::string& where);

/// Adds the faults of wavebands: none, no name, names that are not unique.
void check_bands(const std::vector<Band>& bands, Faults& faults);

/// Adds a fault for each organ whose field of view is not in (0, 90] degrees, or is below 90
/// degrees for an organ that is no sensor.
void check_fields_of_view(
    const SceneDraft& draft,
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    OrganFaults& faults);

/// Whether all light goes straight through a material, as through a sensor.
[[nodiscard]] bool passes_everything(const MaterialSpec& material);

/// Organ::least_cosine for a half angle.
[[nodiscard]] double least_cosine(double field_of_view_deg);

/// Adds a fault if north is not a horizontal direction.
void check_north(const Orientation& orientation, Faults& faults);

/// Adds the faults of a periodic cell's borders: sizes that are not positive, or tiny relative to
/// the organs. @param organs  bounds, z up
void check_cell(const Cell& cell, const Bounds& organs, Faults& faults);

/// Adds a fault if the organs, finite and z up, extend over too many cells to trace their periodic
/// copies, or too many copies of horizontal surfaces overlap. The cell must be valid. @param
/// organs  bounds
void check_images(const Cell& cell, const SceneDraft& draft, const Bounds& organs, Faults& faults);

/// Upper bound (exclusive) of organ ids.
inline constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();

/// The ids that number_organs() assigns.
[[nodiscard]] std::vector<std::int64_t> organ_ids(const SceneDraft& draft);

/// Gives an id and a name to each organ that has none; adds ids that are not unique to `faults`.
/// Returns the first free id.
std::int64_t number_organs(SceneDraft& draft, OrganFaults& faults);

/// Rotates all triangles to z up.
void turn_inward(SceneDraft& draft, const Orientation& orientation);

/// The bounds of the organs from `first` on. Adds a fault for each organ without triangles, or with
/// coordinates that are not finite or too large (the bounds then omit it).
[[nodiscard]] Bounds check_triangles(
    const SceneDraft& draft,
    std::size_t first,
    const Orientation& orientation,
    OrganFaults& faults);

/// Checks the materials, and returns the material of each name in the draft. A missing name gets
/// number 0 and a fault.
[[nodiscard]] std::vector<MaterialId> resolve_materials(
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    const SceneDraft& draft,
    std::size_t bands,
    Faults& faults);

}  // namespace quasimc
