#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "base/lazy.h"
#include "geometry/mesh/cell.h"
#include "geometry/scene_geometry.h"
#include "optics/material.h"
#include "quasimc/scene.h"

namespace quasimc {

class KnownOverlaps;
class OrganAreas;
struct Coincidences;
struct SensorOrgans;  // scene/sensors.h

/// The internal part of a scene, which its copies share.
struct SceneData {
    std::vector<Material> materials;  ///< by MaterialId
    /// The triangles of an organ are contiguous, those of its first region first. Organs that are
    /// made of instances come after all others.
    std::shared_ptr<const SceneGeometry> geometry;
    /// The region of each triangle that belongs to no instance.
    std::shared_ptr<const std::vector<RegionIndex>> triangle_regions;
    std::vector<RegionIndex> instance_regions;  ///< the region of each instance
    /// The coplanar overlaps that were cut away.
    std::shared_ptr<const Coincidences> coincidences;
    std::shared_ptr<const Lazy<OrganAreas>> areas;
    std::shared_ptr<const SensorOrgans> sensors = {};  ///< set by scene_with_sensors(), else null

    [[nodiscard]] const Material& material(const Region& region) const {
        return materials[region.material.value];
    }
    [[nodiscard]] const SceneGeometry& triangles() const { return *geometry; }
    /// Returns the region of a triangle.
    [[nodiscard]] RegionIndex region_of(std::uint32_t triangle) const;
};

/// Gives the engine access to the private parts of scenes and their builders: build_scene.h,
/// repeat_bands.h, sensors.h.
struct SceneAccess {
    static const SceneData& data(const Scene& scene) { return *scene.data_; }
    static const BuilderData& data(const SceneBuilder& builder) { return *builder.data_; }
    static BuilderData& data(SceneBuilder& builder) { return *builder.data_; }
    static Scene build(BuilderData given, KnownOverlaps* known);
    static Scene build_on(const BuilderData& given, const Scene& scene);
    static Scene with_repeated_bands(const Scene& scene, std::size_t times);
    static Scene with_sensors(const Scene& scene);
    static Scene with_other_sensors(const Scene& scene, std::vector<SensorSet> sensors);
    static Scene of_sensors(const Scene& scene);

  private:
    static Scene assembled(
        BuilderData given,
        const std::vector<MaterialId>& materials,
        const Bounds& bounds,
        KnownOverlaps* known);
};

[[nodiscard]] inline const SceneData& data_of(const Scene& scene) {
    return SceneAccess::data(scene);
}

/// Whether the ray caster of a scene, in single precision, resolves a disk about a point (z up): it
/// is finite, and within a million radii of the scene.
[[nodiscard]] bool is_in_reach(const Scene& scene, const Vec3& center, double radius = 0);
inline constexpr const char* kReachRule = "it must be within a million times the size of the scene";

/// Whether an organ uses each material, by MaterialId. Unused materials must not change results.
[[nodiscard]] std::vector<bool> used_materials(const Scene& scene);

/// Per band, the largest albedo in [0, 1] of a surface in use that is no sensor.
[[nodiscard]] std::vector<double> largest_albedos(const Scene& scene);

}  // namespace quasimc
