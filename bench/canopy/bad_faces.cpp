#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "crops.h"
#include "quasimc/mesh.h"

namespace quasimc::bench {
namespace {

/// Composes an OBJ file.
class ObjText {
  public:
    /// @returns the index of the vertex, from 1
    int vertex(const Vec3& p) {
        text_ += fmt::format("v {:.5f} {:.5f} {:.5f}\n", p.x, p.y, p.z);
        return ++vertices_;
    }
    void group(const std::string& name, const char* material) {
        text_ += fmt::format("g {}\nusemtl {}\n", name, material);
    }
    void face(std::initializer_list<int> corners) {
        text_ += 'f';
        for (const int corner : corners) {
            text_ += fmt::format(" {}", corner);
        }
        text_ += '\n';
    }
    [[nodiscard]] std::string take() { return std::move(text_); }

  private:
    std::string text_;
    int vertices_ = 0;
};

constexpr int kPetals = 6;

/// A petal of three quadrilaterals: the last is self-intersecting, one face crosses the first, one
/// has a repeated corner and one has collinear corners.
void add_petal(ObjText& obj, const Vec3& center, double around) {
    const Vec3 out{std::cos(around), std::sin(around), 0};
    const Vec3 across{-out.y, out.x, 0};
    std::array<int, 4> left{}, right{};
    for (int i = 0; i < 4; ++i) {
        const Vec3 middle = center + (.01 + .015 * i) * out + Vec3{0, 0, .012 * i - .003 * i * i};
        const double half = .004 + .005 * i;
        left[i] = obj.vertex(middle + half * across);
        right[i] = obj.vertex(middle - half * across + Vec3{0, 0, .001 * i});
    }
    obj.face({left[0], right[0], right[1], left[1]});
    obj.face({left[1], right[1], right[2], left[2]});
    obj.face({left[2], right[2], left[3], right[3]});
    obj.face({left[0], right[1], right[2]});
    obj.face({left[1], left[1], right[1]});
    const int middle = obj.vertex(center + .02 * out);
    const int beyond = obj.vertex(center + .03 * out);
    const int end = obj.vertex(center + .04 * out);
    obj.face({middle, beyond, end});
}

/// A stalk of four sides, with open ends.
void add_stalk(ObjText& obj, const Vec3& center) {
    std::array<int, 4> low{}, high{};
    for (int i = 0; i < 4; ++i) {
        const double around = .5 * std::numbers::pi * i;
        const Vec3 aside{.002 * std::cos(around), .002 * std::sin(around), 0};
        high[i] = obj.vertex(center + aside);
        low[i] = obj.vertex(Vec3{center.x, center.y, 0} + aside);
    }
    for (int i = 0; i < 4; ++i) {
        const int j = (i + 1) % 4;
        obj.face({low[i], low[j], high[j], high[i]});
    }
}

}  // namespace

std::string flowers_with_bad_faces(std::uint32_t flowers) {
    ObjText obj;
    for (std::uint32_t i = 0; i < flowers; ++i) {
        const std::uint32_t row = i / 5;
        const Vec3 center{.08 * (i % 5) + .01 * (row % 2), .07 * row, .1 + .02 * ((7 * i) % 5)};
        obj.group(fmt::format("stalk_{}", i + 1), "stalk");
        add_stalk(obj, center);
        for (int j = 0; j < kPetals; ++j) {
            obj.group(fmt::format("petal_{}_{}", i + 1, j + 1), "petal");
            add_petal(obj, center, 2 * std::numbers::pi * j / kPetals + .1 * i);
        }
    }
    return obj.take();
}

}  // namespace quasimc::bench
