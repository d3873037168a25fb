// Coplanar triangles that overlap.
//
// Triangles are sorted into grids of cubes, four times finer from level to level; a triangle is at
// home on the level whose cubes are at least twice its size, and visits the coarser ones. Two
// triangles that overlap share a cube on the home level of the larger. In a cube they are sorted by
// a function of the normal that has the same value for both sides, so that only triangles which are
// nearly parallel are compared.

#include "scene/overlap_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <utility>

#include "base/checks.h"
#include "scene/coplanar.h"

namespace quasimc {
namespace {

constexpr int kLevels = 9;

/// A triangle in a cube of the grids.
struct Entry {
    std::uint64_t cube;
    float facing;  ///< |cos| of the angle between the normal and kGeneric
    float blur;    ///< how much `facing` of a coplanar triangle may differ
    std::uint32_t triangle;
};

inline bool operator<(const Entry& a, const Entry& b) {
    if (a.cube != b.cube) {
        return a.cube < b.cube;
    }
    return a.facing != b.facing ? a.facing < b.facing : a.triangle < b.triangle;
}

/// A direction that normals of modelled organs are seldom symmetric about.
constexpr Vec3 kGeneric{0.3518, 0.7143, 0.6049};

class OverlapSearch {
  public:
    OverlapSearch(
        const SceneGeometry& triangles, const Bounds& bounds, const std::vector<bool>& changed)
        : triangles_(triangles),
          changed_(changed),
          low_(bounds.low),
          size_(size_of(bounds)),
          most_comparisons_(most_comparisons(triangles.size())),
          passes_(triangles.instances().empty() ? 1 : 8),
          same_before_(triangles.size()) {
        EXPECT(changed.empty() || passes_ == 1);
    }

    OverlapSearchResult run() {
        for (pass_ = 0; pass_ < passes_; ++pass_) {
            natives_.clear();
            visitors_.clear();
            enter_all();
            compare_all();
        }
        sort_found();
        const auto most = std::max_element(same_before_.begin(), same_before_.end());
        return {
            {std::move(found_), false, comparisons_ > most_comparisons_},
            comparisons_,
            most == same_before_.end() ? 0U : *most};
    }

  private:
    [[nodiscard]] bool is_partial() const { return !changed_.empty(); }

    void compare_all() {
        std::sort(natives_.begin(), natives_.end());
        std::sort(visitors_.begin(), visitors_.end());
        auto visitor = visitors_.begin();
        for (auto first = natives_.begin(); first != natives_.end();) {
            const std::uint64_t cube = first->cube;
            const auto in_cube = [&](const Entry& e) { return e.cube == cube; };
            const auto last = std::find_if_not(first, natives_.end(), in_cube);
            visitor = std::find_if(
                visitor, visitors_.end(), [&](const Entry& e) { return e.cube >= cube; });
            const Homes homes{{first, last}};
            for (const Entry& native : homes.natives) {
                compare(native, homes, Among::natives);
            }
            for (; visitor != visitors_.end() && visitor->cube == cube; ++visitor) {
                compare(*visitor, homes, Among::visitors);
            }
            first = last;
        }
    }

    /// The triangles at home in a cube.
    struct Homes {
        explicit Homes(std::span<const Entry> all) : natives(all) {
            for (const Entry& entry : natives) {
                most_blur = std::max(most_blur, entry.blur);
            }
        }
        std::span<const Entry> natives;  ///< sorted by `facing`
        float most_blur = 0;
    };

    /// Natives of a cube meet each other twice, visitors meet them once.
    enum class Among { natives, visitors };

    [[nodiscard]] double thickness(double triangle_size) const {
        return coplanar_tolerance(triangle_size, size_);
    }

    [[nodiscard]] int home_level(double triangle_size) const {
        return std::clamp(std::ilogb(size_ / triangle_size) / 2, 0, kLevels - 1);
    }

    /// Calls visit(triangle, level, whether it is a native there) for all levels that triangles
    /// belong to and that are home to some.
    /// @param level_of  each triangle's home; negative: it belongs to none
    template <typename Visit>
    static void for_each_entry(
        std::span<const std::int16_t> level_of,
        const std::array<bool, kLevels>& is_home,
        const Visit& visit) {
        for (std::size_t i = 0; i < level_of.size(); ++i) {
            for (int level = 0; level <= level_of[i]; ++level) {
                if (is_home[static_cast<std::size_t>(level)]) {
                    visit(static_cast<std::uint32_t>(i), level, level == level_of[i]);
                }
            }
        }
    }

    /// What is known of a triangle by its place alone.
    struct Extent {
        Bounds bounds;
        double size;
    };
    static Extent extent_of(const Triangle& t) {
        const Bounds bounds = bounds_of(t);
        return {bounds, size_of(bounds)};
    }

    void enter_all() {
        std::vector<std::int16_t> level_of(triangles_.size(), -1);
        std::array<bool, kLevels> is_home{};
        // What is entered is counted first: growing lists would take several times the memory.
        std::size_t natives = 0;
        std::array<std::size_t, kLevels> visitors{};
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const Triangle t = triangles_[i];
            const Extent extent = extent_of(t);
            // Slivers about as thin as the tolerance lie in no plane in particular.
            constexpr double kThin = 8;
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
            enter(i, level, is_native);
        });
    }

    /// @param visitors  that there would be on each level
    void reserve(
        std::size_t natives,
        const std::array<std::size_t, kLevels>& visitors,
        const std::array<bool, kLevels>& is_home) {
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

    /// Marks the cubes of the triangles that changed: what is in no such cube need not be entered.
    void mark_cubes(
        std::span<const std::int16_t> level_of, const std::array<bool, kLevels>& is_home) {
        marked_.assign(std::size_t{1} << kMarkBits, false);
        for_each_entry(level_of, is_home, [&](std::uint32_t i, int level, bool) {
            if (changed_[i]) {
                for_each_cube(
                    cubes_at(extent_of(triangles_[i]), level), level, [&](std::uint64_t cube) {
                        marked_[mark_of(cube)] = true;
                        return true;
                    });
            }
        });
    }
    static constexpr int kMarkBits = 20;
    /// Where a cube is marked; cubes may share a place.
    static std::uint64_t mark_of(std::uint64_t cube) {
        return (cube * 0x9e3779b97f4a7c15U) >> (64 - kMarkBits);
    }
    [[nodiscard]] bool is_marked(std::uint64_t cube) const {
        return !is_partial() || marked_[mark_of(cube)];
    }

    /// Spreads the numbers of cubes evenly.
    static std::uint64_t mixed(std::uint64_t cube) { return (cube * 0x9e3779b97f4a7c15U) >> 40; }

    /// The cubes of a level that a triangle's bounds reach into: the first, and how many along each
    /// axis.
    struct Cubes {
        std::array<std::uint64_t, 3> first, count;
        [[nodiscard]] std::uint64_t number() const { return count[0] * count[1] * count[2]; }
    };
    [[nodiscard]] Cubes cubes_at(const Extent& extent, int level) const {
        const double blur = thickness(extent.size);
        const double per_length = static_cast<double>(std::uint64_t{1} << (2 * level)) / size_;
        const Vec3 low = extent.bounds.low - low_;
        const Vec3 high = extent.bounds.high - low_;
        const auto first = [&](double p) {
            return static_cast<std::uint64_t>(std::max(0.0, (p - blur) * per_length));
        };
        const auto count = [&](double from, double to) {
            return static_cast<std::uint64_t>((to + blur) * per_length) + 1 - first(from);
        };
        return {
            {first(low.x), first(low.y), first(low.z)},
            {count(low.x, high.x), count(low.y, high.y), count(low.z, high.z)}};
    }
    /// Calls visit(number of the cube) for each, as long as it returns true.
    template <typename Visit>
    static void for_each_cube(const Cubes& cubes, int level, const Visit& visit) {
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

    void enter(std::uint32_t i, int level, bool is_native) {
        const Triangle t = triangles_[i];
        const Extent extent = extent_of(t);
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
        Entry entry{0, 0, 0, i};
        entry.facing = static_cast<float>(std::abs(dot(normalized(area_vector(t)), kGeneric)));
        entry.blur = static_cast<float>(4 * blur / height(t) + 1e-6);
        for_each_cube(cubes, level, [&](std::uint64_t cube) {
            entry.cube = cube;
            if ((passes_ == 1 || mixed(cube) % passes_ == pass_) && is_marked(cube)) {
                (is_native ? natives_ : visitors_).push_back(entry);
            }
            return true;
        });
    }

    /// Looks among the triangles at home in a cube for those that `entry` lies on, and a visitor
    /// for those that lie on it: slivers are at home with larger triangles, and lie on smaller
    /// ones.
    void compare(const Entry& entry, const Homes& homes, Among among) {
        const std::span<const Entry> natives = homes.natives;
        const auto is_before = [](const Entry& e, float facing) { return e.facing < facing; };
        const float reach = entry.blur + homes.most_blur;
        auto other =
            std::lower_bound(natives.begin(), natives.end(), entry.facing - reach, is_before);
        for (; other != natives.end() && other->facing <= entry.facing + reach; ++other) {
            const bool is_parallel =
                std::abs(other->facing - entry.facing) <= entry.blur + other->blur;
            if (!is_parallel || other->triangle == entry.triangle) {
                continue;  // most triangles: they need not be fetched
            }
            if (is_piled(entry)) {
                return;
            }
            if (is_piled(*other) || !is_asked_for(entry, *other)) {
                continue;
            }
            if (++comparisons_ > most_comparisons_) {
                return;
            }
            compare(entry.triangle, other->triangle, among);
        }
    }

    void compare(std::uint32_t triangle, std::uint32_t other, Among among) {
        Triangle small = triangles_[triangle];
        Triangle large = triangles_[other];
        if (!is_smaller(small, large)) {
            if (among == Among::natives) {
                return;  // they meet again
            }
            std::swap(small, large);
        }
        const Bounds bounds = bounds_of(small);
        const double tolerance = thickness(size_of(bounds));
        if (!lies_on(small, bounds, large, tolerance)) {
            return;
        }
        const Overlap found{
            std::min(triangle, other), std::max(triangle, other), is_same(small, large, tolerance)};
        if (found.is_same) {
            ++same_before_[found.second];
        }
        found_.push_back(found);
    }

    /// Whether a triangle is known to be the same as so many before it that nothing is learnt from
    /// the others.
    [[nodiscard]] bool is_piled(const Entry& entry) const {
        return same_before_[entry.triangle] >= kPileOfTriangles;
    }

    [[nodiscard]] bool is_asked_for(const Entry& a, const Entry& b) const {
        return !is_partial() || changed_[a.triangle] || changed_[b.triangle];
    }

    /// Of two triangles at home on one level; either of two equal ones.
    static bool is_smaller(const Triangle& a, const Triangle& b) {
        constexpr double kRounding = 1e-6;
        return area(a) <= (1 + kRounding) * area(b);
    }

    /// Triangles meet in several cubes. They are the same if they were found to be so once.
    void sort_found() {
        const auto key = [](const Overlap& o) { return std::tie(o.first, o.second); };
        std::sort(found_.begin(), found_.end(), [&](const Overlap& a, const Overlap& b) {
            return key(a) != key(b) ? key(a) < key(b) : a.is_same && !b.is_same;
        });
        const auto end = std::unique(
            found_.begin(), found_.end(),
            [&](const Overlap& a, const Overlap& b) { return key(a) == key(b); });
        found_.erase(end, found_.end());
    }

    /// Whether part of `small` lies on `large`. The quick tests come first.
    static bool lies_on(
        const Triangle& small, Bounds bounds, const Triangle& large, double tolerance) {
        const Vec3 blur{tolerance, tolerance, tolerance};
        bounds.low -= blur;
        bounds.high += blur;
        return meet(bounds, bounds_of(large)) && lies_in_plane(small, large, tolerance) &&
               !lie_apart(small, large) && covered_part(small, large) > kOverlap;
    }

    static constexpr double kOverlap =
        1e-3;  // of the smaller triangle; less is rounding at an edge

    const SceneGeometry& triangles_;
    const std::vector<bool>& changed_;
    std::vector<bool> marked_;  // cubes, by mark_of()
    Vec3 low_;
    double size_;
    std::size_t most_comparisons_;
    std::vector<Entry> natives_, visitors_;
    // Copies of meshes take little memory: their cubes are looked at in several lots.
    std::uint64_t passes_;
    std::uint64_t pass_ = 0;
    std::vector<std::uint8_t> same_before_;
    std::vector<Overlap> found_;
    std::size_t comparisons_ = 0;
};

}  // namespace

double coplanar_tolerance(double triangle_size, double scene_size) {
    constexpr double kOfTriangle = 1e-6;
    constexpr double kSinglePrecision = 0x1p-23;
    return kOfTriangle * triangle_size + kSinglePrecision * scene_size;
}

Overlaps find_overlaps(const SceneGeometry& triangles) {
    if (triangles.size() > kMostToCompare) {
        return {.pairs = {}, .is_left_out = true};
    }
    return search_overlaps(triangles).overlaps;
}

std::size_t most_comparisons(std::size_t triangles) {
    return 1'000'000 + 200 * triangles;
}

OverlapSearchResult search_overlaps(
    const SceneGeometry& triangles, const std::vector<bool>& changed) {
    EXPECT(triangles.size() <= kMostToCompare);
    EXPECT(changed.empty() || changed.size() == triangles.size());
    return OverlapSearch(triangles, bounds_of(triangles), changed).run();
}

}  // namespace quasimc
