#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/raster/patches.h"
#include "geometry/raster/projected_scene.h"
#include "geometry/raster/triangle_rows.h"

namespace quasimc {

/// A triangle as Columns draw it.
struct ColumnTriangle {
    std::array<Vec3, 3> corners;  ///< local coordinates
    std::uint32_t first_patch = 0;
    std::uint8_t level = 0;  ///< see Patches
    bool is_sensor = false;
    float least_cosine = 0;            ///< seen at less, it is left out
    const CutTriangle* cut = nullptr;  ///< where others cross it: how it is cut into patches
};

/// The triangles of a scene that have patches, which must outlive them.
/// @param least_cosines  by triangle; empty: 0
[[nodiscard]] std::vector<ColumnTriangle> column_triangles(
    const ProjectedScene& scene, const Patches& patches, std::span<const float> least_cosines = {});

/// All that parallel lines through a scene pass, in order: a bundle of rays, rasterized.
///
/// Lines stand on a regular grid across the beam with a uniform shift, so that (times a patch is
/// passed) x line_area() is an unbiased estimate of the patch's area across the beam. In a periodic
/// scene each line goes through the infinite scene: on the plane of the beam, which repeats, the
/// images of all triangles that cover a place are all that the line through it passes, and their
/// depths tell the order. Nothing is followed from cell to cell.
///
/// Objects are used by one thread, and hold buffers for the next beam.
class Columns {
  public:
    struct Spec {
        Vec3 direction;                   ///< unit
        double rotation = 0;              ///< see ProjectionPlane
        double shift_s = 0, shift_t = 0;  ///< of the grid, 0..1 of a step
        double line_area = 1;             ///< wanted, across the beam: local units squared
    };

    /// A patch as a line passes it: 2 * patch, and 1 more if light that travels along the direction
    /// comes to its lower side. Sensors have kSensor on top.
    using Passed = std::uint32_t;
    static constexpr Passed kSensor = 0x80000000U;

    /// @param scene  where it lies, and how it repeats
    /// @param triangles  column_triangles() of the scene
    void draw(
        const ProjectedScene& scene, std::span<const ColumnTriangle> triangles, const Spec& spec);

    [[nodiscard]] double line_area() const { return line_area_; }
    /// Of all lines.
    [[nodiscard]] std::size_t size() const { return passed_.size(); }

    /// Calls visit(span of Passed) for each line that passes something, in order along the
    /// direction.
    template <typename Visit>
    void for_each_line(const Visit& visit) const {
        for (std::size_t i = 0; i + 1 < first_.size(); ++i) {
            if (first_[i] < first_[i + 1]) {
                visit(std::span(passed_).subspan(first_[i], first_[i + 1] - first_[i]));
            }
        }
    }

  private:
    struct Fragment {
        std::uint32_t line;
        float depth;
        Passed passed;
    };
    struct InLine {
        float depth;
        Passed passed;
    };
    /// Pixels of a row that a triangle covers.
    struct Stretch {
        std::int64_t row, in_row;  ///< unwrapped, and on the grid
        std::int64_t first, last;  ///< columns, unwrapped; the last is not covered
        double shift;              ///< of the row
    };

    void set_grid(const ProjectedScene& scene, const Spec& spec);
    void set_square_rows(const ProjectionPlane& plane, const Spec& spec, double lines);
    [[nodiscard]] double shift_of(std::int64_t row) const;
    void draw_triangle(const ColumnTriangle& triangle);
    void draw_stretch(const Stretch& stretch);
    void set_gradients(const ColumnTriangle& triangle, const ProjectedTriangle& corners);
    void sort_lines();
    void sort_sparse_lines();

    BeamAxis x_, y_, z_;
    double line_area_ = 0;
    std::int64_t columns_ = 0, rows_ = 0;
    bool repeats_x_ = false, repeats_y_ = false;
    double row_shift_ = 0;  // from row to row, in columns
    Vec3 direction_;
    bool is_turned_ = false;  // grid and direction are no right-handed frame

    // The triangle at hand.
    PlaneGradient z_of_, u_of_, v_of_;
    double low_z_ = 0, high_z_ = 0;
    Passed first_passed_ = 0;
    int level_ = 0;
    const CutTriangle* cut_ = nullptr;

    std::vector<Fragment> fragments_;
    std::vector<InLine> sorted_;
    std::vector<std::uint32_t> first_;
    std::vector<Passed> passed_;
};

}  // namespace quasimc
