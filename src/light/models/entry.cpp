#include "light/models/entry.h"

#include <algorithm>
#include <cmath>

#include "base/distribution.h"

namespace quasimc {

Vec3 entry_point(const EntryBox& box, const Vec3& direction, double u0, double u1) {
    const double across_z = box.face_area.z * std::abs(direction.z);
    const double across_x = box.face_area.x * std::abs(direction.x);
    const double across_y = box.face_area.y * std::abs(direction.y);
    const Vec3& low = box.bounds.low;
    const Vec3& high = box.bounds.high;
    const Vec3 size = box.bounds.size();
    const double pick = u0 * (across_z + across_x + across_y);
    // Light that travels towards +x enters at the low face; other axes likewise.
    const auto entered = [](double d, double near, double far) { return d > 0 ? near : far; };
    const auto rest = [](double value, double width) {
        return std::clamp(value / width, 0.0, kBelowOne);
    };
    if (pick < across_z || across_x + across_y == 0) {
        return {
            low.x + rest(pick, across_z) * size.x, low.y + u1 * size.y,
            entered(direction.z, low.z, high.z)};
    }
    const double beyond = pick - across_z;
    const double z = low.z + u1 * size.z;
    if (beyond < across_x || across_y == 0) {
        return {entered(direction.x, low.x, high.x), low.y + rest(beyond, across_x) * size.y, z};
    }
    return {
        low.x + rest(beyond - across_x, across_y) * size.x, entered(direction.y, low.y, high.y), z};
}

}  // namespace quasimc
