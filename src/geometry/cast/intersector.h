#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <stop_token>
#include <string_view>

#include "geometry/mesh/local_mesh.h"

namespace quasimc {

inline constexpr std::uint32_t kNoTriangle = 0xFFFFFFFFU;

/// A ray in local coordinates; hits count for near < t < far (t in units of the direction's
/// length).
struct Ray {
    Vec3 origin;
    Vec3 direction;  ///< unit length
    float near = 0;
    float far = std::numeric_limits<float>::infinity();
};

/// The first hit of a ray.
struct Hit {
    std::uint32_t triangle = kNoTriangle;
    float t = 0;
    float u = 0, v = 0;  ///< coordinates of LocalMesh::point(triangle, u, v)
    std::array<float, 3>
        normal{};  ///< area_vector of the triangle (not normalized), local coordinates

    [[nodiscard]] bool found() const { return triangle != kNoTriangle; }
};

inline constexpr std::size_t kPacket = 16;

/// Sixteen rays and their hits; a lane with far < near is inactive.
struct alignas(64) Packet {
    std::array<float, kPacket> origin_x, origin_y, origin_z;
    std::array<float, kPacket> direction_x, direction_y, direction_z;
    std::array<float, kPacket> near, far;
    std::array<float, kPacket> t, u, v, normal_x, normal_y, normal_z;
    std::array<std::uint32_t, kPacket> triangle;

    void set_origin(std::size_t lane, const Vec3& p) {
        origin_x[lane] = static_cast<float>(p.x);
        origin_y[lane] = static_cast<float>(p.y);
        origin_z[lane] = static_cast<float>(p.z);
    }
    void set_direction(std::size_t lane, const Vec3& d) {
        direction_x[lane] = static_cast<float>(d.x);
        direction_y[lane] = static_cast<float>(d.y);
        direction_z[lane] = static_cast<float>(d.z);
    }
    void set_hit(std::size_t lane, const Hit& hit) {
        triangle[lane] = hit.triangle;
        t[lane] = hit.t;
        u[lane] = hit.u;
        v[lane] = hit.v;
        normal_x[lane] = hit.normal[0];
        normal_y[lane] = hit.normal[1];
        normal_z[lane] = hit.normal[2];
    }
    [[nodiscard]] Vec3 origin(std::size_t lane) const {
        return {origin_x[lane], origin_y[lane], origin_z[lane]};
    }
    [[nodiscard]] Vec3 direction(std::size_t lane) const {
        return {direction_x[lane], direction_y[lane], direction_z[lane]};
    }
    [[nodiscard]] Hit hit(std::size_t lane) const {
        return {
            triangle[lane],
            t[lane],
            u[lane],
            v[lane],
            {normal_x[lane], normal_y[lane], normal_z[lane]}};
    }
};

/// Intersects rays with the triangles of a mesh. Const and free of locks after construction. The
/// mesh outlives the intersector.
class Intersector {
  public:
    virtual ~Intersector() = default;
    Intersector() = default;
    Intersector(const Intersector&) = delete;
    Intersector& operator=(const Intersector&) = delete;

    /// The hit with the smallest t in (near, far).
    [[nodiscard]] virtual Hit closest(const Ray& ray) const = 0;
    /// The closest hits of sixteen rays with nearby origins and similar directions.
    virtual void closest(Packet& packet) const = 0;
    /// Whether there is any hit in (near, far), except with triangle `except`. Unlike closest(),
    /// which may report the rounding of the origin as a hit just beyond `near`, this compares t in
    /// double precision.
    [[nodiscard]] virtual bool occluded(const Ray& ray, std::uint32_t except) const = 0;
};

/// The default accelerator: Embree.
/// @throws StopRequested  if a stop is requested while the tree is built
[[nodiscard]] std::unique_ptr<Intersector> make_embree_intersector(
    const LocalMesh& mesh, const std::stop_token& stop = {});

/// Tests every triangle in double precision: the reference of the tests, and for scenes of a few
/// triangles.
[[nodiscard]] std::unique_ptr<Intersector> make_brute_force_intersector(const LocalMesh& mesh);

}  // namespace quasimc
