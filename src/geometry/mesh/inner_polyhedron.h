#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// A closed surface about most of the convex hull of points: its corners are the points that are
/// the outermost in one of many directions.
///
/// A point that is inside the plane of each triangle is inside the hull, even where rounding has
/// made the surface not quite convex: it sees all triangles from inside, so the surface winds
/// around it.
class InnerPolyhedron {
  public:
    /// @param points  without four points that span a volume, nothing is inside
    explicit InnerPolyhedron(std::span<const Vec3> points);

    /// Whether a point lies in the convex hull of the points; false if uncertain.
    [[nodiscard]] bool holds(const Vec3& p) const;

  private:
    struct Facet {
        std::array<Vec3, 3> corners;
        Vec3 outward;       // unit vector; 0 without an area
        double height = 0;  // of the corners along it
    };

    [[nodiscard]] bool is_beyond(const Facet& facet, const Vec3& p) const {
        return dot(facet.outward, p) > facet.height + tolerance_;
    }
    void add_facet(const Vec3& a, const Vec3& b, const Vec3& c);
    bool start(std::vector<Vec3>& points);
    void include(const Vec3& p);

    double tolerance_ = 0;
    std::vector<Facet> facets_;
};

}  // namespace quasimc
