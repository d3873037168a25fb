#include <cmath>

#include "geometry/cast/intersector.h"

namespace quasimc {

namespace {

struct Crossing {
    double t = 0, u = 0, v = 0;
    bool found = false;
};

/// Where a ray's line meets a triangle (Moeller and Trumbore 1997), in double precision. Borders
/// belong to the triangle; a line in its plane does not meet it.
Crossing cross_triangle(const LocalMesh& mesh, std::uint32_t triangle, const Ray& ray) {
    const Vec3 corner = mesh.vertex(triangle, 0);
    const Vec3 edge1 = mesh.vertex(triangle, 1) - corner;
    const Vec3 edge2 = mesh.vertex(triangle, 2) - corner;
    const Vec3 p = cross(ray.direction, edge2);
    const double determinant = dot(edge1, p);
    if (determinant == 0) {
        return {};
    }
    const Vec3 from_corner = ray.origin - corner;
    const double u = dot(from_corner, p) / determinant;
    const Vec3 q = cross(from_corner, edge1);
    const double v = dot(ray.direction, q) / determinant;
    const double t = dot(edge2, q) / determinant;
    return {t, u, v, u >= 0 && v >= 0 && u + v <= 1};
}

class BruteForceIntersector final : public Intersector {
  public:
    explicit BruteForceIntersector(const LocalMesh& mesh) : mesh_(mesh) {}

    [[nodiscard]] Hit closest(const Ray& ray) const override {
        std::uint32_t best = kNoTriangle;
        Crossing at{ray.far, 0, 0, false};
        for (std::uint32_t i = 0; i < mesh_.triangle_count(); ++i) {
            const Crossing crossing = cross_triangle(mesh_, i, ray);
            if (crossing.found && crossing.t > ray.near && crossing.t < at.t) {
                best = i;
                at = crossing;
            }
        }
        return best == kNoTriangle ? Hit{} : make_hit(best, at);
    }

    void closest(Packet& packet) const override {
        for (std::size_t i = 0; i < kPacket; ++i) {
            const Ray ray{packet.origin(i), packet.direction(i), packet.near[i], packet.far[i]};
            packet.set_hit(i, ray.far < ray.near ? Hit{} : closest(ray));
        }
    }

    [[nodiscard]] bool occluded(const Ray& ray, std::uint32_t except) const override {
        for (std::uint32_t i = 0; i < mesh_.triangle_count(); ++i) {
            const Crossing crossing = cross_triangle(mesh_, i, ray);
            if (crossing.found && crossing.t > ray.near && crossing.t < ray.far && i != except) {
                return true;
            }
        }
        return false;
    }

  private:
    [[nodiscard]] Hit make_hit(std::uint32_t triangle, const Crossing& at) const {
        const Vec3 corner = mesh_.vertex(triangle, 0);
        const Vec3 normal =
            cross(mesh_.vertex(triangle, 1) - corner, mesh_.vertex(triangle, 2) - corner);
        return {
            triangle,
            static_cast<float>(at.t),
            static_cast<float>(at.u),
            static_cast<float>(at.v),
            {static_cast<float>(normal.x), static_cast<float>(normal.y),
             static_cast<float>(normal.z)}};
    }

    const LocalMesh& mesh_;
};

}  // namespace

std::unique_ptr<Intersector> make_brute_force_intersector(const LocalMesh& mesh) {
    return std::make_unique<BruteForceIntersector>(mesh);
}

}  // namespace quasimc
