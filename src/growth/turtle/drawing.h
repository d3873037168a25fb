#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "quasimc/mesh.h"

namespace quasimc {

struct BezierSurface;  // growth/view/surface.h

/// Position and unit directions of a turtle; at first those of an upright plant.
struct TurtleFrame {
    Vec3 position;
    Vec3 heading{0, 1, 0};
    Vec3 left{-1, 0, 0};
    Vec3 up{0, 0, -1};
};

/// A segment between two nodes: a cylinder, or a cone if its radii differ.
struct DrawnSegment {
    Vec3 from, to;
    double radius_from = 0, radius_to = 0;
    /// The frame at its start, for the corners of its sides.
    TurtleFrame frame;
};

/// The module of the string that draws: its symbol, its number in the string and the branch.
struct DrawnModule {
    char symbol = 0;
    std::size_t index = 0;   ///< from 0, among all modules of the string
    std::size_t branch = 0;  ///< number of '[' before it whose branch it is in; 0: the main axis
    std::size_t order = 0;   ///< number of branches it is in
};

/// Receives shapes from a turtle, in the order of the string. Colours are indices, 0 to 255.
class Drawing {
  public:
    virtual ~Drawing() = default;
    Drawing() = default;
    Drawing(const Drawing&) = delete;
    Drawing& operator=(const Drawing&) = delete;

    /// Called before the shapes of a module. A segment belongs to the module that began it, though
    /// it is drawn when its end is known.
    virtual void begin_module(const DrawnModule& module) = 0;
    virtual void segment(const DrawnSegment& segment, int color) = 0;
    /// May have fewer than three corners, and repeat corners.
    virtual void polygon(std::span<const Vec3> corners, int color) = 0;
    /// Triangles of generalized cylinders and patches.
    virtual void triangles(std::span<const Triangle> triangles, int color) = 0;
    virtual void sphere(const Vec3& center, double radius, int color) = 0;
    /// @param left, heading  its plane
    virtual void disc(const TurtleFrame& frame, double radius, int color) = 0;
    /// An instance of a predefined surface. @param transform  from the surface's frame
    virtual void surface(const BezierSurface& surface, const Affine& transform, int color) = 0;
};

}  // namespace quasimc
