#pragma once

// Scenes: organs made of triangles and materials, detectors, and the builder that checks them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/material.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A detector as a person states it. `quasimc list detectors` tells the types and what they take.
struct DetectorSpec {
    std::string type;       ///< "escaped_by_zenith"
    std::string name = {};  ///< unique among the detectors of a scene; default: the type
    /// By the names of the type's parameters; those left out have their usual values.
    std::map<std::string, double, std::less<>> parameters = {};
    std::string where = {};  ///< where it was stated, for messages; default: its name
};

/// What numbers a parameter takes.
enum class NumberKind { real, whole };

/// A number that a type of detector takes: a key in `[[detector]]`.
struct DetectorParameter {
    std::string_view name;
    std::string_view summary;  ///< a few words for the manual
    NumberKind kind = NumberKind::real;
    double low = 0, high = 0;          ///< its domain, ends included
    std::optional<double> usual = {};  ///< its value where none is stated; none: it must be stated
};

/// An index that can't be taken for another kind of index. `value` counts from 0.
template <typename Tag>
struct Id {
    std::uint32_t value = 0;
    friend constexpr bool operator==(Id, Id) = default;
    friend constexpr auto operator<=>(Id, Id) = default;
};

using MaterialId = Id<struct MaterialTag>;
using OrganIndex = Id<struct OrganTag>;  ///< index in the scene's list; an organ's id is the user's
using RegionIndex = Id<struct ElementTag>;  ///< a part of an organ that is of one material

struct SceneData;    // src/scene/scene.h
struct BuilderData;  // src/scene/build_scene.h

/// A waveband. Amounts of different bands never mix, so each may have its own unit.
struct Band {
    std::string name;
    std::string unit = "W m-2";     ///< of irradiance
    double from_nm = 0, to_nm = 0;  ///< wavelengths; 0: those that the name stands for, if any
    friend bool operator==(const Band&, const Band&) = default;
};

/// What a person wants to find again in the results: plant=3, kind=leaf, any key.
using Labels = std::vector<std::pair<std::string, std::string>>;

/// Labels that many organs have in common: of a stand's leaves those of a plant.
class SharedLabels {
  public:
    SharedLabels() = default;
    /// @param labels  not null
    explicit SharedLabels(std::shared_ptr<const Labels> labels) : labels_(std::move(labels)) {}

    // NOLINTNEXTLINE(google-explicit-constructor): they are labels, kept elsewhere.
    operator const Labels&() const { return labels_ ? *labels_ : none(); }
    [[nodiscard]] Labels::const_iterator begin() const { return get().begin(); }
    [[nodiscard]] Labels::const_iterator end() const { return get().end(); }
    [[nodiscard]] bool empty() const { return get().empty(); }
    [[nodiscard]] std::size_t size() const { return get().size(); }
    friend bool operator==(const SharedLabels& a, const SharedLabels& b) {
        return a.labels_ == b.labels_ || a.get() == b.get();
    }
    friend bool operator==(const SharedLabels& a, const Labels& b) { return a.get() == b; }

  private:
    [[nodiscard]] const Labels& get() const { return *this; }
    static const Labels& none();

    std::shared_ptr<const Labels> labels_;  // null: none
};

/// What light is reported for: a leaf, an internode, the ground.
struct Organ {
    std::int64_t id = 0;  ///< the user's, unique in the scene
    std::string name;
    SharedLabels labels;
    bool is_ground = false;
    /// Whether its light is asked for. Tracing from organs computes the others' as NaN; tracing
    /// from sources gets them for nothing.
    bool measured = true;
    /// Of a sensor: cosine of the largest angle from the normal at which light is counted.
    double least_cosine = 0;
    /// One-sided, square scene units. 0 is allowed: nothing falls on the organ, its flux and
    /// densities are 0.
    double area = 0;
    /// How much of that coincides with organs that come before, or with other triangles of this
    /// one: no light falls there, on either side.
    double covered_area = 0;
    std::uint32_t first_region = 0, region_count = 0;
    std::uint32_t first_triangle = 0, triangle_count = 0;
};

/// The part of an organ that is of one material; its triangles stand together.
struct Region {
    OrganIndex organ;
    MaterialId material;
    double area = 0;
};

/// The bands and organs of a scene, found by index, by id or by name. A scene and the results of
/// its runs share it.
class SceneNames {
  public:
    SceneNames(std::vector<Band> bands, std::vector<Organ> organs);
    ~SceneNames();
    SceneNames(const SceneNames&) = delete;
    SceneNames& operator=(const SceneNames&) = delete;

    [[nodiscard]] const std::vector<Band>& bands() const { return bands_; }
    /// The organs in the order of the scene, the ground, if any, last.
    [[nodiscard]] const std::vector<Organ>& organs() const { return organs_; }
    /// Returns the index of the organ with an id, if there is one. The first search takes time in
    /// proportion to the organs, the others take constant time.
    [[nodiscard]] std::optional<std::size_t> find_organ(std::int64_t id) const;
    /// Returns the index of the organ with an id.
    /// @throws InputError  if there is none
    [[nodiscard]] std::size_t organ_index(std::int64_t id) const;
    /// Returns the index of the organ with a name.
    /// @throws InputError  if there is none, with names that are near, or if there are several
    [[nodiscard]] std::size_t organ_index(std::string_view name) const;
    /// Returns the index of the band with a name.
    /// @throws InputError  if there is none, with the bands that there are
    [[nodiscard]] std::size_t band_index(std::string_view name) const;

  private:
    struct Lookup;
    struct LazyLookup;
    [[nodiscard]] const Lookup& lookup() const;

    std::vector<Band> bands_;
    std::vector<Organ> organs_;
    std::unique_ptr<const LazyLookup> lookup_;
};

/// A scene that has passed every check. Copies share what is large. Coordinates are in the scene's
/// unit with z up (see orientation). Organs stand in the order they were added, the ground, if any,
/// last.
class Scene {
  public:
    [[nodiscard]] const std::vector<Band>& bands() const { return names_->bands(); }
    [[nodiscard]] const std::vector<Organ>& organs() const { return names_->organs(); }
    /// Returns the bands and organs as a value that may outlive the scene.
    [[nodiscard]] const std::shared_ptr<const SceneNames>& names() const { return names_; }
    [[nodiscard]] const std::vector<Region>& regions() const { return regions_; }
    [[nodiscard]] const Cell& cell() const { return cell_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] const Orientation& orientation() const { return orientation_; }
    /// The unit of length, as a name for headers ("m").
    [[nodiscard]] const std::string& length_unit() const { return length_unit_; }
    [[nodiscard]] std::size_t triangle_count() const;
    /// In the order in which they were added; MaterialId counts them.
    [[nodiscard]] std::vector<std::string> material_names() const;
    /// What light is sorted by beside the organs. Every specification has a name and no fault.
    [[nodiscard]] const std::vector<DetectorSpec>& detectors() const { return detectors_; }
    /// The name of a region's material.
    [[nodiscard]] const std::string& material_name(const Region& region) const;
    /// The triangles of an organ, z up; without what coincides with organs that come before.
    [[nodiscard]] std::vector<Triangle> triangles_of(const Organ& organ) const;

  private:
    friend struct SceneAccess;  // src/scene/scene.h
    Scene() = default;

    std::shared_ptr<const SceneNames> names_;
    std::shared_ptr<const SceneData> data_;  // materials and triangles
    std::vector<Region> regions_;
    std::vector<DetectorSpec> detectors_;
    Cell cell_;
    Bounds bounds_;
    Orientation orientation_;
    std::string length_unit_ = "m";
};

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
    std::string where = {};
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
    std::string where = "ground";
};

/// Collects a scene and checks it whole. Nothing is repaired silently; every fault is reported at
/// once.
class SceneBuilder {
  public:
    /// @param bands  at least one; names unique and not empty
    explicit SceneBuilder(std::vector<Band> bands, Orientation orientation = {});
    SceneBuilder(const SceneBuilder& other);
    SceneBuilder(SceneBuilder&& other) noexcept;
    SceneBuilder& operator=(const SceneBuilder& other);
    SceneBuilder& operator=(SceneBuilder&& other) noexcept;
    ~SceneBuilder();

    void set_length_unit(std::string unit);
    /// Several materials of one name are a fault. @param where  for messages; default: the name
    void add_material(MaterialSpec material, std::string where = {});
    void add_organ(OrganSpec organ);
    void set_ground(GroundSpec ground);
    void add_detector(DetectorSpec detector);
    /// Periods along the two horizontal axes, z up.
    void set_cell(const Cell& cell);
    /// The ids that the organs added so far will have, in their order.
    [[nodiscard]] std::vector<std::int64_t> organ_ids() const;
    /// Throws an InputError with every fault that organs would bring with them, whatever else is in
    /// the scene: unknown materials, no triangles, coordinates that are not finite or too large.
    void check_organs(const std::vector<OrganSpec>& organs) const;

    /// Returns the scene, or throws an InputError with every fault: neither organ nor ground;
    /// bands, materials or ids that are not unique; unknown or faulty materials; organs without
    /// triangles; coordinates that are not finite or beyond 1e30; a scene of no size; a ground that
    /// does not fit; a periodic cell that is not positive, or so small that organs repeat without
    /// measure; a north that is not horizontal; detectors of unknown types, or with parameters that
    /// they do not take. Triangles and organs of no area are allowed: nothing falls on them (see
    /// lint). Takes time and memory in proportion to the triangles. The builder can be used on.
    [[nodiscard]] Scene build() const&;
    /// The same without a copy of the triangles; the builder can't be used any more.
    [[nodiscard]] Scene build() &&;

  private:
    friend struct SceneAccess;
    std::unique_ptr<BuilderData> data_;
};

/// What silently spoils results: duplicate triangles, coplanar triangles that overlap, triangles of
/// no area, organs (partly) below the ground, materials that are black in every band without having
/// been stated so, sizes that smell of wrong units, ground smaller than the canopy. At most a few
/// warnings of each kind, the rest counted.
[[nodiscard]] std::vector<Warning> lint(const Scene& scene);

}  // namespace quasimc
