#pragma once

#include <algorithm>
#include <limits>

#include "base/vec3.h"

namespace quasimc {

/// An axis-parallel box; empty until a point is added.
struct Bounds {
    Vec3 low{kInfinity, kInfinity, kInfinity};
    Vec3 high{-kInfinity, -kInfinity, -kInfinity};

    void add(const Vec3& p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void include(const Bounds& other) {
        if (!other.empty()) {
            add(other.low);
            add(other.high);
        }
    }
    [[nodiscard]] bool empty() const { return low.x > high.x; }
    [[nodiscard]] Vec3 center() const { return 0.5 * (low + high); }
    [[nodiscard]] Vec3 size() const { return high - low; }
    /// Half the diagonal: the radius of the sphere about the center that holds the box.
    [[nodiscard]] double radius() const { return 0.5 * length(size()); }

  private:
    static constexpr double kInfinity = std::numeric_limits<double>::infinity();
};

}  // namespace quasimc
