#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numeric>
#include <utility>

#include "base/checks.h"
#include "geometry/shapes/shapes.h"
#include "quasimc/mesh.h"

namespace quasimc {

namespace {

constexpr int kMaxSteps = 1024;

/// Upper bounds of a patch's curvature: largest second differences of its control points.
struct Curving {
    double uu = 0, uv = 0, vv = 0;  ///< bounds of the second derivatives
};

Curving curving_of(const BezierPatch& p) {
    const auto at = [&](std::size_t i, std::size_t j) { return p[4 * i + j]; };
    Curving c;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 2; ++j) {
            c.uu = std::max(c.uu, 6 * length(at(j + 2, i) - 2 * at(j + 1, i) + at(j, i)));
            c.vv = std::max(c.vv, 6 * length(at(i, j + 2) - 2 * at(i, j + 1) + at(i, j)));
        }
    }
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t j = 0; j < 3; ++j) {
            const Vec3 twist = at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j);
            c.uv = std::max(c.uv, 9 * length(twist));
        }
    }
    return c;
}

struct Steps {
    int u = 1, v = 1;
};

/// The smallest number of cells for which the triangles stay within `deviation` of the patch. On a
/// cell of du x dv they deviate by at most (du^2 S_uu + 2 du dv S_uv + dv^2 S_vv) / 8 (Filip,
/// Magedson and Markot 1986).
Steps steps_of(const BezierPatch& patch, double deviation) {
    const Curving c = curving_of(patch);
    const double uu = c.uu / (8 * deviation), uv = c.uv / (8 * deviation);
    const double vv = c.vv / (8 * deviation);
    Steps best{kMaxSteps, kMaxSteps};
    for (int v = 1; v <= kMaxSteps; ++v) {
        const double rest = 1 - vv / (double(v) * v);
        if (rest <= 0) {
            continue;
        }
        // The smallest u with uu / u^2 + 2 uv / (u v) <= rest.
        const double half = uv / v;
        const double least = std::ceil((half + std::sqrt(half * half + rest * uu)) / rest);
        const int u = static_cast<int>(std::clamp(least, 1.0, double(kMaxSteps)));
        if (u * v < best.u * best.v) {
            best = {u, v};
        }
    }
    return best;
}

/// The control points of a side, rounded so that rounding errors do not separate neighbours; equal
/// in both directions.
using SideKey = std::array<long long, 12>;

SideKey key_of(std::array<Vec3, 4> side, double grain) {
    const auto key = [&] {
        SideKey k{};
        for (std::size_t i = 0; i < 4; ++i) {
            k[3 * i] = std::llround(side[i].x / grain);
            k[3 * i + 1] = std::llround(side[i].y / grain);
            k[3 * i + 2] = std::llround(side[i].z / grain);
        }
        return k;
    };
    const SideKey one_way = key();
    std::reverse(side.begin(), side.end());
    return std::min(one_way, key());
}

/// Numbers of steps for all patches; shared sides of patches have equal numbers. Directions that
/// must agree are joined into sets; direction 2 p is u of patch p, 2 p + 1 is v.
class SharedSteps {
  public:
    SharedSteps(std::span<const BezierPatch> patches, double deviation, double grain)
        : parent_(2 * patches.size()), steps_(2 * patches.size(), 1) {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
        for (std::size_t p = 0; p < patches.size(); ++p) {
            const BezierPatch& c = patches[p];
            join({c[0], c[4], c[8], c[12]}, grain, 2 * p);
            join({c[3], c[7], c[11], c[15]}, grain, 2 * p);
            join({c[0], c[1], c[2], c[3]}, grain, 2 * p + 1);
            join({c[12], c[13], c[14], c[15]}, grain, 2 * p + 1);
        }
        for (std::size_t p = 0; p < patches.size(); ++p) {
            const Steps own = steps_of(patches[p], deviation);
            int& u = steps_[root(2 * p)];
            u = std::max(u, own.u);
            int& v = steps_[root(2 * p + 1)];
            v = std::max(v, own.v);
        }
    }

    [[nodiscard]] Steps of(std::size_t patch) const {
        return {steps_[root(2 * patch)], steps_[root(2 * patch + 1)]};
    }

  private:
    [[nodiscard]] std::size_t root(std::size_t direction) const {
        while (parent_[direction] != direction) {
            direction = parent_[direction];
        }
        return direction;
    }

    void join(const std::array<Vec3, 4>& side, double grain, std::size_t direction) {
        const auto [known, is_new] = first_.try_emplace(key_of(side, grain), direction);
        if (!is_new) {
            parent_[root(direction)] = root(known->second);
        }
    }

    std::vector<std::size_t> parent_;
    std::vector<int> steps_;
    std::map<SideKey, std::size_t> first_;
};

/// The cubic Bernstein polynomials at i / n; bit for bit the reverse of those at (n - i) / n.
std::array<double, 4> bernstein(int i, int n) {
    const double a = double(i) / n, b = double(n - i) / n;
    return {b * b * b, 3 * (a * (b * b)), 3 * (b * (a * a)), a * a * a};
}

Vec3 curve_point(const std::array<double, 4>& w, const std::array<Vec3, 4>& p) {
    return (w[0] * p[0] + w[3] * p[3]) + (w[1] * p[1] + w[2] * p[2]);
}

/// The points of a patch at the corners of steps.u x steps.v cells, rows along u.
std::vector<Vec3> patch_points(const BezierPatch& c, Steps steps) {
    std::vector<Vec3> points;
    for (int i = 0; i <= steps.u; ++i) {
        const std::array<double, 4> u = bernstein(i, steps.u);
        std::array<Vec3, 4> row;
        for (std::size_t j = 0; j < 4; ++j) {
            row[j] = curve_point(u, {c[j], c[4 + j], c[8 + j], c[12 + j]});
        }
        for (int j = 0; j <= steps.v; ++j) {
            points.push_back(curve_point(bernstein(j, steps.v), row));
        }
    }
    return points;
}

void add_patch(std::vector<Triangle>& triangles, const BezierPatch& patch, Steps steps) {
    const std::vector<Vec3> points = patch_points(patch, steps);
    const auto row = static_cast<std::size_t>(steps.v) + 1;
    const auto add = [&](const Triangle& t) {
        // A degenerate side makes triangles with two equal corners.
        if (t[0] != t[1] && t[1] != t[2] && t[2] != t[0]) {
            triangles.push_back(t);
        }
    };
    for (std::size_t i = 0; i < static_cast<std::size_t>(steps.u); ++i) {
        for (std::size_t j = 0; j + 1 < row; ++j) {
            const Vec3 &a = points[i * row + j], &b = points[(i + 1) * row + j];
            const Vec3 &c = points[(i + 1) * row + j + 1], &d = points[i * row + j + 1];
            if (length(c - a) <= length(d - b)) {
                add({a, b, c});
                add({a, c, d});
            } else {
                add({a, b, d});
                add({b, c, d});
            }
        }
    }
}

}  // namespace

std::vector<Triangle> make_bezier_surface(std::span<const BezierPatch> patches, Flatness flatness) {
    EXPECT(!patches.empty() && flatness.tolerance > 0);
    Bounds bounds;
    for (const BezierPatch& patch : patches) {
        for (const Vec3& p : patch) {
            bounds.add(p);
        }
    }
    const double size = length(bounds.size());
    if (!(size > 0)) {
        return {{patches[0][0], patches[0][0], patches[0][0]}};
    }
    constexpr double kGrain = 0x1p-30;
    const SharedSteps steps(patches, flatness.tolerance * size, kGrain * size);
    std::vector<Triangle> triangles;
    for (std::size_t p = 0; p < patches.size(); ++p) {
        add_patch(triangles, patches[p], steps.of(p));
    }
    if (triangles.empty()) {
        return {{patches[0][0], patches[0][0], patches[0][15]}};
    }
    return triangles;
}

}  // namespace quasimc
