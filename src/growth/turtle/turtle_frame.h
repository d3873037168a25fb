#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "base/angles.h"
#include "growth/turtle/drawing.h"

namespace quasimc {

/// Cosine and sine of an angle.
struct Turn {
    double c = 1, s = 0;
};

[[nodiscard]] inline Turn turn_of(double degrees) {
    return {std::cos(degrees * kRadians), std::sin(degrees * kRadians)};
}

[[nodiscard]] constexpr Turn opposite(const Turn& turn) {
    return {turn.c, -turn.s};
}

/// Turns of recent angles, so that their cosines are rarely computed.
class TurnCache {
  public:
    [[nodiscard]] const Turn& turn(float degrees) {
        const auto bits = std::bit_cast<std::uint32_t>(degrees);
        Entry& entry = entries_[bits * 0x9E3779B1U >> 26U];
        if (entry.bits != bits) {
            entry = {bits, turn_of(degrees)};
        }
        return entry.turn;
    }

  private:
    struct Entry {
        std::uint32_t bits = 0;
        Turn turn;
    };
    std::array<Entry, 64> entries_ = {};
};

/// Turns the direction `a` towards `b`, and `b` away from `a`.
inline void turn_towards(Vec3& a, Vec3& b, const Turn& turn) {
    const Vec3 old = a;
    a = turn.c * old + turn.s * b;
    b = turn.c * b - turn.s * old;
}

/// A unit direction, and one at a right angle to it.
struct HeadingAndUp {
    Vec3 heading{0, 1, 0};
    Vec3 up{0, 0, -1};

    [[nodiscard]] Vec3 left() const { return cross(heading, up); }
};

/// The axes after the least rotation that turns their heading to the unit vector `heading`.
/// Opposite headings are turned about the direction up.
[[nodiscard]] inline HeadingAndUp turned_to(const HeadingAndUp& axes, const Vec3& heading) {
    const double c = dot(axes.heading, heading);
    constexpr double kOpposite = -1 + 1e-12;
    if (c < kOpposite) {
        return {heading, axes.up};
    }
    const Vec3 axis = cross(axes.heading, heading);
    const Vec3 across = cross(axis, axes.up);
    return {heading, axes.up + across + cross(axis, across) / (1 + c)};
}

/// The frame at the same position with other axes.
[[nodiscard]] inline TurtleFrame with_axes(const TurtleFrame& frame, const HeadingAndUp& axes) {
    return {frame.position, axes.heading, axes.left(), axes.up};
}

}  // namespace quasimc
