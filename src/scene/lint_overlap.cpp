// Coplanar triangles that overlap. Which of them a ray meets first is left to rounding, so both get
// a wrong share of the light.
//
// Triangles are sorted into grids of cubes, four times finer from level to level; a triangle is at
// home on the level whose cubes are at least twice its size, and visits the coarser ones. Two
// triangles that overlap share a cube on the home level of the larger. In a cube they are sorted by
// a function of the normal that has the same value for both sides, so that only triangles which are
// nearly parallel are compared.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <span>
#include <tuple>

#include <fmt/format.h>

#include "scene/coplanar.h"
#include "scene/lint.h"

namespace quasimc {
namespace {

constexpr std::size_t kMostToCompare = 3'000'000;
constexpr int kLevels = 9;

/// A triangle in a cube of the grids.
struct Entry {
    std::uint64_t cube;
    float facing;  ///< |cos| of the angle between the normal and kGeneric
    float blur;    ///< how much `facing` of a coplanar triangle may differ
    std::uint32_t triangle;
};

bool operator<(const Entry& a, const Entry& b) {
    return std::tie(a.cube, a.facing, a.triangle) < std::tie(b.cube, b.facing, b.triangle);
}

/// A direction that normals of modelled organs are seldom symmetric about.
constexpr Vec3 kGeneric{0.3518, 0.7143, 0.6049};

/// Triangle `small` lies on triangle `large`.
struct Overlap {
    std::uint32_t small, large;
    bool is_same;
};

class OverlapSearch {
  public:
    explicit OverlapSearch(const Scene& scene)
        : triangles_(scene.triangles()),
          low_(scene.bounds().low),
          size_(size_of(scene.bounds())),
          most_comparisons_(1'000'000 + 200 * scene.triangles().size()),
          is_found_(scene.triangles().size()) {}

    std::vector<Overlap> run() {
        enter_all();
        std::sort(natives_.begin(), natives_.end());
        std::sort(visitors_.begin(), visitors_.end());
        auto visitor = visitors_.begin();
        for (auto first = natives_.begin(); first != natives_.end();) {
            const std::uint64_t cube = first->cube;
            const auto in_cube = [&](const Entry& e) { return e.cube == cube; };
            const auto last = std::find_if_not(first, natives_.end(), in_cube);
            visitor = std::find_if(
                visitor, visitors_.end(), [&](const Entry& e) { return e.cube >= cube; });
            const std::span homes(first, last);
            for (const Entry& native : homes) {
                compare(native, homes);
            }
            for (; visitor != visitors_.end() && visitor->cube == cube; ++visitor) {
                compare(*visitor, homes);
            }
            first = last;
        }
        return std::move(found_);
    }

    /// Whether there were too many neighbours to compare all.
    [[nodiscard]] bool gave_up() const { return comparisons_ > most_comparisons_; }

  private:
    /// Distance from a plane that counts as none: what single precision can't tell, or 1e-6 of the
    /// triangle.
    [[nodiscard]] double thickness(double triangle_size) const {
        constexpr double kSinglePrecision = 0x1p-23;
        return 1e-6 * triangle_size + kSinglePrecision * size_;
    }

    [[nodiscard]] int home_level(double triangle_size) const {
        return std::clamp(std::ilogb(size_ / triangle_size) / 2, 0, kLevels - 1);
    }

    void enter_all() {
        std::vector<std::int16_t> level_of(triangles_.size(), -1);
        std::array<bool, kLevels> is_home{};
        for (std::size_t i = 0; i < triangles_.size(); ++i) {
            const Triangle t = triangles_[i];
            const double size = size_of(bounds_of(t));
            // Slivers about as thin as the tolerance lie in no plane in particular.
            constexpr double kThin = 8;
            if (size > 0 && height(t) > kThin * thickness(size)) {
                level_of[i] = static_cast<std::int16_t>(home_level(size));
                is_home[static_cast<std::size_t>(level_of[i])] = true;
            }
        }
        // What is entered is counted first: growing lists would take several times the memory.
        std::size_t natives = 0, visitors = 0;
        const auto for_each_entry = [&](const auto& visit) {
            for (std::size_t i = 0; i < triangles_.size(); ++i) {
                for (int level = 0; level <= level_of[i]; ++level) {
                    if (is_home[static_cast<std::size_t>(level)]) {
                        visit(static_cast<std::uint32_t>(i), level, level == level_of[i]);
                    }
                }
            }
        };
        for_each_entry([&](std::uint32_t i, int level, bool is_native) {
            (is_native ? natives : visitors) += cubes_of(i, level);
        });
        natives_.reserve(natives);
        visitors_.reserve(visitors);
        for_each_entry(
            [&](std::uint32_t i, int level, bool is_native) { enter(i, level, is_native); });
    }

    /// How many cubes of a level a triangle's bounds reach into.
    [[nodiscard]] std::uint64_t cubes_of(std::uint32_t i, int level) const {
        const Bounds bounds = bounds_of(triangles_[i]);
        const double blur = thickness(size_of(bounds));
        const double cubes = std::ldexp(1.0, 2 * level) / size_;  // per unit of length
        const auto along = [&](double from, double to) {
            return static_cast<std::uint64_t>((to + blur) * cubes) + 1 -
                   static_cast<std::uint64_t>(std::max(0.0, (from - blur) * cubes));
        };
        const Vec3 low = bounds.low - low_;
        const Vec3 high = bounds.high - low_;
        return along(low.x, high.x) * along(low.y, high.y) * along(low.z, high.z);
    }

    void enter(std::uint32_t i, int level, bool is_native) {
        const Triangle t = triangles_[i];
        const Bounds bounds = bounds_of(t);
        const double blur = thickness(size_of(bounds));
        const double cubes = std::ldexp(1.0, 2 * level) / size_;  // per unit of length
        const auto first_cube = [&](double p) {
            return static_cast<std::uint64_t>(std::max(0.0, (p - blur) * cubes));
        };
        const auto cubes_along = [&](double from, double to) {
            return static_cast<std::uint64_t>((to + blur) * cubes) + 1 - first_cube(from);
        };
        const Vec3 low = bounds.low - low_;
        const Vec3 high = bounds.high - low_;
        const std::uint64_t nx = cubes_along(low.x, high.x);
        const std::uint64_t ny = cubes_along(low.y, high.y);
        const std::uint64_t nz = cubes_along(low.z, high.z);
        Entry entry{0, 0, 0, i};
        entry.facing = static_cast<float>(std::abs(dot(normalized(area_vector(t)), kGeneric)));
        entry.blur = static_cast<float>(4 * blur / height(t) + 1e-6);
        for (std::uint64_t n = 0; n < nx * ny * nz; ++n) {
            entry.cube = static_cast<std::uint64_t>(level);
            entry.cube = entry.cube << 20 | (first_cube(low.x) + n % nx);
            entry.cube = entry.cube << 20 | (first_cube(low.y) + n / nx % ny);
            entry.cube = entry.cube << 20 | (first_cube(low.z) + n / nx / ny);
            (is_native ? natives_ : visitors_).push_back(entry);
        }
    }

    /// Looks among the triangles at home in a cube for the first that `entry` lies on.
    void compare(const Entry& entry, std::span<const Entry> homes) {
        if (is_found_[entry.triangle]) {
            return;
        }
        const Triangle small = triangles_[entry.triangle];
        const Bounds bounds = bounds_of(small);
        const double tolerance = thickness(size_of(bounds));
        const auto is_before = [](const Entry& e, float facing) { return e.facing < facing; };
        auto other =
            std::lower_bound(homes.begin(), homes.end(), entry.facing - entry.blur, is_before);
        for (; other != homes.end() && other->facing <= entry.facing + entry.blur; ++other) {
            if (other->triangle == entry.triangle) {
                continue;
            }
            if (++comparisons_ > most_comparisons_) {
                return;
            }
            const Triangle large = triangles_[other->triangle];
            if (lies_on(small, bounds, large, tolerance)) {
                found_.push_back(
                    {entry.triangle, other->triangle, is_same(small, large, tolerance)});
                is_found_[entry.triangle] = true;
                is_found_[other->triangle] = true;
                return;
            }
        }
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
    Vec3 low_;
    double size_;
    std::size_t most_comparisons_;
    std::vector<Entry> natives_, visitors_;
    std::vector<bool> is_found_;
    std::vector<Overlap> found_;
    std::size_t comparisons_ = 0;
};

/// "12 triangles are the same as triangles of organ 'b' (id 2)", for each pair of organs.
std::vector<Warning> words_for(const Scene& scene, const std::vector<Overlap>& overlaps) {
    const auto organ_of = [&](std::uint32_t triangle) {
        return scene.regions()[scene.region_of(triangle).value].organ.value;
    };
    std::map<std::tuple<bool, std::uint32_t, std::uint32_t>, std::size_t> pairs;
    for (const Overlap& o : overlaps) {
        const std::uint32_t a = organ_of(o.small);
        const std::uint32_t b = organ_of(o.large);
        ++pairs[{!o.is_same, std::max(a, b), std::min(a, b)}];
    }
    WarningKind same("pairs of organs have triangles in common");
    WarningKind upon("pairs of organs have triangles that overlap in one plane");
    for (const auto& [key, count] : pairs) {
        const auto& [is_upon, second, first] = key;
        const std::string other = first == second
                                      ? std::string("others of the same organ")
                                      : "triangles of " + words_for(scene.organs()[first]);
        const std::string number = count == 1 ? "a triangle" : fmt::format("{} triangles", count);
        WarningKind& kind = is_upon ? upon : same;
        kind.add(
            words_for(scene.organs()[second]),
            fmt::format(
                "has {} {} {}: which of them light hits is left to rounding", number,
                is_upon ? "in one plane with, and overlapping," : "with the same corners as",
                other));
    }
    std::vector<Warning> warnings = std::move(same).finish();
    std::vector<Warning> more = std::move(upon).finish();
    std::move(more.begin(), more.end(), std::back_inserter(warnings));
    return warnings;
}

}  // namespace

std::vector<Warning> lint_overlap(const Survey& survey) {
    const Scene& scene = survey.scene;
    if (scene.triangles().size() > kMostToCompare) {
        return {
            {"scene",
             fmt::format(
                 "has more than {} triangles: overlaps were not looked for", kMostToCompare)}};
    }
    OverlapSearch search(scene);
    std::vector<Warning> warnings = words_for(scene, search.run());
    if (search.gave_up()) {
        warnings.push_back(
            {"scene", "has too many triangles close together: not all were compared for overlaps"});
    }
    return warnings;
}

}  // namespace quasimc
