#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "geometry/mesh/crossings.h"
#include "raster/cut_triangle.h"
#include "raster/projected_scene.h"
#include "raster/triangle_parts.h"

namespace quasimc {

/// Patches: parts of triangles with constant exitance. A triangle of level k is cut into 4^k
/// similar parts, four to each part of level k - 1. Where surfaces cross, parts are cut once more,
/// so that none lies on both sides of another surface (CutTriangle).
class Patches {
  public:
    /// The finest useful level.
    static constexpr int kFinest = 7;
    static constexpr std::uint8_t kNone = 255;  ///< a triangle without patches

    Patches() = default;
    /// @param levels  by triangle, up to kFinest, or kNone
    /// @param crossings  in the order of their triangles, whose levels are at least 1
    explicit Patches(
        std::vector<std::uint8_t> levels, std::span<const SurfaceCrossing> crossings = {});

    /// Number of patches of all triangles.
    [[nodiscard]] std::uint32_t count() const { return first_.back(); }
    [[nodiscard]] std::uint32_t triangles() const {
        return static_cast<std::uint32_t>(levels_.size());
    }
    [[nodiscard]] bool has(std::uint32_t triangle) const { return levels_[triangle] != kNone; }
    [[nodiscard]] int level(std::uint32_t triangle) const { return levels_[triangle]; }
    /// The patches of a triangle are [first(triangle), first(triangle + 1)).
    [[nodiscard]] std::uint32_t first(std::uint32_t triangle) const { return first_[triangle]; }
    /// The cuts of a triangle that others cross; null if none does.
    [[nodiscard]] const CutTriangle* cut_of(std::uint32_t triangle) const {
        return cut_of_.empty() || cut_of_[triangle] == 0 ? nullptr : &cuts_[cut_of_[triangle] - 1];
    }
    /// Number of cut triangles.
    [[nodiscard]] std::size_t cut_triangles() const { return cuts_.size(); }
    /// The patch that contains a point of a triangle.
    [[nodiscard]] std::uint32_t at(std::uint32_t triangle, double u, double v) const {
        const std::uint32_t part = TriangleParts(level(triangle)).at(u, v);
        const CutTriangle* cut = cut_of(triangle);
        return first(triangle) + (cut == nullptr ? part : cut->patch(part, u, v));
    }
    /// The area fraction of patch number `i` of a triangle.
    [[nodiscard]] double share(std::uint32_t triangle, std::uint32_t i) const;

    /// Calls visit(patch, fraction) for the parts of a line on a triangle.
    /// @param scratch  temporary memory
    template <typename Visit>
    void cut(
        std::uint32_t triangle,
        const Barycentric& a,
        const Barycentric& b,
        std::vector<TriangleParts::Segment>& scratch,
        const Visit& visit) const {
        const std::uint32_t first = first_[triangle];
        const CutTriangle* cut = cut_of(triangle);
        for (const TriangleParts::Segment& segment :
             TriangleParts(level(triangle)).segments(a, b, scratch)) {
            if (cut == nullptr) {
                visit(first + segment.part, segment.share());
                continue;
            }
            const auto at = [&](double f) {
                return Point2{a.u + f * (double{b.u} - a.u), a.v + f * (double{b.v} - a.v)};
            };
            cut->cut(
                segment.part, at(segment.begin), at(segment.end),
                [&](std::uint32_t patch, double share) {
                    visit(first + patch, share * segment.share());
                });
        }
    }

  private:
    std::vector<std::uint8_t> levels_;
    std::vector<std::uint32_t> first_{0};
    std::vector<CutTriangle> cuts_;
    std::vector<std::uint32_t> cut_of_;  // 1 + index in cuts_, by triangle; 0: none
};

}  // namespace quasimc
