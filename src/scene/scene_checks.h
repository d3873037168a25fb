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

/// Coordinates beyond this are faults: areas of such triangles, and their squares, must stay
/// finite.
inline constexpr double kLargestCoordinate = 1e30;

/// Faults of organs. A file of ten million faulty organs must not fill the memory with words, so
/// only the first thousand are kept.
class OrganFaults {
  public:
    explicit OrganFaults(Faults& faults) : faults_(faults) {}
    /// Adds a fault at the location of an organ of the draft.
    void add(const SceneDraft& draft, std::size_t organ, Fault fault);
    /// Adds one fault that counts those left out, if any.
    void finish();

  private:
    Faults& faults_;
    std::size_t count_ = 0;
};

/// Where an organ was stated, and which it is: "leaves.toml:12: organ 'leaf 7'".
[[nodiscard]] std::string location_of(const SceneDraft& draft, std::size_t organ);

/// Where a material was stated, and which it is: "leaves.toml:3: material 'leaf'".
[[nodiscard]] std::string location_of(const MaterialSpec& material, const std::string& where);

/// Adds the faults of wavebands: none, no name, names that are not unique.
void check_bands(const std::vector<Band>& bands, Faults& faults);

/// Adds a fault for each organ whose field of view is no angle up to 90 degrees, or narrower though
/// it is made of more than transparent materials.
void check_fields_of_view(
    const SceneDraft& draft,
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    OrganFaults& faults);

/// Whether all light goes straight through a material, as through a sensor.
[[nodiscard]] bool passes_everything(const MaterialSpec& material);

/// Organ::least_cosine of a half angle.
[[nodiscard]] double least_cosine(double field_of_view_deg);

/// Adds a fault if north is not a horizontal direction.
void check_north(const Orientation& orientation, Faults& faults);

/// Adds the faults of a periodic cell's borders: sizes that are not positive, or next to nothing
/// beside the organs.
/// @param organs  their bounds, z up
void check_cell(const Cell& cell, const Bounds& organs, Faults& faults);

/// Adds a fault if the organs, finite and z up, reach over so many cells that tracing would drown
/// in images, or so many images of horizontal surfaces lie on each other that cutting them would
/// not end. The cell has no fault.
/// @param organs  their bounds
void check_images(const Cell& cell, const SceneDraft& draft, const Bounds& organs, Faults& faults);

/// Ids of organs are less than this.
inline constexpr std::int64_t kLastId = std::numeric_limits<std::int64_t>::max();

/// The ids that number_organs gives.
[[nodiscard]] std::vector<std::int64_t> organ_ids(const SceneDraft& draft);

/// Gives an id and a name to each organ that has none; adds ids that are not unique to `faults`.
/// Returns the first free id.
std::int64_t number_organs(SceneDraft& draft, OrganFaults& faults);

/// Turns all triangles to z up.
void turn_inward(SceneDraft& draft, const Orientation& orientation);

/// The bounds of the organs from `first` on; adds a fault for each that has no triangles, or
/// coordinates that are not finite or too large (it is then left out of the bounds).
[[nodiscard]] Bounds check_triangles(
    const SceneDraft& draft,
    std::size_t first,
    const Orientation& orientation,
    OrganFaults& faults);

/// Checks the materials, and returns those that the names of the draft stand for. A name that is
/// missing gets number 0, and a fault.
[[nodiscard]] std::vector<MaterialId> resolve_materials(
    std::span<const std::pair<MaterialSpec, std::string>> materials,
    const SceneDraft& draft,
    std::size_t bands,
    Faults& faults);

}  // namespace quasimc
