#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/ids.h"
#include "base/orientation.h"
#include "detectors/detector_spec.h"
#include "geometry/mesh/cell.h"
#include "geometry/mesh/triangle.h"
#include "geometry/scene_geometry.h"
#include "optics/material.h"

namespace quasimc {

class OrganAreas;
template <typename T>
class Lazy;

/// A waveband. Amounts of different bands never mix, so each may have its own unit.
struct Band {
    std::string name;
    std::string unit = "W m-2";     ///< of irradiance
    double from_nm = 0, to_nm = 0;  ///< wavelengths; 0: those that the name stands for, if any
    friend bool operator==(const Band&, const Band&) = default;
};

/// What a person wants to find again in the results: plant=3, kind=leaf, any key.
using Labels = std::vector<std::pair<std::string, std::string>>;

/// What light is reported for: a leaf, an internode, the ground.
struct Organ {
    std::int64_t id = 0;  ///< the user's, unique in the scene
    std::string name;
    Labels labels;
    bool is_ground = false;
    /// Whether its light is asked for. Tracing from organs computes the others' as NaN; tracing
    /// from sources gets them for nothing.
    bool measured = true;
    /// Of a sensor: cosine of the largest angle from the normal at which light is counted.
    double least_cosine = 0;
    /// One-sided, square scene units. 0 is allowed: nothing falls on the organ, its flux and
    /// densities are 0.
    double area = 0;
    std::uint32_t first_region = 0, region_count = 0;
    std::uint32_t first_triangle = 0, triangle_count = 0;
};

/// The part of an organ that is of one material; its triangles stand together.
struct Region {
    OrganIndex organ;
    MaterialId material;
    double area = 0;
};

/// Something that is allowed but probably not meant.
struct Warning {
    std::string place, text;
};

/// A scene that has passed every check. Coordinates are in the scene's unit with z up (see
/// orientation). Organs stand in the order they were added, the ground, if any, last.
class Scene {
  public:
    [[nodiscard]] const std::vector<Band>& bands() const { return bands_; }
    [[nodiscard]] const std::vector<Organ>& organs() const { return organs_; }
    [[nodiscard]] const std::vector<Region>& regions() const { return regions_; }
    [[nodiscard]] const std::vector<Material>& materials() const { return materials_; }
    /// The triangles of an organ stand together, those of its first region first. Organs that
    /// are made of instances come after all others.
    [[nodiscard]] const SceneGeometry& triangles() const { return *geometry_; }
    /// The same, for who keeps them longer than the scene. Copies of a scene share them.
    [[nodiscard]] std::shared_ptr<const SceneGeometry> shared_triangles() const {
        return geometry_;
    }
    /// The region of each triangle that belongs to no instance, and of each instance.
    [[nodiscard]] const std::vector<RegionIndex>& triangle_regions() const {
        return triangle_regions_;
    }
    [[nodiscard]] const std::vector<RegionIndex>& instance_regions() const {
        return instance_regions_;
    }
    /// The region of a triangle.
    [[nodiscard]] RegionIndex region_of(std::uint32_t triangle) const {
        return triangle < triangle_regions_.size()
                   ? triangle_regions_[triangle]
                   : instance_regions_[geometry_->ranges().find(triangle)];
    }
    [[nodiscard]] const Material& material(const Region& e) const {
        return materials_[e.material.value];
    }
    /// The areas of the triangles of each organ, made when they are first asked for. Copies of a
    /// scene share them.
    [[nodiscard]] const OrganAreas& organ_areas() const;
    /// What light is sorted by beside the organs. Every specification has a name and no fault.
    [[nodiscard]] const std::vector<DetectorSpec>& detectors() const { return detectors_; }
    [[nodiscard]] const Cell& cell() const { return cell_; }
    [[nodiscard]] const Bounds& bounds() const { return bounds_; }
    [[nodiscard]] const Orientation& orientation() const { return orientation_; }
    /// The unit of length, as a name for headers ("m").
    [[nodiscard]] const std::string& length_unit() const { return length_unit_; }

  private:
    friend class SceneBuilder;
    Scene() = default;

    std::vector<Band> bands_;
    std::vector<Organ> organs_;
    std::vector<Region> regions_;
    std::vector<Material> materials_;
    std::shared_ptr<const SceneGeometry> geometry_ = std::make_shared<const SceneGeometry>();
    std::shared_ptr<const Lazy<OrganAreas>> areas_;
    std::vector<RegionIndex> triangle_regions_, instance_regions_;
    std::vector<DetectorSpec> detectors_;
    Cell cell_;
    Bounds bounds_;
    Orientation orientation_;
    std::string length_unit_ = "m";
};

}  // namespace quasimc
