#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/patches.h"
#include "raster/projected_scene.h"
#include "raster/triangle_block.h"
#include "raster/triangle_rows.h"

namespace quasimc {

/// A triangle as lines intersect it.
struct LineTriangle {
    std::uint32_t first_patch = 0;
    std::uint8_t level = 0;  ///< see Patches
    bool is_sensor = false;
    float least_cosine = 0;            ///< smaller cosines are ignored
    const CutTriangle* cut = nullptr;  ///< where others cross it: its patches
};

/// Triangles in blocks, the last one padded with triangles that no line hits.
struct LineTriangles {
    std::vector<TriangleBlock> corners;
    std::vector<BlockPatches> patches;
    std::vector<std::uint8_t> plain;  ///< by block, a bit for each lane: neither cut nor narrow
    std::vector<LineTriangle> each;
};

/// The triangles of a scene that have patches; scene and patches must outlive them.
/// @param least_cosines  by triangle; empty: 0
[[nodiscard]] LineTriangles line_triangles(
    const ProjectedScene& scene, const Patches& patches, std::span<const float> least_cosines = {});

class LineHitScratch;

/// All surfaces along parallel lines through a scene, in order: a bundle of rays, rasterized.
///
/// Lines form a regular grid across the beam with a uniform shift, so that (hits of a patch) x
/// line_area() is an unbiased estimate of the patch's area across the beam. In a periodic scene
/// each line goes through the infinite scene: on the plane of the beam, which repeats, the images
/// of all triangles that cover a point are all that the line through it meets, and their depths
/// give the order. Nothing is followed from cell to cell.
///
/// Hits lie in the scratch of find_line_hits(), which serves one beam at a time.
class LineHits {
  public:
    struct Spec {
        Vec3 direction;                   ///< unit
        double rotation = 0;              ///< see ProjectionPlane
        double shift_s = 0, shift_t = 0;  ///< of the grid, 0..1 of a step
        double line_area = 1;  ///< requested area per line across the beam: local units squared
    };

    /// A patch that a line hits: 2 * patch, plus 1 if light that travels along the direction comes
    /// to its lower side. Sensors have kSensor on top.
    using Hit = std::uint32_t;
    static constexpr Hit kSensor = 0x80000000U;

    [[nodiscard]] double line_area() const { return line_area_; }
    /// Number of hits of all lines.
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Number of lines that hit each triangle, in their order.
    [[nodiscard]] std::span<const std::uint32_t> counts() const { return counts_; }

    /// Number of hits that may be read beyond the end of a line: hits of further lines, or of some
    /// patch or 0 beyond the last line.
    static constexpr std::size_t kReadAhead = 16;
    /// Calls visit(span of Hit) for each line with hits, in order along the direction.
    template <typename Visit>
    void for_each_line(const Visit& visit) const {
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
            if (first_[i] < first_[i + 1]) {
                visit(std::span(hits_ + first_[i], first_[i + 1] - first_[i]));
            }
        }
    }

    /// The position of a hit along its line, local units: differences are distances.
    /// @param hit  of for_each_line()
    [[nodiscard]] float depth(const Hit& hit) const { return depth_of(keys_[&hit - hits_]); }

  private:
    friend class LineHitFinder;

    double line_area_ = 0;
    std::size_t size_ = 0;
    std::span<const std::uint32_t> counts_, first_;
    const Hit* hits_ = nullptr;
    const std::uint64_t* keys_ = nullptr;  // of the hits
};

/// Finds the hits of a beam.
/// @param scene  its bounds and periods
/// @param triangles  line_triangles() of the scene
[[nodiscard]] LineHits find_line_hits(
    const ProjectedScene& scene,
    const LineTriangles& triangles,
    const LineHits::Spec& spec,
    LineHitScratch& scratch);

/// Memory that find_line_hits() uses.
class LineHitScratch {
    friend class LineHitFinder;

    BlockSpans spans_{};  // of the current triangles
    // For each hit, unordered: the line, and depth_key(). The size exceeds the number of hits.
    std::vector<std::uint32_t> lines_;
    std::vector<std::uint64_t> keys_;
    std::vector<std::uint64_t> sorted_;  // keys line by line
    std::vector<std::uint32_t> first_;   // first hit of each line
    std::vector<LineHits::Hit> hits_;
    std::vector<std::uint32_t> counts_;
};

}  // namespace quasimc
