#include "scene/overlap/overlap_grid.h"

#include <algorithm>
#include <cmath>

#include <boost/sort/spreadsort/integer_sort.hpp>

#include "base/checks.h"
#include "scene/overlap/coplanar.h"
#include "scene/overlap/overlap_search.h"

namespace quasimc {
namespace {

/// Spreads the numbers of cubes evenly.
std::uint64_t mixed(std::uint64_t cube) {
    return (cube * 0x9e3779b97f4a7c15U) >> 40;
}

/// Sorts by the bits of the cubes' numbers (spreadsort), which is faster than comparing: most cubes
/// have few triangles.
void sort_by_cube(std::vector<OverlapEntry>& entries) {
    boost::sort::spreadsort::integer_sort(
        entries.begin(), entries.end(),
        [](const OverlapEntry& e, unsigned shift) { return e.cube >> shift; },
        [](const OverlapEntry& a, const OverlapEntry& b) { return a.cube < b.cube; });
}

}  // namespace

bool OverlapEntry::is_parallel_to(const OverlapEntry& other) const {
    return std::abs(facing - other.facing) <= blur + other.blur;
}

bool OverlapEntry::is_in_plane_of(const OverlapEntry& other) const {
    const float turn = blur + other.blur;
    // A point that lies on both is at most half a diagonal, 0.87 edges, from the centre of its
    // cube. The planes differ there by their angle and by their thickness, a quarter of it.
    const float most = 2 * turn;
    return std::abs(offset - other.offset) <= most ||
           // Normals at right angles to the generic direction: either side may be taken.
           (facing <= turn && std::abs(offset + other.offset) <= most);
}

TriangleExtent::TriangleExtent(const Triangle& t) : bounds(bounds_of(t)), size(size_of(bounds)) {}

OverlapGrid::OverlapGrid(
    const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene)
    : triangles_(triangles),
      changed_(changed),
      low_(scene.low),
      size_(size_of(scene)),
      passes_(triangles.instances().empty() ? 1 : 8) {
    EXPECT(changed.empty() || passes_ == 1);
    for (std::size_t level = 0; level < kLevels; ++level) {
        per_length_[level] = static_cast<double>(std::uint64_t{1} << (2 * level)) / size_;
    }
}

double OverlapGrid::thickness(double triangle_size) const {
    return coplanar_tolerance(triangle_size, size_);
}

/// Calls visit(triangle, level, is_native) for all levels that triangles belong to and that are the
/// home of some.
/// @param level_of  home level of each triangle; negative: none
template <typename Visit>
void OverlapGrid::for_each_entry(
    std::span<const std::int16_t> level_of, const Homes& is_home, const Visit& visit) {
    for (std::size_t i = 0; i < level_of.size(); ++i) {
        for (int level = 0; level <= level_of[i]; ++level) {
            if (is_home[static_cast<std::size_t>(level)]) {
                visit(static_cast<std::uint32_t>(i), level, level == level_of[i]);
            }
        }
    }
}

/// Calls visit(number of the cube) for each, as long as it returns true.
template <typename Visit>
void OverlapGrid::for_each_cube(const Cubes& cubes, int level, const Visit& visit) {
    const auto& [first, count] = cubes;
    for (std::uint64_t n = 0; n < cubes.number(); ++n) {
        auto cube = static_cast<std::uint64_t>(level);
        cube = cube << 20 | (first[0] + n % count[0]);
        cube = cube << 20 | (first[1] + n / count[0] % count[1]);
        cube = cube << 20 | (first[2] + n / count[0] / count[1]);
        if (!visit(cube)) {
            return;
        }
    }
}

Vec3 OverlapGrid::middle_of(std::uint64_t cube) const {
    const double edge = 1 / per_length_[cube >> 60];
    const auto along = [&](int axis) {
        return (static_cast<double>(cube >> (40 - 20 * axis) & 0xfffff) + .5) * edge;
    };
    return low_ + Vec3{along(0), along(1), along(2)};
}

int OverlapGrid::home_level(double triangle_size) const {
    return std::clamp(std::ilogb(size_ / triangle_size) / 2, 0, kLevels - 1);
}

void OverlapGrid::enter_all(std::uint64_t pass) {
    natives_.clear();
    visitors_.clear();
    std::vector<std::int16_t> level_of(triangles_.size(), -1);
    std::array<bool, kLevels> is_home{};
    // Entries are counted first, as growing lists would take several times the memory.
    std::size_t natives = 0;
    std::array<std::size_t, kLevels> visitors{};
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        const Triangle t = triangles_[i];
        const TriangleExtent extent(t);
        // Slivers about as thin as the tolerance have no definite plane.
        constexpr double kThin = 2;
        if (extent.size > 0 && height(t) > kThin * thickness(extent.size)) {
            const int home = home_level(extent.size);
            level_of[i] = static_cast<std::int16_t>(home);
            is_home[static_cast<std::size_t>(home)] = true;
            for (int level = 0; !is_partial() && level <= home; ++level) {
                const std::uint64_t count = cubes_at(extent, level).number();
                (level == home ? natives : visitors[static_cast<std::size_t>(level)]) += count;
            }
        }
    }
    if (is_partial()) {
        mark_cubes(level_of, is_home);
    } else {
        reserve(natives, visitors, is_home);
    }
    for_each_entry(level_of, is_home, [&](std::uint32_t i, int level, bool is_native) {
        enter(i, level, is_native, pass);
    });
    sort_by_cube(natives_);
    sort_by_cube(visitors_);
}

/// @param visitors  number on each level
void OverlapGrid::reserve(
    std::size_t natives, const std::array<std::size_t, kLevels>& visitors, const Homes& is_home) {
    constexpr double kUneven = 1.2;
    const auto of_pass = [&](std::size_t count) {
        return passes_ == 1
                   ? count
                   : static_cast<std::size_t>(
                         kUneven * static_cast<double>(count) / static_cast<double>(passes_)) +
                         64;
    };
    std::size_t all = 0;
    for (std::size_t level = 0; level < kLevels; ++level) {
        all += is_home[level] ? visitors[level] : 0;
    }
    natives_.reserve(of_pass(natives));
    visitors_.reserve(of_pass(all));
}

/// Marks the cubes of the changed triangles; other cubes need no entries.
void OverlapGrid::mark_cubes(std::span<const std::int16_t> level_of, const Homes& is_home) {
    marked_.assign(std::size_t{1} << kMarkBits, false);
    for_each_entry(level_of, is_home, [&](std::uint32_t i, int level, bool) {
        if (changed_[i]) {
            for_each_cube(
                cubes_at(TriangleExtent(triangles_[i]), level), level, [&](std::uint64_t cube) {
                    marked_[mark_of(cube)] = true;
                    return true;
                });
        }
    });
}
/// The bit that marks a cube; cubes may share one.
std::uint64_t OverlapGrid::mark_of(std::uint64_t cube) {
    return (cube * 0x9e3779b97f4a7c15U) >> (64 - kMarkBits);
}
bool OverlapGrid::is_marked(std::uint64_t cube) const {
    return !is_partial() || marked_[mark_of(cube)];
}

OverlapGrid::Cubes OverlapGrid::cubes_at(const TriangleExtent& extent, int level) const {
    const double blur = thickness(extent.size);
    const double cubes_per_length = per_length_[static_cast<std::size_t>(level)];
    const Vec3 low = extent.bounds.low - low_;
    const Vec3 high = extent.bounds.high - low_;
    const auto first = [&](double p) {
        return static_cast<std::uint64_t>(std::max(0.0, (p - blur) * cubes_per_length));
    };
    const auto count = [&](double from, double to) {
        return static_cast<std::uint64_t>((to + blur) * cubes_per_length) + 1 - first(from);
    };
    return {
        {first(low.x), first(low.y), first(low.z)},
        {count(low.x, high.x), count(low.y, high.y), count(low.z, high.z)}};
}
void OverlapGrid::enter(std::uint32_t i, int level, bool is_native, std::uint64_t pass) {
    const Triangle t = triangles_[i];
    const TriangleExtent extent(t);
    const Cubes cubes = cubes_at(extent, level);
    bool is_wanted = false;
    for_each_cube(cubes, level, [&](std::uint64_t cube) {
        is_wanted = is_marked(cube);
        return !is_wanted;
    });
    if (!is_wanted) {
        return;
    }
    const double blur = thickness(extent.size);
    OverlapEntry entry{0, 0, 0, 0, i};
    const Vec3 normal = normalized(area_vector(t));
    const Vec3 upward = dot(normal, kGenericDirection) < 0 ? -normal : normal;
    entry.facing = static_cast<float>(dot(upward, kGenericDirection));
    entry.blur = static_cast<float>(4 * blur / height(t) + 1e-6);
    for_each_cube(cubes, level, [&](std::uint64_t cube) {
        if ((passes_ == 1 || mixed(cube) % passes_ == pass) && is_marked(cube)) {
            entry.cube = cube;
            entry.offset = static_cast<float>(
                dot(upward, t[0] - middle_of(cube)) * per_length_[static_cast<std::size_t>(level)]);
            (is_native ? natives_ : visitors_).push_back(entry);
        }
        return true;
    });
}

}  // namespace quasimc
