#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "growth/turtle/drawing.h"
#include "growth/turtle/turtle_frame.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// Triangles of one colour, or an instance of a surface.
struct DrawnPart {
    int color = 0;
    Mesh triangles;                      ///< in the plant's units; empty for an instance
    std::shared_ptr<const Mesh> shared;  ///< the mesh of an instance; null for triangles
    Affine transform;                    ///< from an instance's mesh to the plant
};

/// The shapes of one module.
struct DrawnOrgan {
    DrawnModule module;
    std::vector<DrawnPart> parts;
};

/// Collects the shapes of a plant as triangles, for each module and colour. Cylinders have no caps;
/// connected ones share a ring. Triangles of no area, or with numbers that are not finite, are
/// omitted.
class MeshDrawing : public Drawing {
  public:
    /// @param sides  of cylinders, spheres and discs; at least 3 are made
    explicit MeshDrawing(int sides);

    void begin_module(const DrawnModule& module) override { module_ = module; }
    void segment(const DrawnSegment& segment, int color) override;
    /// Polygons whose sides cross become the triangles at their first corner.
    void polygon(std::span<const Vec3> corners, int color) override;
    void triangles(std::span<const Triangle> triangles, int color) override;
    void sphere(const Vec3& center, double radius, int color) override;
    void disc(const TurtleFrame& frame, double radius, int color) override;
    void surface(const BezierSurface& surface, const Affine& transform, int color) override;

    /// All organs with shapes, in the order of the string.
    [[nodiscard]] const std::vector<DrawnOrgan>& organs() const { return organs_; }
    /// The same; the drawing is then empty.
    [[nodiscard]] std::vector<DrawnOrgan> take_organs();

  private:
    /// A ring of corners about an axis.
    struct Ring {
        Vec3 center;
        double radius = 0;
        HeadingAndUp axes;
    };

    [[nodiscard]] DrawnOrgan& organ();
    /// Adds the triangles of a mesh that have an area.
    void add(Mesh mesh, int color);
    void add_corners(const Ring& ring, std::vector<Vec3>& corners) const;

    std::vector<Turn> angles_;  // of the corners of rings
    DrawnModule module_;
    std::vector<DrawnOrgan> organs_;
    std::optional<Ring> last_ring_;
};

}  // namespace quasimc
