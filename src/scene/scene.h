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
#include "geometry/mesh/cell.h"
#include "geometry/mesh/triangle.h"
#include "optics/material.h"

namespace quasimc {

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
    /// Triangles of organ 0, organ 1, ...; within an organ those of its first element first.
    [[nodiscard]] const std::vector<Triangle>& triangles() const { return *triangles_; }
    /// The same, for who keeps them longer than the scene. Copies of a scene share them.
    [[nodiscard]] std::shared_ptr<const std::vector<Triangle>> shared_triangles() const {
        return triangles_;
    }
    /// The element of each triangle.
    [[nodiscard]] const std::vector<RegionIndex>& triangle_regions() const {
        return triangle_regions_;
    }
    [[nodiscard]] const Material& material(const Region& e) const {
        return materials_[e.material.value];
    }
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
    std::shared_ptr<std::vector<Triangle>> triangles_ = std::make_shared<std::vector<Triangle>>();
    std::vector<RegionIndex> triangle_regions_;
    Cell cell_;
    Bounds bounds_;
    Orientation orientation_;
    std::string length_unit_ = "m";
};

}  // namespace quasimc
