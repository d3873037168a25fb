#include "geometry_testing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace quasimc::test {

double Random::uniform() {
    return std::ldexp(static_cast<double>(bits_() >> 11U), -53);
}

Vec3 Random::point(double low, double high) {
    const double x = between(low, high);
    const double y = between(low, high);
    return {x, y, between(low, high)};
}

Vec3 Random::direction() {
    const double z = between(-1, 1), angle = 2 * std::numbers::pi * uniform();
    const double r = std::sqrt(1 - z * z);
    return rounded({r * std::cos(angle), r * std::sin(angle), z});
}

std::vector<Vec3> vertices(const LocalMesh& mesh) {
    std::vector<Vec3> points;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            points.push_back(mesh.vertex(i, corner));
        }
    }
    return points;
}

double reach(const std::vector<Vec3>& points, const Vec3& direction) {
    double furthest = -INFINITY;
    for (const Vec3& p : points) {
        furthest = std::max(furthest, dot(p, direction));
    }
    return furthest;
}

Vec3 rounded(const Vec3& v) {
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

std::vector<Triangle> random_soup(std::size_t count, double size, Random& random) {
    std::vector<Triangle> soup;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 center = random.point(0, 1);
        const Vec3 a = random.point(-size, size), b = random.point(-size, size);
        soup.push_back({center + a, center + b, center + random.point(-size, size)});
    }
    return soup;
}

Vec3 random_point_on(const LocalMesh& mesh, std::uint32_t triangle, Random& random) {
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) {
        u = 1 - u;
        v = 1 - v;
    }
    return mesh.point(triangle, u, v);
}

namespace {

/// Where a line meets a triangle's plane.
struct PlaneHit {
    double t = 0, u = 0, v = 0;
    double cosine = 0;  ///< of the angle between ray and normal, not negative

    /// How far inside the triangle, in barycentric coordinates; negative outside.
    [[nodiscard]] double inside() const { return std::min({u, v, 1 - u - v}); }
};

PlaneHit meet_plane(const Triangle& triangle, const Vec3& origin, const Vec3& direction) {
    const Vec3 edge1 = triangle[1] - triangle[0], edge2 = triangle[2] - triangle[0];
    const Vec3 normal = cross(edge1, edge2);
    const double slope = dot(direction, normal);
    const Vec3 to_corner = triangle[0] - origin;
    const Vec3 q = cross(direction, to_corner);
    return {
        dot(to_corner, normal) / slope, -dot(edge2, q) / slope, dot(edge1, q) / slope,
        std::abs(slope) / length(normal)};
}

/// Shortest height of a triangle.
double least_height(const Triangle& t) {
    const double longest =
        std::max({length(t[1] - t[0]), length(t[2] - t[1]), length(t[0] - t[2])});
    return 2 * area(t) / longest;
}

constexpr double kRounding = 2e-6;  // some single-precision units of the local coordinates

}  // namespace

bool is_close_call(const LocalMesh& mesh, const Ray& ray) {
    double first = ray.far, second = ray.far;
    for (std::uint32_t i = 0; i < mesh.triangle_count(); ++i) {
        const Triangle t{mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2)};
        const PlaneHit hit = meet_plane(t, ray.origin, ray.direction);
        const double slack = kRounding / hit.cosine;
        if (!(hit.t > ray.near - slack && hit.t < ray.far + slack)) {
            continue;
        }
        const double border = slack / least_height(t);
        const bool grazes = std::abs(hit.inside()) < border;
        const bool ends = hit.inside() > -border &&
                          (std::abs(hit.t - ray.near) < slack || std::abs(hit.t - ray.far) < slack);
        if (grazes || ends || !(hit.cosine > kRounding)) {
            return true;
        }
        if (hit.inside() > 0) {
            second = std::min(second, std::max(first, hit.t));
            first = std::min(first, hit.t);
        }
    }
    return first < ray.far && second - first < 100 * kRounding;
}

namespace {

/// Collects hits; remembers the first, and the nearest distance where rounding may decide.
class FirstOf {
  public:
    void add(std::size_t i, const Triangle& triangle, const PlaneHit& hit) {
        const double slack = 10 * kRounding / hit.cosine;
        const double border = slack / least_height(triangle);
        if (hit.inside() < -border) {
            return;
        }
        const bool is_inside = hit.inside() > 0;
        if (hit.inside() < border || (is_inside && std::abs(hit.t - first_.t) < slack)) {
            doubt_ = std::min(doubt_, hit.t);
        }
        if (is_inside && hit.t < first_.t) {
            first_ = {true, i, hit.t, false};
        }
    }

    [[nodiscard]] FirstHit result() const {
        FirstHit first = first_;
        first.is_close_call = std::isfinite(doubt_) && doubt_ <= first.t;
        return first;
    }

  private:
    FirstHit first_{false, 0, std::numeric_limits<double>::infinity(), false};
    double doubt_ = std::numeric_limits<double>::infinity();
};

}  // namespace

FirstHit first_hit_among_copies(
    const std::vector<Triangle>& triangles,
    const Cell& cell,
    int reach,
    const Vec3& origin,
    const Vec3& direction,
    double near) {
    FirstOf first;
    const int across_x = cell.along_x ? 2 * reach + 1 : 1;
    const int across_y = cell.along_y ? 2 * reach + 1 : 1;
    for (int n = 0; n < across_x * across_y; ++n) {
        const int x = n % across_x - across_x / 2, y = n / across_x - across_y / 2;
        const Vec3 from = origin - Vec3{x * cell.size_x, y * cell.size_y, 0};
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            const PlaneHit hit = meet_plane(triangles[i], from, direction);
            if (hit.t > near) {
                first.add(i, triangles[i], hit);
            }
        }
    }
    return first.result();
}

double variance_of_areas(const std::function<std::map<std::uint32_t, double>()>& caught) {
    constexpr int kRuns = 40;
    std::map<std::uint32_t, std::pair<double, double>> sums;
    for (int run = 0; run < kRuns; ++run) {
        for (const auto& [triangle, area] : caught()) {
            sums[triangle].first += area / kRuns;
            sums[triangle].second += area * area / kRuns;
        }
    }
    double sum = 0;
    for (const auto& [triangle, s] : sums) {
        sum += s.second - s.first * s.first;
    }
    return sum;
}

}  // namespace quasimc::test
