#include "scene/overlap/covered.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "quasimc/error.h"
#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_search.h"

namespace quasimc {
namespace {

/// Triangle `first` of the scene, moved by `shift`, lies on `second`, and comes before it.
struct Cover {
    std::uint32_t first, second;
    Vec3 shift;
    bool is_same, is_little;
};

bool operator<(const Cover& a, const Cover& b) {
    return std::tie(a.second, a.first, a.shift.x, a.shift.y) <
           std::tie(b.second, b.first, b.shift.x, b.shift.y);
}

/// Organs and regions of the triangles of an assembly.
class Owners {
  public:
    Owners(const DraftAssembly& scene, const SceneGeometry& geometry)
        : scene_(scene), geometry_(geometry) {}

    [[nodiscard]] std::uint32_t region(std::uint32_t triangle) const {
        return triangle < scene_.triangle_regions.size()
                   ? scene_.triangle_regions[triangle].value
                   : scene_.instance_regions[geometry_.ranges().find(triangle)].value;
    }
    [[nodiscard]] std::uint32_t organ(std::uint32_t triangle) const {
        return scene_.regions[region(triangle)].organ.value;
    }
    /// Identifies an organ in this scene and in the previous one. The ground, which is last, has a
    /// fixed key, as its id changes with the number of organs.
    [[nodiscard]] std::int64_t key(std::uint32_t triangle) const {
        const std::uint32_t number = organ(triangle);
        return number + 1 == scene_.organs.size() ? std::numeric_limits<std::int64_t>::max()
                                                  : scene_.organs[number].id;
    }

  private:
    const DraftAssembly& scene_;
    const SceneGeometry& geometry_;
};

/// The pairs of a periodic scene, whose periodic copies are those of `wrapped`.
std::vector<Cover> through_borders(
    const std::vector<Overlap>& pairs,
    const SceneGeometry& scene,
    const WrappedGeometry& wrapped,
    const Cell& cell) {
    const SceneGeometry& images = *wrapped.geometry;
    const auto shift_of = [&](std::uint32_t image, std::uint32_t source) {
        const Vec3 moved = images[image][0] - scene[source][0];
        return Vec3{
            cell.along_x ? cell.size_x * std::round(moved.x / cell.size_x) : 0,
            cell.along_y ? cell.size_y * std::round(moved.y / cell.size_y) : 0, 0};
    };
    std::vector<Cover> covers;
    for (const Overlap& pair : pairs) {
        const std::uint32_t a = wrapped.source_of(pair.first, images.ranges());
        const std::uint32_t b = wrapped.source_of(pair.second, images.ranges());
        covers.push_back(
            {a, b, shift_of(pair.first, a) - shift_of(pair.second, b), pair.is_same,
             pair.is_little});
    }
    return covers;
}

struct FoundCovers {
    std::vector<Cover> covers;
    bool is_skipped = false, gave_up = false;
};

/// @param key_of  identifies the organ of each triangle
template <typename KeyOf>
Overlaps find_with(
    KnownOverlaps* known,
    const std::shared_ptr<const SceneGeometry>& triangles,
    const KeyOf& key_of) {
    if (known == nullptr) {
        return find_overlaps(*triangles);
    }
    std::vector<std::int64_t> owners;
    owners.reserve(triangles->size());
    for (std::uint32_t i = 0; i < triangles->size(); ++i) {
        owners.push_back(key_of(i));
    }
    return known->find(triangles, owners);
}

/// @throws InputError  if most overlaps are between periodic copies of the same few triangles, too
/// many to compare, as with organs in centimetres in a cell in metres
void refuse_pile_of_images(std::size_t images, std::size_t triangles) {
    constexpr std::size_t kMaxOfEach = 100;
    if (images > kMaxOfEach * triangles) {
        throw InputError(
            {{"cell",
              fmt::format(
                  "each triangle appears {} times in it on average, and too many of these copies "
                  "overlap in one plane",
                  images / triangles),
              "organs may be a few times as large as the cell at most",
              "give cell and organs in the same unit of length"}});
    }
}

FoundCovers find_pairs(
    const std::shared_ptr<const SceneGeometry>& scene,
    const Owners& owners,
    const Cell& cell,
    KnownOverlaps* known) {
    if (!cell.periodic() || scene->size() > kMaxToCompare) {
        const Overlaps found =
            find_with(known, scene, [&](std::uint32_t i) { return owners.key(i); });
        FoundCovers all{{}, found.is_skipped, found.gave_up};
        for (const Overlap& pair : found.pairs) {
            all.covers.push_back({pair.first, pair.second, {}, pair.is_same, pair.is_little});
        }
        return all;
    }
    const WrappedGeometry wrapped = wrap_into_cell(*scene, cell);
    const Overlaps found = find_with(known, wrapped.geometry, [&](std::uint32_t i) {
        return owners.key(wrapped.source_of(i, wrapped.geometry->ranges()));
    });
    if (found.gave_up) {
        refuse_pile_of_images(wrapped.geometry->size(), scene->size());
    }
    return {through_borders(found.pairs, *scene, wrapped, cell), found.is_skipped, found.gave_up};
}

/// Orders each pair by position in the file (of two copies of one triangle, the one further along
/// the axis is first), then sorts the pairs and removes repeated ones.
void put_in_order(std::vector<Cover>& covers, const Owners& owners) {
    for (Cover& cover : covers) {
        const auto a = std::pair(owners.organ(cover.first), cover.first);
        const auto b = std::pair(owners.organ(cover.second), cover.second);
        const bool is_behind = cover.shift.x < 0 || (cover.shift.x == 0 && cover.shift.y < 0);
        if (b < a || (a == b && is_behind)) {
            std::swap(cover.first, cover.second);
            cover.shift = -cover.shift;
        }
    }
    std::sort(covers.begin(), covers.end());
    const auto is_equal = [](const Cover& a, const Cover& b) { return !(a < b) && !(b < a); };
    covers.erase(std::unique(covers.begin(), covers.end(), is_equal), covers.end());
}

Triangle moved(Triangle t, const Vec3& shift) {
    for (Vec3& corner : t) {
        corner += shift;
    }
    return t;
}

/// The uncovered parts of triangle `t`.
std::vector<Triangle> uncovered(
    const Triangle& t,
    std::span<const Cover> covers,
    const SceneGeometry& scene,
    double scene_size) {
    std::vector<Triangle> windows;
    for (const Cover& cover : covers) {
        if (cover.is_same) {
            return {};
        }
        windows.push_back(moved(scene[cover.first], cover.shift));
    }
    return parts_beside(t, windows, coplanar_tolerance(size_of(bounds_of(t)), scene_size));
}

/// Shift of a triangle of a sensor off its plane.
struct Lift {
    int steps = 0;
    /// For a triangle that lies on its own periodic copies: parts that do not overlap themselves.
    /// Each list is lifted by one step more than the previous one.
    std::vector<std::vector<Triangle>> parts = {};

    /// Number of steps for triangles that lie on all of it.
    [[nodiscard]] int next() const { return steps + std::max(1, static_cast<int>(parts.size())); }
};
using Lifts = std::map<std::uint32_t, Lift>;

/// Builds the cut mesh, organ by organ.
class Cutter {
  public:
    /// @param lifts  for triangles of sensors that lie on surfaces
    Cutter(
        DraftAssembly& scene,
        const SceneGeometry& geometry,
        std::span<const Cover> covers,
        const Lifts& lifts)
        : scene_(scene),
          geometry_(geometry),
          owners_(scene, geometry),
          covers_(covers),
          lifts_(lifts),
          size_(size_of(bounds_of(geometry))) {}

    std::shared_ptr<const SceneGeometry> run() {
        const std::size_t owned = scene_.triangle_regions.size();
        std::vector<Organ*> instanced;
        for (Organ& organ : scene_.organs) {
            if (organ.first_triangle >= owned && !is_cut(organ)) {
                keep_instances(organ);
                instanced.push_back(&organ);
            } else {
                cut(organ);
            }
        }
        for (Organ* organ : instanced) {
            organ->first_triangle += static_cast<std::uint32_t>(mesh_.size());
        }
        order_vertices(mesh_);
        scene_.triangle_regions = std::move(triangle_regions_);
        scene_.instance_regions = std::move(instance_regions_);
        return std::make_shared<const SceneGeometry>(std::move(mesh_), std::move(instances_));
    }

  private:
    /// Copies an organ whose instances are unchanged.
    void keep_instances(Organ& organ) {
        const std::uint32_t end = organ.first_triangle + organ.triangle_count;
        for (std::uint32_t i = organ.first_triangle; i < end;) {
            const std::uint32_t k = geometry_.ranges().find(i);
            instances_.push_back(geometry_.instances()[k]);
            instance_regions_.push_back(scene_.instance_regions[k]);
            i += geometry_.ranges().count(k);
        }
        organ.first_triangle = instance_triangles_;
        instance_triangles_ += organ.triangle_count;
    }

    /// Cuts an organ; one that is covered completely keeps one triangle of zero area.
    void cut(Organ& organ) {
        const std::uint32_t begin = organ.first_triangle;
        const std::uint32_t end = begin + organ.triangle_count;
        organ.first_triangle = static_cast<std::uint32_t>(mesh_.size());
        for (std::uint32_t i = begin; i < end; ++i) {
            organ.covered_area += add(i);
            triangle_regions_.resize(mesh_.size(), RegionIndex{owners_.region(i)});
        }
        if (mesh_.size() == organ.first_triangle) {
            const Vec3 corner = geometry_[begin][0];
            mesh_.push_back({corner, corner, corner});
            triangle_regions_.push_back(RegionIndex{owners_.region(begin)});
        }
        organ.triangle_count = static_cast<std::uint32_t>(mesh_.size()) - organ.first_triangle;
    }

    /// Shift to the upper side; each step exceeds the resolution of hits
    /// (geometry/cast/rounding.h).
    [[nodiscard]] Vec3 lift(const Triangle& t, int steps) const {
        constexpr double kLift = 4e-6;
        const Vec3 up = cross(t[1] - t[0], t[2] - t[0]);
        const double size = length(up);
        return size > 0 ? steps * kLift * size_ / size * up : Vec3{};
    }

    /// Adds a lifted triangle of a sensor.
    void add_lifted(const Triangle& whole, const Lift& by) {
        if (by.parts.empty()) {
            mesh_.push_back(moved(whole, lift(whole, by.steps)));
            return;
        }
        int steps = by.steps;
        for (const std::vector<Triangle>& part : by.parts) {
            const Vec3 up = lift(whole, steps++);
            for (const Triangle& t : part) {
                mesh_.push_back(moved(t, up));
            }
        }
    }

    [[nodiscard]] std::span<const Cover> covers_of(std::uint32_t triangle) const {
        const auto is_before = [](const Cover& c, std::uint32_t t) { return c.second < t; };
        const auto is_after = [](std::uint32_t t, const Cover& c) { return t < c.second; };
        const auto first = std::lower_bound(covers_.begin(), covers_.end(), triangle, is_before);
        return {first, std::upper_bound(first, covers_.end(), triangle, is_after)};
    }
    [[nodiscard]] bool is_cut(const Organ& organ) const {
        const auto first = std::lower_bound(
            covers_.begin(), covers_.end(), organ.first_triangle,
            [](const Cover& c, std::uint32_t t) { return c.second < t; });
        return first != covers_.end() &&
               first->second < organ.first_triangle + organ.triangle_count;
    }

    /// Adds the uncovered parts of a triangle. @return the area that was cut away
    double add(std::uint32_t triangle) {
        const Triangle whole = geometry_[triangle];
        if (const auto found = lifts_.find(triangle); found != lifts_.end()) {
            add_lifted(whole, found->second);
            return 0;
        }
        const std::span<const Cover> covers = covers_of(triangle);
        if (covers.empty()) {
            mesh_.push_back(whole);
            return 0;
        }
        double rest = 0;
        for (const Triangle& part : uncovered(whole, covers, geometry_, size_)) {
            mesh_.push_back(part);
            rest += area(part);
        }
        return std::max(0.0, area(whole) - rest);
    }

    DraftAssembly& scene_;
    const SceneGeometry& geometry_;
    Owners owners_;
    std::span<const Cover> covers_;
    const Lifts& lifts_;
    double size_;
    Mesh mesh_;
    std::vector<Instance> instances_;
    std::vector<RegionIndex> triangle_regions_, instance_regions_;
    std::uint32_t instance_triangles_ = 0;
};

/// Counts triangles by pairs of organs, each triangle once. Strips along borders are not reported.
std::vector<Coincidence> count_pairs(
    std::span<const Cover> covers, const Owners& owners, OverlapOwner light) {
    std::map<std::tuple<bool, std::uint32_t, std::uint32_t>, std::uint32_t> pairs;
    std::optional<std::uint32_t> last;
    for (const Cover& cover : covers) {
        if (last != cover.second && !cover.is_little) {
            ++pairs[{!cover.is_same, owners.organ(cover.second), owners.organ(cover.first)}];
            last = cover.second;
        }
    }
    std::vector<Coincidence> counted;
    for (const auto& [key, count] : pairs) {
        const auto& [is_part, second, first] = key;
        counted.push_back({OrganIndex{first}, OrganIndex{second}, count, !is_part, light});
    }
    return counted;
}

/// Parts of a triangle that is wider than the cell along an axis, each no wider than it.
std::vector<std::vector<Triangle>> parts_in_cells(
    const Triangle& whole, const Cell& cell, const Vec3& shift) {
    std::vector<std::vector<Triangle>> parts{{whole}};
    if (shift.x != 0) {
        parts = parts_in_slabs(whole, {1, 0, 0}, cell.size_x);
    }
    if (shift.y == 0) {
        return parts;
    }
    std::vector<std::vector<Triangle>> smaller;
    for (const std::vector<Triangle>& strip : parts) {
        for (const Triangle& t : strip) {
            for (auto& part : parts_in_slabs(t, {0, 1, 0}, cell.size_y)) {
                smaller.push_back(std::move(part));
            }
        }
    }
    return smaller;
}

/// Shifts of sensors' triangles that lie on surfaces, or on earlier sensors: each is one step above
/// those.
/// @param covers  ordered by Cover::second
template <typename IsSensor>
Lifts lifts_of_sensors(
    std::span<const Cover> covers,
    const SceneGeometry& geometry,
    const Cell& cell,
    const IsSensor& is_sensor) {
    Lifts lifts;
    std::map<std::uint32_t, Vec3> onto_itself;  // how far along each axis, 0: not
    for (const Cover& cover : covers) {
        if (is_sensor(cover.first) != is_sensor(cover.second)) {
            lifts[is_sensor(cover.first) ? cover.first : cover.second].steps = 1;
        }
        if (is_sensor(cover.first) && cover.first == cover.second) {
            Vec3& shift = onto_itself[cover.first];
            shift = {
                std::max(shift.x, std::abs(cover.shift.x)),
                std::max(shift.y, std::abs(cover.shift.y)), 0};
        }
    }
    for (const auto& [triangle, shift] : onto_itself) {
        lifts[triangle].parts = parts_in_cells(geometry[triangle], cell, shift);
    }
    for (const Cover& cover : covers) {
        if (is_sensor(cover.first) && is_sensor(cover.second) && cover.first != cover.second) {
            const auto before = lifts.find(cover.first);
            const int steps = before == lifts.end() ? 1 : before->second.next();
            Lift& own = lifts[cover.second];
            own.steps = std::max(own.steps, steps);
        }
    }
    return lifts;
}

}  // namespace

CutGeometry cut_covered(
    DraftAssembly& scene,
    const Cell& cell,
    const std::vector<Material>& materials,
    KnownOverlaps* known) {
    CutGeometry result;
    result.geometry =
        std::make_shared<const SceneGeometry>(std::move(scene.mesh), std::move(scene.instances));
    const SceneGeometry& geometry = *result.geometry;
    const Owners owners(scene, geometry);
    FoundCovers found = find_pairs(result.geometry, owners, cell, known);
    put_in_order(found.covers, owners);
    const auto is_sensor = [&](std::uint32_t triangle) {
        return materials[scene.regions[owners.region(triangle)].material.value].is_transparent();
    };
    const auto sensors = std::stable_partition(
        found.covers.begin(), found.covers.end(),
        [&](const Cover& c) { return !is_sensor(c.first) && !is_sensor(c.second); });
    const std::span<const Cover> covers(found.covers.begin(), sensors);
    Coincidences& reported = result.coincidences;
    reported = {count_pairs(covers, owners, OverlapOwner::first), found.is_skipped, found.gave_up};
    for (const Coincidence& pair :
         count_pairs({sensors, found.covers.end()}, owners, OverlapOwner::both)) {
        reported.pairs.push_back(pair);
    }
    const Lifts lifts = lifts_of_sensors({sensors, found.covers.end()}, geometry, cell, is_sensor);
    if (!covers.empty() || !lifts.empty()) {
        result.geometry = Cutter(scene, geometry, covers, lifts).run();
    }
    return result;
}

}  // namespace quasimc
