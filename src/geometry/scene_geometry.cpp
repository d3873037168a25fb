#include "geometry/scene_geometry.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "base/checks.h"
#include "geometry/mesh/outline.h"

namespace quasimc {

SceneGeometry::SceneGeometry(Mesh mesh, std::vector<Instance> instances)
    : mesh_(std::move(mesh)), instances_(std::move(instances)) {
    std::size_t next = mesh_.size();
    std::vector<std::uint32_t> first;
    first.reserve(instances_.size());
    for (const Instance& instance : instances_) {
        EXPECT(instance.mesh && !instance.mesh->empty());
        first.push_back(static_cast<std::uint32_t>(next));
        next += instance.mesh->size();
    }
    EXPECT(next < 0xFFFFFFFFU);
    size_ = next;
    ranges_ = RangeIndex(std::move(first), static_cast<std::uint32_t>(next));
}

Triangle SceneGeometry::instance_triangle(std::size_t i) const {
    const std::uint32_t instance = ranges_.find(static_cast<std::uint32_t>(i));
    return instances_[instance].triangle(i - ranges_.first(instance));
}

bool operator==(const SceneGeometry& a, const SceneGeometry& b) {
    const auto is_same = [](const Instance& one, const Instance& other) {
        return (one.mesh == other.mesh || *one.mesh == *other.mesh) &&
               one.transform.rows == other.transform.rows &&
               one.transform.shift == other.transform.shift;
    };
    const auto has_same_triangles = [](const Mesh& one, const Mesh& other) {
        bool same = one.size() == other.size();
        for (std::size_t i = 0; same && i < one.size(); ++i) {
            same = one[i] == other[i];
        }
        return same;
    };
    return (a.mesh_ == b.mesh_ || has_same_triangles(a.mesh_, b.mesh_)) &&
           std::equal(
               a.instances_.begin(), a.instances_.end(), b.instances_.begin(), b.instances_.end(),
               is_same);
}

bool operator==(const SceneGeometry& a, const std::vector<Triangle>& b) {
    return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin());
}

Bounds bounds_of(const SceneGeometry& geometry) {
    Bounds bounds;
    for (const Vec3& p : geometry.mesh().vertices) {
        bounds.add(p);
    }
    for (const Bounds& box : instance_bounds(geometry.instances())) {
        bounds.add(box.low);
        bounds.add(box.high);
    }
    return bounds;
}

std::vector<Bounds> instance_bounds(const std::vector<Instance>& instances) {
    std::unordered_map<const Mesh*, std::vector<Vec3>> outlines;
    std::vector<Bounds> all;
    all.reserve(instances.size());
    for (const Instance& instance : instances) {
        const auto [outline, is_new] = outlines.try_emplace(instance.mesh.get());
        if (is_new) {
            outline->second = outline_points(instance.mesh->vertices, 3 * instance.mesh->size());
        }
        Bounds& bounds = all.emplace_back();
        for (const Vec3& p : outline->second) {
            bounds.add(instance.transform.point(p));
        }
    }
    return all;
}

}  // namespace quasimc
