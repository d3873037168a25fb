#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/affine.h"
#include "base/input_error.h"
#include "geometry/mesh/mesh.h"
#include "scene/scene.h"
#include "scene/scene_draft.h"

namespace quasimc {

/// Triangles of one material. The material is named; it may be added before or after.
struct OrganPart {
    std::string material;
    /// The file's axes: up and north as its Orientation says.
    Mesh triangles = {};
    /// Instead of triangles: a mesh that other parts have too, and where this copy of it stands.
    /// Many copies of one mesh cost little more memory than one.
    std::shared_ptr<const Mesh> shared = {};
    Affine transform = {};
};

/// An organ as it is given to the builder.
struct OrganSpec {
    std::optional<std::int64_t> id = {};  ///< default: one more than the largest id so far, from 1
    std::string name = {};                ///< default: "organ <id>"
    Labels labels = {};
    std::vector<OrganPart> parts = {};
    /// Whether its light is asked for (Organ::measured).
    bool measured = true;
    /// Half angle, degrees from the normal of either side, within which light is counted; 0 to 90.
    /// Less than 90 is for sensors: organs of transparent materials only.
    double field_of_view_deg = 90;
    /// Where it was stated, for messages ("leaves.toml:12"); default: its name.
    std::string place = {};
};

/// The ground. Without triangles it is a horizontal rectangle: the cell's along a periodic axis,
/// else that of `extent`, else (none given) the one under the organs. It takes the first id after
/// those of the organs.
struct GroundSpec {
    std::string material;
    double height = 0;  ///< of a horizontal ground
    /// Low x, low y, high x, high y: horizontal axes, z up. Along a periodic axis it must be the
    /// cell's.
    std::optional<std::array<double, 4>> extent = {};
    Mesh triangles = {};  ///< a given surface instead, the file's axes
    std::string name = "ground";
    std::string place = "ground";
};

/// How often a mesh must be used, and how many triangles it must have, to be kept once for all its
/// copies (OrganPart::shared). Copies of others are stored like any triangles, which is faster to
/// trace.
inline constexpr std::size_t kFewestCopies = 3;
inline constexpr std::size_t kSmallestPrototype = 64;

/// Collects a scene and checks it whole. Nothing is repaired silently; every fault is reported at
/// once.
class SceneBuilder {
  public:
    /// @param bands  at least one; names unique and not empty
    explicit SceneBuilder(std::vector<Band> bands, Orientation orientation = {});

    void set_length_unit(std::string unit);
    /// Several materials of one name are a fault. @param place  for messages; default: the name
    void add_material(MaterialSpec material, std::string place = {});
    void add_organ(OrganSpec organ);
    void set_ground(GroundSpec ground);
    void add_detector(DetectorSpec detector);
    /// Periods along the two horizontal axes, z up.
    void set_cell(const Cell& cell);

    /// The scene, or an InputError with every fault: neither organ nor ground; bands, materials or
    /// ids that are not unique; unknown or faulty materials; organs without triangles; coordinates
    /// that are not finite or beyond 1e30; a scene of no size; a ground that does not fit; a
    /// periodic cell that is not positive, or so small that organs repeat without measure; a north
    /// that is not horizontal; detectors as check_detectors() says. Triangles and organs of no area
    /// are allowed: nothing falls on them (see lint). May be called once; takes time and memory in
    /// proportion to the triangles.
    [[nodiscard]] Scene build() &&;

  private:
    std::vector<Band> bands_;
    Orientation orientation_;
    std::string length_unit_ = "m";
    std::vector<std::pair<MaterialSpec, std::string>> materials_;
    SceneDraft draft_;
    std::optional<GroundSpec> ground_;
    std::vector<DetectorSpec> detectors_;
    Cell cell_;
};

/// What silently spoils results: duplicate triangles, coplanar triangles that overlap, triangles of
/// no area, organs (partly) below the ground, materials that are black in every band without having
/// been stated so, sizes that smell of wrong units, ground smaller than the canopy. At most a few
/// warnings of each kind, the rest counted.
[[nodiscard]] std::vector<Warning> lint(const Scene& scene);

}  // namespace quasimc
