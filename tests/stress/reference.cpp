#include "stress/reference.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace quasimc::stress {
namespace {

struct Ray {
    Vec3 origin, direction;
    const PlainTriangle* left = nullptr;  ///< triangle at the ray's origin
};

struct PlainHit {
    const PlainTriangle* triangle = nullptr;
    double distance = 0;
};

/// Moeller and Trumbore 1997, from both sides.
double distance_to(const PlainTriangle& t, const Ray& ray) {
    const Vec3 p = cross(ray.direction, t.edge_b);
    const double det = dot(t.edge_a, p);
    if (det == 0) {
        return -1;
    }
    const Vec3 from = ray.origin - t.corner;
    const double u = dot(from, p) / det;
    const Vec3 q = cross(from, t.edge_a);
    const double v = dot(ray.direction, q) / det;
    if (u < 0 || v < 0 || u + v > 1) {
        return -1;
    }
    return dot(t.edge_b, q) / det;
}

PlainHit nearest(const PlainScene& scene, const Ray& ray, double low, double high) {
    PlainHit hit{nullptr, high};
    for (const PlainTriangle& t : scene.triangles) {
        if (&t == ray.left) {
            continue;
        }
        const double distance = distance_to(t, ray);
        if (distance > low && distance < hit.distance) {
            hit = {&t, distance};
        }
    }
    return hit;
}

double end_of_cell(double origin, double direction, double low, double size) {
    if (direction == 0) {
        return std::numeric_limits<double>::infinity();
    }
    return (low + (direction > 0 ? size : 0) - origin) / direction;
}

/// The first hit in a periodic scene; moves the ray's origin into the cell of the hit.
PlainHit nearest_in_cells(const PlainScene& scene, Ray& ray) {
    constexpr int kMaxCells = 100000;
    const Cell& cell = scene.cell;
    const Vec3 size = scene.bounds.size();
    const double tiny = 1e-12 * (size.x + size.y + size.z + cell.size_x + cell.size_y);
    for (int i = 0; i < kMaxCells; ++i) {
        const double x = end_of_cell(ray.origin.x, ray.direction.x, cell.low_x, cell.size_x);
        const double y = end_of_cell(ray.origin.y, ray.direction.y, cell.low_y, cell.size_y);
        const double end = std::min(x, y);
        const PlainHit hit = nearest(scene, ray, tiny, end);
        if (hit.triangle != nullptr) {
            return hit;
        }
        ray.origin += end * ray.direction;
        ray.left = nullptr;
        if (x <= y) {
            ray.origin.x = cell.low_x + (ray.direction.x > 0 ? 0 : cell.size_x);
        } else {
            ray.origin.y = cell.low_y + (ray.direction.y > 0 ? 0 : cell.size_y);
        }
        const bool is_out = ray.direction.z > 0 ? ray.origin.z > scene.bounds.high.z
                                                : ray.origin.z < scene.bounds.low.z;
        if (is_out || ray.direction.z == 0) {
            break;
        }
    }
    return {};
}

Vec3 cosine_about(const Vec3& n, Random& random) {
    const Vec3 d = n + random.direction();
    return length(d) > 1e-9 ? normalized(d) : n;
}

/// Follows a path to its end.
class Follower {
  public:
    Follower(const PlainScene& scene, PlainSums& sums, Random& random)
        : scene_(scene), sums_(sums), random_(random) {}

    void follow(Ray ray, std::vector<double> weights) {
        for (std::uint32_t depth = 1;; ++depth) {
            PlainHit hit = scene_.cell.periodic()
                               ? nearest_in_cells(scene_, ray)
                               : nearest(scene_, ray, 1e-13 * scene_.bounds.radius(), kFar);
            if (hit.triangle == nullptr) {
                return;
            }
            const bool is_clear = arrive(*hit.triangle, ray.direction, weights);
            if (depth == scene_.max_depth) {
                return;
            }
            ray.origin += hit.distance * ray.direction;
            ray.left = hit.triangle;
            if (!is_clear && !scatter(*hit.triangle, ray, weights)) {
                return;
            }
        }
    }

  private:
    static constexpr double kFar = std::numeric_limits<double>::infinity();

    /// Counts the incident light. Returns whether it passes through a sensor.
    bool arrive(const PlainTriangle& t, const Vec3& direction, const std::vector<double>& weights) {
        const double cosine = dot(direction, t.normal);
        const std::size_t side = cosine < 0 ? 0 : 1;
        const PlainSide& optics = scene_.materials[t.organ][side];
        const bool is_clear =
            optics.passes_straight &&
            std::all_of(optics.tau.begin(), optics.tau.end(), [](double x) { return x == 1; });
        const bool is_counted = std::abs(cosine) >= scene_.least_cosine[t.organ] &&
                                !(is_direct_ && scene_.ignores_direct);
        for (std::size_t b = 0; is_counted && b < weights.size(); ++b) {
            auto& sums = is_direct_ ? sums_.direct : sums_.scattered;
            sums[(t.organ * 2 + side) * weights.size() + b] += weights[b];
            sums_.absorbed[t.organ * weights.size() + b] +=
                weights[b] * (1 - optics.rho[b] - optics.tau[b]);
        }
        return is_clear;
    }

    /// Chooses between reflection, transmission and the end of the path.
    bool scatter(const PlainTriangle& t, Ray& ray, std::vector<double>& weights) {
        const double cosine = dot(ray.direction, t.normal);
        const PlainSide& optics = scene_.materials[t.organ][cosine < 0 ? 0 : 1];
        double all = 0, reflected = 0, passed = 0;
        for (std::size_t b = 0; b < weights.size(); ++b) {
            all += weights[b];
            reflected += weights[b] * optics.rho[b];
            passed += weights[b] * optics.tau[b];
        }
        const double u = random_.unit() * all;
        const bool is_reflected = u < reflected;
        if (!(u < reflected + passed) || all <= 0) {
            return false;
        }
        const double chance = (is_reflected ? reflected : passed) / all;
        for (std::size_t b = 0; b < weights.size(); ++b) {
            weights[b] *= (is_reflected ? optics.rho[b] : optics.tau[b]) / chance;
        }
        is_direct_ = false;
        const Vec3 facing = cosine < 0 ? t.normal : -t.normal;
        if (is_reflected && optics.reflects_as_mirror) {
            ray.direction = normalized(ray.direction - 2 * dot(ray.direction, facing) * facing);
        } else if (is_reflected) {
            ray.direction = cosine_about(facing, random_);
        } else if (!optics.passes_straight) {
            ray.direction = cosine_about(-facing, random_);
        }
        return true;
    }

    const PlainScene& scene_;
    PlainSums& sums_;
    Random& random_;
    bool is_direct_ = true;
};

/// Moves a point into the cell, if there is one.
Vec3 wrapped(Vec3 p, const Cell& cell) {
    if (cell.periodic()) {
        p.x -= cell.size_x * std::floor((p.x - cell.low_x) / cell.size_x);
        p.y -= cell.size_y * std::floor((p.y - cell.low_y) / cell.size_y);
    }
    return p;
}

}  // namespace

PlainSums trace_plainly(const PlainScene& scene, std::uint64_t paths, std::uint64_t seed) {
    Random random(seed);
    PlainSums sums;
    const std::size_t sides = scene.materials.size() * 2 * scene.bands;
    sums.direct.resize(sides);
    sums.scattered.resize(sides);
    sums.absorbed.resize(sides / 2);
    sums.brightest_path.resize(scene.bands);
    for (const Emitter& emitter : scene.emitters) {
        for (std::uint64_t i = 0; i < paths; ++i) {
            const StartedRay start = start_ray(emitter, scene, random);
            std::vector<double> weights = emitter.amount;
            for (std::size_t b = 0; b < scene.bands; ++b) {
                weights[b] *= start.weight / static_cast<double>(paths);
                sums.brightest_path[b] = std::max(sums.brightest_path[b], weights[b]);
            }
            Follower(scene, sums, random)
                .follow(
                    {wrapped(start.origin, scene.cell), start.direction, nullptr},
                    std::move(weights));
        }
    }
    return sums;
}

}  // namespace quasimc::stress
