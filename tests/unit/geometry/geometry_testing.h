#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "geometry/cast/intersector.h"
#include "geometry/mesh/cell.h"
#include "geometry/mesh/local_mesh.h"
#include "quasimc/mesh.h"

namespace quasimc::test {

/// Random numbers that are the same everywhere.
class Random {
  public:
    explicit Random(std::uint64_t seed) : bits_(seed) {}
    /// Uniform in [0, 1).
    double uniform();
    /// Uniform in [low, high).
    double between(double low, double high) { return low + (high - low) * uniform(); }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(uniform() * n); }
    /// A point of the box [low, high)^3.
    Vec3 point(double low, double high);
    /// Uniform over the unit sphere, components rounded to single precision.
    Vec3 direction();

  private:
    std::mt19937_64 bits_;
};

/// Half of the unit square, and the direction in which it is seen from above.
inline const Triangle kLeaf{Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 0}};
inline const Vec3 kDown{0, 0, -1};

/// The corners of all triangles of a mesh, in order.
[[nodiscard]] std::vector<Vec3> vertices(const LocalMesh& mesh);

/// The largest coordinate of `points` along `direction`.
[[nodiscard]] double reach(const std::vector<Vec3>& points, const Vec3& direction);

/// The components rounded to single precision.
[[nodiscard]] Vec3 rounded(const Vec3& v);

/// Triangles of all shapes: corners scattered by `size` about centers in the unit cube.
[[nodiscard]] std::vector<Triangle> random_soup(std::size_t count, double size, Random& random);

/// A point inside a triangle of the mesh, exactly on it but for double rounding.
[[nodiscard]] Vec3 random_point_on(const LocalMesh& mesh, std::uint32_t triangle, Random& random);

/// Whether a ray comes so near to a border of a triangle, to an end of its own, or to two triangles
/// at once, that rounding may decide what it meets first. All lengths in local units.
[[nodiscard]] bool is_close_call(const LocalMesh& mesh, const Ray& ray);

/// What a ray meets first.
struct FirstHit {
    bool found = false;
    std::size_t triangle = 0;    ///< of those given
    double t = 0;                ///< world units
    bool is_close_call = false;  ///< rounding may decide what is met first
};

/// The first hit among copies of `triangles`, shifted by up to `reach` periods either way along the
/// periodic axes of `cell`, in double precision, at t > near. Copies that the ray starts on are for
/// the caller to avoid.
[[nodiscard]] FirstHit first_hit_among_copies(
    const std::vector<Triangle>& triangles,
    const Cell& cell,
    int reach,
    const Vec3& origin,
    const Vec3& direction,
    double near);

/// The sum over triangles of the variance of their visible area, from 40 samples.
/// @param caught  draws a sample: area by triangle
[[nodiscard]] double variance_of_areas(
    const std::function<std::map<std::uint32_t, double>()>& caught);

}  // namespace quasimc::test
