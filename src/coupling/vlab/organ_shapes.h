#pragma once

#include <vector>

#include "coupling/protocol/messages.h"
#include "coupling/vlab/specification.h"

namespace quasimc {

/// Shape of a module in the scene.
struct OrganShape {
    std::vector<Triangle> triangles;  ///< the plant's axes, y up; empty: it receives no light
    SideMaterials materials;
};

/// Turns the modules that follow queries into shapes, in the frame of the turtle:
///
/// | P(a, b, [mt, [mb]])        | rhombus, b long along the heading, 2a wide                     |
/// | T(a, b, [mt, [mb]])        | isosceles triangle, b high along the heading, base 2a          |
/// | U(l1, l2, h, beta, [...])  | triangle of height h whose base has sides l1 and l2, at an     |
/// |                            | angle of beta degrees to the heading                           |
/// | S(id, s), S(id, sx, sy[, sz]) | Bezier surface, scaled                                      |
/// | I(r, l, [mt, [mb]])        | side of a cylinder, l long along the heading                   |
/// | polygons that come along   | as they are                                                    |
///
/// The upper side of flat organs faces the turtle's up; that of cylinders is the outside. An
/// invalid module has no triangles; the reason is reported once for each kind of module.
class OrganShapes {
  public:
    /// Both outlive the object.
    OrganShapes(const Specification& spec, Notices& notices) : spec_(spec), notices_(notices) {}

    [[nodiscard]] OrganShape make(const Pass& pass, const Query& query);
    /// Makes the shape of a sensor: for P a rectangle, a long along the heading and b wide;
    /// otherwise the organ's shape.
    [[nodiscard]] OrganShape make_sensor(const Pass& pass, const Query& query);

  private:
    class Maker;

    const Specification& spec_;
    Notices& notices_;
};

}  // namespace quasimc
