#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "geometry/scene_geometry.h"
#include "scene/overlap/overlap_search.h"

namespace quasimc {

/// The overlaps of scenes that follow each other and differ little, as in growth and at the points
/// of a sweep: pairs of unchanged triangles are not compared again. The result equals that of
/// find_overlaps(); where this is not certain, all pairs are compared.
class KnownOverlaps {
  public:
    /// @param owners  key of each triangle's organ, for example its id; triangles of an organ are
    ///        contiguous
    [[nodiscard]] Overlaps find(
        std::shared_ptr<const SceneGeometry> triangles, const std::vector<std::int64_t>& owners);

    /// Number of changed triangles in the last search; empty: all were compared.
    [[nodiscard]] std::optional<std::size_t> changed() const { return last_changed_; }

  private:
    /// Triangles of one organ.
    struct Run {
        std::int64_t owner = 0;
        std::uint32_t first = 0, count = 0;
    };
    [[nodiscard]] static std::vector<Run> runs_of(const std::vector<std::int64_t>& owners);
    /// New numbers of the known triangles.
    struct Matching {
        std::vector<std::uint32_t> new_number;  ///< by known triangle; kGone if removed
        std::vector<bool> changed;              ///< by triangle of the new scene
        std::size_t changed_count = 0;
    };
    static constexpr std::uint32_t kGone = 0xFFFFFFFFU;
    [[nodiscard]] Matching match(
        const SceneGeometry& triangles, const std::vector<Run>& runs) const;
    [[nodiscard]] bool can_go_on(const Bounds& bounds) const;
    [[nodiscard]] std::optional<OverlapSearchResult> find_among_changed(
        const SceneGeometry& triangles, const Bounds& bounds, const std::vector<Run>& runs);

    // The last search: its triangles, their bounds and runs, and its result.
    std::shared_ptr<const SceneGeometry> triangles_;
    Bounds bounds_;
    std::vector<Run> runs_;
    OverlapSearchResult known_;
    std::optional<std::size_t> last_changed_;
};

}  // namespace quasimc
