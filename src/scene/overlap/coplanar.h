#pragma once

#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// The longest side of a box.
[[nodiscard]] double size_of(const Bounds& bounds);

/// The smallest height of a triangle whose corners do not coincide.
[[nodiscard]] double height(const Triangle& t);

/// Whether the corners of `small` are no farther than `tolerance` from the plane of `large`, which
/// has an area.
[[nodiscard]] bool lies_in_plane(const Triangle& small, const Triangle& large, double tolerance);

/// Whether the corners are the same but for `tolerance`, in any order.
[[nodiscard]] bool is_same(const Triangle& a, const Triangle& b, double tolerance);

/// Whether the boxes have a point in common.
[[nodiscard]] bool meet(const Bounds& a, const Bounds& b);

/// Whether a side of one of two coplanar triangles separates them, except for a strip of width
/// `tolerance`: they share no area within rounding. A quick test for neighbours in a mesh.
[[nodiscard]] bool lie_apart(const Triangle& a, const Triangle& b, double tolerance);

/// The fraction of `small` that lies on `large`, both seen along the normal of `large`. Both have
/// an area.
[[nodiscard]] double covered_part(const Triangle& small, const Triangle& large);

/// The parts of `t`, which has an area, that no triangle of `windows` in its plane covers:
/// triangles with its upper side up. Parts lower than `tolerance` are omitted.
[[nodiscard]] std::vector<Triangle> parts_beside(
    const Triangle& t, const std::vector<Triangle>& windows, double tolerance);

/// The parts of a triangle in slabs `width` > 0 thick across a unit `axis`, from its lowest corner
/// along it, slab by slab, upper side up.
[[nodiscard]] std::vector<std::vector<Triangle>> parts_in_slabs(
    const Triangle& t, const Vec3& axis, double width);

}  // namespace quasimc
