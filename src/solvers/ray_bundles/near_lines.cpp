#include "solvers/ray_bundles/near_lines.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "solvers/ray_bundles/bundle_exchange.h"

namespace quasimc {
namespace {

/// Surfaces within this multiple of the longest edge of a patch are near.
constexpr double kNearLengths = 8;
constexpr std::uint32_t kNearDirections = 64;
/// Mean number of lines of a patch.
constexpr double kNearLinesPerPatch = 4;

/// The part two levels up that holds a patch of a triangle, or the whole triangle.
std::uint32_t grandparent(const Patches& patches, std::uint32_t triangle, std::uint32_t patch) {
    const CutTriangle* cut = patches.cut_of(triangle);
    const int level = patches.level(triangle);
    if (level < 2) {
        return 0;
    }
    return TriangleParts(level - 1).parent(
        cut != nullptr ? cut->parent(patch) : TriangleParts(level).parent(patch));
}

class NearLineFinder {
  public:
    explicit NearLineFinder(const PatchScene& scene)
        : scene_(scene), reach_(scene.patches.count()) {
        for (const PatchScene::Surface& surface : scene.surfaces) {
            const std::uint32_t i = surface.triangle;
            const double reach = surface.is_sensor ? 0 : near_distance(scene, i);
            std::fill(
                reach_.begin() + scene.patches.first(i),
                reach_.begin() + scene.patches.first(i + 1), static_cast<float>(reach));
        }
    }

    std::vector<NearLine> find() {
        const double lines = kNearLinesPerPatch * scene_.patches.count();
        const BundleGroup group{kNearDirections, scene_.area / 2 * kNearDirections / lines, 1};
        LineHitScratch scratch;
        for (std::uint32_t i = 0; i < kNearDirections; ++i) {
            add(find_line_hits(
                scene_.projected, scene_.drawn,
                {.direction = bundle_direction(group, i), .line_area = group.line_area}, scratch));
        }
        return std::move(found_);
    }

  private:
    void add(const LineHits& lines) {
        const auto weight = static_cast<float>(2 * lines.line_area() / kNearDirections);
        lines.for_each_line([&](std::span<const LineHits::Hit> line) {
            const LineHits::Hit* last = nullptr;
            for (const LineHits::Hit& hit : line) {
                if ((hit & LineHits::kSensor) != 0) {
                    continue;
                }
                if (last != nullptr) {
                    const float distance = lines.depth(hit) - lines.depth(*last);
                    add_if_near({*last ^ 1U, hit, weight}, distance);
                    add_if_near({hit, *last ^ 1U, weight}, distance);
                }
                last = &hit;
            }
        });
    }
    /// @param line  to a side of a patch
    void add_if_near(NearLine line, float distance) {
        if (distance < reach_[line.from / 2]) {
            line.to = 2 * scene_.region_of_patch[line.to / 2] + line.to % 2;
            found_.push_back(line);
        }
    }

    const PatchScene& scene_;
    std::vector<float> reach_;  // by patch
    std::vector<NearLine> found_;
};

}  // namespace

double near_distance(const PatchScene& scene, std::uint32_t triangle) {
    const LocalMesh& mesh = scene.prepared.caster().mesh();
    double longest = 0;
    for (int i = 0; i < 3; ++i) {
        const Vec3 edge = mesh.vertex(triangle, (i + 1) % 3) - mesh.vertex(triangle, i);
        longest = std::max(longest, length(edge));
    }
    return kNearLengths * std::ldexp(longest, -scene.patches.level(triangle));
}

NearLines::NearLines(const PatchScene& scene) : lines(NearLineFinder(scene).find()) {
    for (const PatchScene::Surface& surface : scene.surfaces) {
        const std::uint32_t first = scene.patches.first(surface.triangle);
        const std::uint32_t end = scene.patches.first(surface.triangle + 1);
        for (std::uint32_t i = first; i < end; ++i) {
            groups.push_back(first + grandparent(scene.patches, surface.triangle, i - first));
        }
    }
}

}  // namespace quasimc
