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

/// The specification of a detector. `quasimc list detectors` lists the types and their parameters.
struct DetectorSpec {
    std::string type;       ///< "escaped_by_zenith"
    std::string name = {};  ///< unique among the detectors of a scene; default: the type
    /// Numbers by the names of the type's parameters; omitted ones have their defaults.
    std::map<std::string, double, std::less<>> parameters = {};
    std::string where = {};  ///< its location, for messages; default: its name
};

/// The kind of a parameter's numbers.
enum class NumberKind { real, whole };

/// A parameter of a type of detector: a key in `[[detector]]`.
struct DetectorParameter {
    std::string_view name;
    std::string_view summary;  ///< a few words for the manual
    NumberKind kind = NumberKind::real;
    double low = 0, high = 0;          ///< its domain, ends included
    std::optional<double> usual = {};  ///< its default; none: it must be given
};

/// A typed index, which can't be confused with another kind of index. `value` counts from 0.
template <typename Tag>
struct Id {
    std::uint32_t value = 0;
    friend constexpr bool operator==(Id, Id) = default;
    friend constexpr auto operator<=>(Id, Id) = default;
};

using MaterialId = Id<struct MaterialTag>;
using OrganIndex =
    Id<struct OrganTag>;  ///< index in the scene's list; ids of organs are given by users
using RegionIndex = Id<struct ElementTag>;  ///< a part of an organ with a single material

struct SceneData;    // src/scene/scene.h
struct BuilderData;  // src/scene/build_scene.h

/// A waveband. Amounts of different bands never mix, so each may have its own unit.
struct Band {
    std::string name;
    std::string unit = "W m-2";     ///< irradiance unit
    double from_nm = 0, to_nm = 0;  ///< wavelengths; 0: those of the name, if known
    friend bool operator==(const Band&, const Band&) = default;
};

/// Labels of an organ in the results: plant=3, kind=leaf, any key.
using Labels = std::vector<std::pair<std::string, std::string>>;
/// The value of a label, or null.
[[nodiscard]] const std::string* find_label(const Labels& labels, std::string_view key);

/// Labels shared by many organs, such as the leaves of a plant.
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

/// A unit for which light is reported: a leaf, an internode, the ground.
struct Organ {
    std::int64_t id = 0;  ///< given by the user, unique in the scene
    std::string name;
    SharedLabels labels;
    bool is_ground = false;
    /// Whether its light is requested. Results of other organs are NaN with paths from organs;
    /// other methods compute them at no cost.
    bool measured = true;
    /// For a sensor: cosine of the largest angle from the normal at which light counts.
    double least_cosine = 0;
    /// One-sided, square scene units. 0 is allowed: the organ receives no light, its flux and
    /// densities are 0.
    double area = 0;
    /// Area of its coplanar overlaps with previous organs, or with other triangles of this one,
    /// which receives no light on either side.
    double covered_area = 0;
    std::uint32_t first_region = 0, region_count = 0;
    std::uint32_t first_triangle = 0, triangle_count = 0;
};

/// The part of an organ with a single material; its triangles are contiguous.
struct Region {
    OrganIndex organ;
    MaterialId material;
    double area = 0;
};

/// The weight of light at a sensor by its direction.
enum class Receiver {
    cosine,  ///< the cosine of its angle from the normal of either side: irradiance
    sphere,  ///< equal for all directions: fluence rate, all of it on the upper side
};

/// A position at which light is measured.
struct SensorPoint {
    std::string name = {};  ///< default: that of the set, with its number in it
    Labels labels = {};
    Vec3 position = {};
    Vec3 facing = {};  ///< normal of the upper side, any length; 0: up
};

/// Sensors that are given together: a point, a line, an array or a list. They shade nothing and
/// change no other number. Outside a periodic cell they see what their images in it do.
struct SensorSet {
    std::string name;                      ///< unique among the sets of a scene
    std::vector<SensorPoint> points = {};  ///< at least one; the file's axes
    /// Numbers of points along both directions of an array, whose first one varies fastest; 0: a
    /// list.
    std::array<std::size_t, 2> counts = {0, 0};
    Receiver receiver = Receiver::cosine;
    /// Half angle, degrees from the normal of either side, within which light counts; above 0, at
    /// most 90. A sphere has none.
    double field_of_view_deg = 90;
    double radius = 0;         ///< radius of the disk about each point
    bool is_averaged = false;  ///< one result: the mean of all points
    std::string where = {};    ///< its location, for messages; default: its name

    /// The number of results.
    [[nodiscard]] std::size_t rows() const { return is_averaged ? 1 : points.size(); }
};

/// The bands and organs of a scene, accessed by index, id or name. A scene and the results of its
/// runs share it.
class SceneNames {
  public:
    SceneNames(std::vector<Band> bands, std::vector<Organ> organs);
    ~SceneNames();
    SceneNames(const SceneNames&) = delete;
    SceneNames& operator=(const SceneNames&) = delete;

    [[nodiscard]] const std::vector<Band>& bands() const { return bands_; }
    /// The organs in the order of the scene, the ground, if any, last.
    [[nodiscard]] const std::vector<Organ>& organs() const { return organs_; }
    /// Returns the index of the organ with an id, if there is one. The first call takes time
    /// proportional to the organs, further calls take constant time.
    [[nodiscard]] std::optional<std::size_t> find_organ(std::int64_t id) const;
    /// Returns the index of the organ with an id.
    /// @throws InputError  if there is none
    [[nodiscard]] std::size_t organ_index(std::int64_t id) const;
    /// Returns the index of the organ with a name.
    /// @throws InputError  if there is none, with similar names, or if there are several
    [[nodiscard]] std::size_t organ_index(std::string_view name) const;
    /// Returns the index of the band with a name.
    /// @throws InputError  if there is none, with a list of the bands
    [[nodiscard]] std::size_t band_index(std::string_view name) const;

  private:
    struct Lookup;
    struct LazyLookup;
    [[nodiscard]] const Lookup& lookup() const;

    std::vector<Band> bands_;
    std::vector<Organ> organs_;
    std::unique_ptr<const LazyLookup> lookup_;
};

/// A scene that has passed every check. Copies share large data. Coordinates are in the scene's
/// unit with z up (see orientation). Organs are in the order in which they were added, the ground,
/// if any, is last.
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
    /// Names of materials in the order in which they were added; MaterialId is the index.
    [[nodiscard]] std::vector<std::string> material_names() const;
    /// Detectors of light other than organs. Every specification has a name and no errors.
    [[nodiscard]] const std::vector<DetectorSpec>& detectors() const { return detectors_; }
    /// Sensors, which are no organs: every point has a name and a facing of length 1.
    [[nodiscard]] const std::vector<SensorSet>& sensors() const { return *sensors_; }
    /// The name of a region's material.
    [[nodiscard]] const std::string& material_name(const Region& region) const;
    /// The triangles of an organ, z up; without coplanar overlaps with previous organs.
    [[nodiscard]] std::vector<Triangle> triangles_of(const Organ& organ) const;

  private:
    friend struct SceneAccess;  // src/scene/scene.h
    Scene() = default;

    std::shared_ptr<const SceneNames> names_;
    std::shared_ptr<const SceneData> data_;  // materials and triangles
    std::vector<Region> regions_;
    std::vector<DetectorSpec> detectors_;
    std::shared_ptr<const std::vector<SensorSet>> sensors_;  // not null
    Cell cell_;
    Bounds bounds_;
    Orientation orientation_;
    std::string length_unit_ = "m";
};

/// Triangles of one material, which may be added before or after them.
struct OrganPart {
    std::string material;
    /// The file's axes: up and north as its Orientation says.
    Mesh triangles = {};
    /// An instance instead of triangles: a shared mesh and its transform. Many instances of one
    /// mesh take little more memory than one.
    std::shared_ptr<const Mesh> shared = {};
    Affine transform = {};
};

/// The specification of an organ.
struct OrganSpec {
    std::optional<std::int64_t> id = {};  ///< default: one more than the largest id so far, from 1
    std::string name = {};                ///< default: "organ <id>"
    Labels labels = {};
    std::vector<OrganPart> parts = {};
    /// Whether its light is requested (Organ::measured).
    bool measured = true;
    /// Half angle, degrees from the normal of either side, within which light counts; 0 to 90. Less
    /// than 90 is for sensors: organs of transparent materials only.
    double field_of_view_deg = 90;
    /// Its location, for messages ("leaves.toml:12"); default: its name.
    std::string where = {};
};

/// The ground. Without triangles it is a horizontal rectangle: the cell's along a periodic axis,
/// else that of `extent`, else (none given) the one under the organs. Its id is the next one after
/// those of the organs.
struct GroundSpec {
    std::string material;
    double height = 0;  ///< height of a horizontal ground
    /// Low x, low y, high x, high y: horizontal axes, z up. Along a periodic axis it must be the
    /// cell's.
    std::optional<std::array<double, 4>> extent = {};
    Mesh triangles = {};  ///< a given surface instead, the file's axes
    std::string name = "ground";
    std::string where = "ground";
    bool measured = true;  ///< Organ::measured
};

/// Builds and checks a scene. Nothing is repaired silently; all errors are reported at once.
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
    /// Several materials of one name are an error. @param where  for messages; default: the name
    void add_material(MaterialSpec material, std::string where = {});
    void add_organ(OrganSpec organ);
    void set_ground(GroundSpec ground);
    void add_detector(DetectorSpec detector);
    void add_sensors(SensorSet sensors);
    /// Periods along the two horizontal axes, z up.
    void set_cell(const Cell& cell);
    /// The ids that the organs added so far will have, in their order.
    [[nodiscard]] std::vector<std::int64_t> organ_ids() const;
    /// Throws an InputError with every error in organs, independent of the other content of the
    /// scene: unknown materials, no triangles, coordinates that are not finite or too large.
    void check_organs(const std::vector<OrganSpec>& organs) const;

    /// Returns the scene, or throws an InputError with every error: neither organ nor ground;
    /// bands, materials or ids that are not unique; unknown or faulty materials; organs without
    /// triangles; coordinates that are not finite or beyond 1e30; a scene of size 0; a ground that
    /// does not fit; a periodic cell that is not positive, or too small for the organs; a north
    /// that is not horizontal; detectors of unknown types, or with unknown parameters; sensors
    /// without a position, or with the name of others. Triangles and organs without area are
    /// allowed: they receive no light (see lint). Takes time and memory proportional to the
    /// triangles. The builder remains usable.
    [[nodiscard]] Scene build() const&;
    /// Builds the scene without a copy of the triangles; the builder can't be used any more.
    [[nodiscard]] Scene build() &&;

  private:
    friend struct SceneAccess;
    std::unique_ptr<BuilderData> data_;
};

/// Warns of probable mistakes: duplicate triangles, coplanar overlaps, triangles without area,
/// organs (partly) below the ground, materials that are black in every band by default, sizes that
/// suggest wrong units, ground smaller than the canopy. Lists at most a few warnings of each kind,
/// and counts the others.
[[nodiscard]] std::vector<Warning> lint(const Scene& scene);

}  // namespace quasimc
