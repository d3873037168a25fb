#include "statistical/plain_tracer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/vec3.h"

namespace quasimc::test {
namespace {

constexpr double kPi = std::numbers::pi, kInfinity = std::numeric_limits<double>::infinity();
constexpr std::size_t kNone = static_cast<std::size_t>(-1);

double uniform(Random& random) {
    return std::ldexp(static_cast<double>(random() >> 11), -53);
}

/// A direction about `normal`. @param cosine  its cosine from there
Vec3 direction_about(const Vec3& normal, double cosine, Random& random) {
    const Vec3 other = std::abs(normal.x) < .5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 s = normalized(cross(normal, other));
    const Vec3 t = cross(normal, s);
    const double phi = 2 * kPi * uniform(random);
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    return cosine * normal + sine * (std::cos(phi) * s + std::sin(phi) * t);
}

/// A ray of that direction through the disk in which a ball is seen.
PlainRay ray_to(const Ball& ball, const Vec3& direction, Random& random) {
    const double radius = ball.radius * std::sqrt(uniform(random));
    const Vec3 across = direction_about(direction, 0, random);
    return {ball.center + radius * across - 2 * ball.radius * direction, direction};
}

Vec3 point_over(double cell, double height, Random& random) {
    const double x = cell * uniform(random);
    return {x, cell * uniform(random), height};
}

Vec3 normal_of(const Triangle& t) {
    return normalized(cross(t[1] - t[0], t[2] - t[0]));
}

/// The distance at which a ray meets a triangle (Moller and Trumbore 1997).
double distance_to(const Triangle& t, const PlainRay& ray) {
    const Vec3 a = t[1] - t[0], b = t[2] - t[0];
    const Vec3 p = cross(ray.direction, b);
    const double volume = dot(a, p);
    const Vec3 from = ray.origin - t[0];
    const double u = dot(from, p) / volume;
    const Vec3 q = cross(from, a);
    const double v = dot(ray.direction, q) / volume;
    const double distance = dot(b, q) / volume;
    return u >= 0 && v >= 0 && u + v <= 1 && distance > 0 ? distance : kInfinity;
}

/// The distance at which a ray leaves a cell.
double distance_to_border(double cell, const PlainRay& ray) {
    const auto along = [&](double p, double d) {
        return d > 0 ? (cell - p) / d : d < 0 ? -p / d : kInfinity;
    };
    return std::min(along(ray.origin.x, ray.direction.x), along(ray.origin.y, ray.direction.y));
}

class Path {
  public:
    Path(
        const PlainScene& scene,
        double flux,
        Random& random,
        std::vector<PlainLight>& light,
        std::size_t organs)
        : scene_(scene), flux_(flux), random_(random), light_(light), organs_(organs) {
        for (const PlainTriangle& triangle : scene.triangles) {
            for (const Vec3& corner : triangle.corners) {
                low_ = std::min(low_, corner.z);
                high_ = std::max(high_, corner.z);
            }
        }
        for (const PlainDisk& disk : scene.disks) {
            low_ = std::min(low_, disk.center.z - disk.radius);
            high_ = std::max(high_, disk.center.z + disk.radius);
        }
    }

    /// Follows one ray of the source to its end.
    void follow(PlainRay ray) {
        std::size_t from = kNone;  // the triangle that the ray leaves
        bool is_direct = true;
        while (true) {
            const auto [hit, distance] = next_hit(ray, from);
            const double border = scene_.cell ? distance_to_border(*scene_.cell, ray) : kInfinity;
            cross_disks(ray, std::min(distance, border), is_direct);
            if (distance <= border && hit != kNone) {
                const std::optional<Vec3> onward = meet(hit, ray.direction, is_direct);
                if (!onward) {
                    return;
                }
                ray = {ray.origin + distance * ray.direction, *onward};
                from = hit;
                is_direct = false;
            } else if (border < kInfinity && stays(ray)) {
                ray.origin = wrapped(ray.origin + border * ray.direction, ray.direction);
                from = kNone;
            } else {
                return;
            }
        }
    }

  private:
    void add(std::size_t target, bool is_upper, bool is_direct) {
        PlainLight& light = light_[target];
        light.at(static_cast<std::size_t>(is_upper ? Part::upper : Part::lower)) += flux_;
        light.at(static_cast<std::size_t>(is_direct ? Part::direct : Part::scattered)) += flux_;
    }

    [[nodiscard]] std::pair<std::size_t, double> next_hit(
        const PlainRay& ray, std::size_t from) const {
        std::pair<std::size_t, double> nearest{kNone, kInfinity};
        for (std::size_t i = 0; i < scene_.triangles.size(); ++i) {
            const double distance =
                i == from ? kInfinity : distance_to(scene_.triangles[i].corners, ray);
            if (distance < nearest.second) {
                nearest = {i, distance};
            }
        }
        return nearest;
    }

    void cross_disks(const PlainRay& ray, double limit, bool is_direct) {
        for (std::size_t i = 0; i < scene_.disks.size(); ++i) {
            const PlainDisk& disk = scene_.disks[i];
            const double cosine = dot(ray.direction, disk.normal);
            const double distance = dot(disk.center - ray.origin, disk.normal) / cosine;
            const Vec3 from_center = ray.origin + distance * ray.direction - disk.center;
            if (distance > 0 && distance < limit && length(from_center) <= disk.radius &&
                std::abs(cosine) >= disk.least_cosine) {
                add(organs_ + i, cosine < 0, is_direct);
            }
        }
    }

    /// @returns the direction of the light that leaves; none if it is absorbed
    std::optional<Vec3> meet(std::size_t index, const Vec3& direction, bool is_direct) {
        const PlainTriangle& triangle = scene_.triangles[index];
        const Vec3 up = normal_of(triangle.corners);
        const bool is_upper = dot(direction, up) < 0;
        const std::size_t side = is_upper ? 0 : 1;
        add(triangle.organ, is_upper, is_direct);
        const double reflectance = triangle.reflectance.at(side), chance = uniform(random_);
        if (chance >= reflectance + triangle.transmittance.at(side)) {
            light_[triangle.organ].at(static_cast<std::size_t>(Part::absorbed)) += flux_;
            return std::nullopt;
        }
        const Vec3 normal = is_upper == (chance < reflectance) ? up : -1.0 * up;
        return direction_about(normal, std::sqrt(uniform(random_)), random_);
    }

    /// Whether a ray can still meet something in another copy of the cell.
    [[nodiscard]] bool stays(const PlainRay& ray) const {
        return ray.direction.z > 0 ? ray.origin.z < high_ : ray.origin.z > low_;
    }

    [[nodiscard]] Vec3 wrapped(Vec3 p, const Vec3& direction) const {
        const auto along = [&](double x, double d) {
            const double size = *scene_.cell;
            return x >= size * (1 - 1e-12) && d > 0 ? 0 : x <= size * 1e-12 && d < 0 ? size : x;
        };
        return {along(p.x, direction.x), along(p.y, direction.y), p.z};
    }

    const PlainScene& scene_;
    double flux_;
    Random& random_;
    std::vector<PlainLight>& light_;
    std::size_t organs_;
    double low_ = kInfinity, high_ = -kInfinity;  ///< heights of what light can meet
};

}  // namespace

PlainSource plain_sun(const Ball& ball, const Vec3& direction, double facing) {
    const Vec3 d = normalized(direction);
    return {facing * kPi * ball.radius * ball.radius, [=](Random& random) {
                return ray_to(ball, d, random);
            }};
}

PlainSource plain_sky(const Ball& ball, double horizontal) {
    const double radiance = horizontal / kPi;
    return {radiance * 2 * kPi * kPi * ball.radius * ball.radius, [=](Random& random) {
                return ray_to(ball, direction_about({0, 0, -1}, uniform(random), random), random);
            }};
}

PlainSource plain_lamp(const Vec3& position, double flux) {
    return {flux, [=](Random& random) {
                const double cosine = 2 * uniform(random) - 1;
                return PlainRay{position, direction_about({0, 0, 1}, cosine, random)};
            }};
}

PlainSource plain_sun_over(double cell, double height, const Vec3& direction, double facing) {
    const Vec3 d = normalized(direction);
    return {facing * -d.z * cell * cell, [=](Random& random) {
                return PlainRay{point_over(cell, height, random), d};
            }};
}

PlainSource plain_sky_over(double cell, double height, double horizontal) {
    return {horizontal * cell * cell, [=](Random& random) {
                const double cosine = std::sqrt(uniform(random));
                const Vec3 direction = direction_about({0, 0, -1}, cosine, random);
                return PlainRay{point_over(cell, height, random), direction};
            }};
}

std::vector<PlainLight> trace_plainly(
    const PlainScene& scene, const PlainSource& source, std::size_t paths, Random& random) {
    std::size_t organs = 0;
    for (const PlainTriangle& triangle : scene.triangles) {
        organs = std::max(organs, triangle.organ + 1);
    }
    std::vector<PlainLight> light(organs + scene.disks.size());
    Path path(scene, source.flux / static_cast<double>(paths), random, light, organs);
    for (std::size_t i = 0; i < paths; ++i) {
        path.follow(source.emit(random));
    }
    return light;
}

}  // namespace quasimc::test
