// The scenes by which the light on sensors is computed and read.

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <utility>

#include "base/lazy.h"
#include "optics/material.h"
#include "scene/organ_areas.h"
#include "scene/scene_checks.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// The material of sensors: light passes it.
Material transparent_material(std::size_t bands) {
    SideOptics optics;
    optics.transmittance = 1;
    optics.transmission_model = "mirror";
    MaterialSpec spec;
    spec.name = "sensor";
    spec.upper.assign(bands, optics);
    spec.lower.assign(bands, optics);
    return make_material(spec, bands);
}

/// The organs of the results of sensors, each with a region from `first_region` on.
/// @param first  index of the first organ
std::vector<Organ> organs_of_sensors(const Scene& scene, std::size_t first_region, double area) {
    std::vector<Organ> organs;
    for (const SensorSet& set : scene.sensors()) {
        const bool is_sphere = set.receiver == Receiver::sphere;
        for (std::size_t i = 0; i < set.rows(); ++i) {
            Organ& organ = organs.emplace_back();
            const SensorPoint& point = set.points[i];
            organ.id = static_cast<std::int64_t>(organs.size());
            organ.name = set.is_averaged ? set.name : point.name;
            Labels labels{{"sensors", set.name}};
            if (!set.is_averaged) {
                labels.insert(labels.end(), point.labels.begin(), point.labels.end());
            }
            organ.labels = SharedLabels(std::make_shared<const Labels>(std::move(labels)));
            organ.least_cosine = is_sphere ? 0 : least_cosine(set.field_of_view_deg);
            organ.area = area;
            organ.first_region = static_cast<std::uint32_t>(first_region + organs.size() - 1);
            organ.region_count = 1;
        }
    }
    return organs;
}

std::vector<SensorDisks> disks_of_sensors(const Scene& scene) {
    std::vector<SensorDisks> all;
    for (const SensorSet& set : scene.sensors()) {
        for (std::size_t row = 0; row < set.rows(); ++row) {
            SensorDisks& own = all.emplace_back();
            own.radius = set.radius;
            own.receiver = set.receiver;
            const std::size_t end = set.is_averaged ? set.points.size() : row + 1;
            for (std::size_t i = row; i < end; ++i) {
                own.disks.push_back({set.points[i].position, set.points[i].facing});
            }
        }
    }
    return all;
}

/// The regions of a scene joined by material, those of the ground apart.
struct JoinedRegions {
    std::vector<Region> regions;         ///< first those of organ 0, then of the ground, organ 1
    std::vector<RegionIndex> of_former;  ///< by region of the scene
    std::size_t ground_begin = 0;
};

JoinedRegions join_regions(const Scene& scene) {
    JoinedRegions joined;
    joined.of_former.resize(scene.regions().size());
    for (const bool is_ground : {false, true}) {
        joined.ground_begin = is_ground ? joined.regions.size() : 0;
        std::map<std::uint32_t, RegionIndex> known;  // by material
        for (std::size_t i = 0; i < scene.regions().size(); ++i) {
            const Region& region = scene.regions()[i];
            if (scene.organs()[region.organ.value].is_ground != is_ground) {
                continue;
            }
            const RegionIndex next{static_cast<std::uint32_t>(joined.regions.size())};
            const auto [own, is_new] = known.try_emplace(region.material.value, next);
            if (is_new) {
                joined.regions.push_back({OrganIndex{is_ground ? 1U : 0U}, region.material, 0});
            }
            joined.regions[own->second.value].area += region.area;
            joined.of_former[i] = own->second;
        }
    }
    return joined;
}

/// The former organs of scene_with_sensors(), without area: no light is computed for them.
std::vector<Organ> joined_organs(const Scene& scene, const JoinedRegions& joined) {
    std::vector<Organ> organs(2);
    organs[0].region_count = static_cast<std::uint32_t>(joined.ground_begin);
    organs[1].is_ground = true;
    organs[1].first_region = organs[0].region_count;
    organs[1].region_count =
        static_cast<std::uint32_t>(joined.regions.size() - joined.ground_begin);
    for (const Organ& organ : scene.organs()) {
        organs[organ.is_ground ? 1 : 0].triangle_count += organ.triangle_count;
    }
    for (Organ& organ : organs) {
        organ.measured = false;
    }
    organs.resize(organs[1].region_count > 0 ? 2 : 1);
    return organs;
}

}  // namespace

/// Light on a point is a density; the area of a sensor only makes a flux of it. All areas together
/// are a small part of the scene, so that sums hold the light next to a lamp: with quanta of 2^-40
/// of the light on such an area, and 2^22 times the mean light as the largest amount.
Scene SceneAccess::with_sensors(const Scene& scene) {
    constexpr double kPart = 0x1p-12;
    const double radius = scene.bounds().radius();
    const double area = kPart * radius * radius / static_cast<double>(sensor_rows(scene));
    JoinedRegions joined = join_regions(scene);
    std::vector<Organ> organs = joined_organs(scene, joined);
    SceneData data = *scene.data_;
    const MaterialId material{static_cast<std::uint32_t>(data.materials.size())};
    data.materials.push_back(transparent_material(scene.bands().size()));
    data.sensors =
        std::make_shared<const SensorOrgans>(SensorOrgans{organs.size(), disks_of_sensors(scene)});
    const auto join = [&](std::vector<RegionIndex> of) {
        for (RegionIndex& region : of) {
            region = joined.of_former[region.value];
        }
        return of;
    };
    data.triangle_regions =
        std::make_shared<const std::vector<RegionIndex>>(join(*data.triangle_regions));
    data.instance_regions = join(std::move(data.instance_regions));
    data.areas = std::make_shared<const Lazy<OrganAreas>>();
    const std::vector<Organ> sensors = organs_of_sensors(scene, joined.regions.size(), area);
    Scene all = scene;
    all.regions_ = std::move(joined.regions);
    for (std::size_t i = 0; i < sensors.size(); ++i) {
        const auto organ = static_cast<std::uint32_t>(organs.size() + i);
        all.regions_.push_back({OrganIndex{organ}, material, sensors[i].area});
    }
    organs.insert(organs.end(), sensors.begin(), sensors.end());
    all.names_ = std::make_shared<const SceneNames>(scene.bands(), std::move(organs));
    all.data_ = std::make_shared<const SceneData>(std::move(data));
    all.detectors_.clear();
    all.sensors_ = std::make_shared<const std::vector<SensorSet>>();
    return all;
}

Scene SceneAccess::with_other_sensors(const Scene& scene, std::vector<SensorSet> sensors) {
    Scene other = scene;
    other.sensors_ = std::make_shared<const std::vector<SensorSet>>(std::move(sensors));
    return other;
}

Scene SceneAccess::of_sensors(const Scene& scene) {
    SceneData data = *scene.data_;
    const MaterialId material{static_cast<std::uint32_t>(data.materials.size())};
    data.materials.push_back(transparent_material(scene.bands().size()));
    Scene rows = scene;
    rows.names_ = std::make_shared<const SceneNames>(scene.bands(), organs_of_sensors(scene, 0, 1));
    rows.data_ = std::make_shared<const SceneData>(std::move(data));
    rows.regions_.clear();
    for (std::uint32_t i = 0; i < rows.organs().size(); ++i) {
        rows.regions_.push_back({OrganIndex{i}, material, 1});
    }
    rows.detectors_.clear();
    rows.sensors_ = std::make_shared<const std::vector<SensorSet>>();
    return rows;
}

Scene scene_with_sensors(const Scene& scene) {
    return SceneAccess::with_sensors(scene);
}

Scene scene_with_other_sensors(const Scene& scene, std::vector<SensorSet> sensors) {
    return SceneAccess::with_other_sensors(scene, std::move(sensors));
}

Scene scene_of_sensors(const Scene& scene) {
    return SceneAccess::of_sensors(scene);
}

}  // namespace quasimc
