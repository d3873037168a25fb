#include "geometry/cast/intersector.h"
#include "geometry/cast/line_crossing.h"

namespace quasimc {

namespace {

class BruteForceIntersector final : public Intersector {
  public:
    explicit BruteForceIntersector(const LocalMesh& mesh) : mesh_(mesh) {}

    [[nodiscard]] Hit closest(const Ray& ray) const override {
        std::uint32_t best = kNoTriangle;
        LineCrossing at{ray.far, 0, 0, false};
        for (std::uint32_t i = 0; i < mesh_.triangle_count(); ++i) {
            const LineCrossing crossing = cross_plane(corner_and_edges(mesh_, i), ray);
            if (crossing.is_inside && crossing.t > ray.near && crossing.t < at.t) {
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
            const LineCrossing crossing = cross_plane(corner_and_edges(mesh_, i), ray);
            if (crossing.is_inside && crossing.t > ray.near && crossing.t < ray.far &&
                i != except) {
                return true;
            }
        }
        return false;
    }

  private:
    [[nodiscard]] Hit make_hit(std::uint32_t triangle, const LineCrossing& at) const {
        const Vec3 normal = mesh_.across(triangle);
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
