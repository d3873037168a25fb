#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include "base/vec3.h"

namespace quasimc {

enum class UpAxis { z, y };

/// How the axes of a file lie in the world. Inside the program z is up, and north is where the file
/// says: axes are permuted, never turned. Both frames are right-handed; lengths are kept.
class Orientation {
  public:
    Orientation() = default;
    /// @param north  horizontal direction in the file's axes (0 up component), not zero
    Orientation(UpAxis up, const Vec3& north) : up_(up), north_(north) {}

    [[nodiscard]] UpAxis up() const { return up_; }
    [[nodiscard]] const Vec3& north() const { return north_; }

    /// From the file's axes to z up. Axes are permuted, never turned: no digit is lost.
    [[nodiscard]] Vec3 inward(const Vec3& p) const {
        return up_ == UpAxis::z ? p : Vec3{p.z, p.x, p.y};
    }
    [[nodiscard]] Vec3 outward(const Vec3& p) const {
        return up_ == UpAxis::z ? p : Vec3{p.y, p.z, p.x};
    }

    /// Unit vector towards a place of the sky, z up. Azimuth clockwise from north as seen from
    /// above.
    [[nodiscard]] Vec3 towards(double azimuth_deg, double elevation_deg) const {
        const double radians = std::numbers::pi / 180;
        const double around = azimuth_deg * radians;
        const Vec3 n = normalized(inward(north_));
        const Vec3 east{n.y, -n.x, 0};
        const double high = elevation_deg * radians;
        const Vec3 flat = std::cos(around) * n + std::sin(around) * east;
        return std::cos(high) * flat + Vec3{0, 0, std::sin(high)};
    }

  private:
    UpAxis up_ = UpAxis::z;
    Vec3 north_{0, 1, 0};
};

}  // namespace quasimc
