#include "scenes.h"

#include <cmath>
#include <random>

namespace quasimc::bench {

namespace {

constexpr double kPi = 3.14159265358979323846;

class Random {
  public:
    double uniform() { return std::uniform_real_distribution<double>(0, 1)(engine_); }
    std::size_t below(std::size_t n) { return engine_() % n; }
    Vec3 on_sphere() {
        const double z = 2 * uniform() - 1, angle = 2 * kPi * uniform();
        const double r = std::sqrt(1 - z * z);
        return {r * std::cos(angle), r * std::sin(angle), z};
    }
    /// Distributed as the cosine of the angle to `normal`.
    Vec3 cosine_about(const Vec3& normal) { return normalized(1.0000001 * normal + on_sphere()); }

  private:
    std::mt19937_64 engine_{20240607};
};

/// An equilateral triangle of random orientation.
Triangle random_leaf(Random& random, const Vec3& center, double area) {
    const Frame frame = frame_about(random.on_sphere());
    const double radius = std::sqrt(4 * area / (3 * std::sqrt(3.0)));
    const double turned = 2 * kPi * random.uniform();
    Triangle t;
    for (int i = 0; i < 3; ++i) {
        const double angle = turned + 2 * kPi * i / 3;
        t[i] = center + radius * std::cos(angle) * frame.s + radius * std::sin(angle) * frame.t;
    }
    return t;
}

/// Every other bit of a number.
std::uint32_t even_bits(std::uint64_t code) {
    std::uint32_t bits = 0;
    for (int i = 0; i < 32; ++i) {
        bits |= static_cast<std::uint32_t>((code >> (2 * i)) & 1U) << i;
    }
    return bits;
}

}  // namespace

std::vector<Triangle> random_leaves(std::size_t count, double area) {
    Random random;
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 center{random.uniform(), random.uniform(), random.uniform()};
        triangles.push_back(random_leaf(random, center, area / static_cast<double>(count)));
    }
    return triangles;
}

std::vector<Triangle> plants(std::size_t leaves) {
    Random random;
    std::vector<Triangle> triangles;
    const double leaf_area = 1 / (16 * static_cast<double>(leaves));
    for (int plant = 0; plant < 16; ++plant) {
        const int row = plant / 4, column = plant % 4;
        const Vec3 stem{0.125 + 0.25 * column, 0.125 + 0.25 * row, 0};
        for (std::size_t i = 0; i < leaves; ++i) {
            const double radius = 0.14 * std::sqrt(random.uniform());
            const double angle = 2 * kPi * random.uniform();
            const Vec3 position{
                radius * std::cos(angle), radius * std::sin(angle), 0.5 * random.uniform()};
            triangles.push_back(random_leaf(random, stem + position, leaf_area));
        }
    }
    return triangles;
}

std::vector<BenchRay> vertical_rays(std::size_t count, double height, bool ordered) {
    Random random;
    std::vector<BenchRay> rays;
    const double side = std::ceil(std::sqrt(static_cast<double>(count)));
    const double cells = std::exp2(std::ceil(std::log2(side)));
    for (std::uint64_t i = 0; rays.size() < count; ++i) {
        Vec3 position{random.uniform(), random.uniform(), 0};
        if (ordered) {
            position = {
                (even_bits(i) + position.x) / cells, (even_bits(i >> 1U) + position.y) / cells, 0};
        }
        rays.push_back({{position.x, position.y, height}, {0, 0, -1}});
    }
    return rays;
}

std::vector<BenchRay> sky_rays(std::size_t count, double height) {
    Random random;
    std::vector<BenchRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        rays.push_back(
            {{random.uniform(), random.uniform(), height}, random.cosine_about({0, 0, -1})});
    }
    return rays;
}

std::vector<BenchRay> low_rays(std::size_t count, double height) {
    Random random;
    std::vector<BenchRay> rays;
    const double elevation = 10 * kPi / 180;
    for (std::size_t i = 0; i < count; ++i) {
        const double azimuth = 2 * kPi * random.uniform();
        rays.push_back(
            {{random.uniform(), random.uniform(), height},
             {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
              -std::sin(elevation)}});
    }
    return rays;
}

std::vector<BenchRay> leaf_rays(std::size_t count, const std::vector<Triangle>& triangles) {
    Random random;
    std::vector<BenchRay> rays;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t self = random.below(triangles.size());
        const auto& [a, b, c] = triangles[self];
        const double root = std::sqrt(random.uniform()), v = root * random.uniform();
        const Vec3 normal = normalized(area_vector({a, b, c}));
        rays.push_back(
            {a + (1 - root) * (b - a) + v * (c - a),
             random.cosine_about(random.uniform() < 0.5 ? normal : -normal),
             static_cast<std::uint32_t>(self)});
    }
    return rays;
}

Packet packet_of(const std::vector<BenchRay>& rays, std::size_t first) {
    Packet packet;
    for (std::size_t i = 0; i < kPacket; ++i) {
        const BenchRay& ray = rays[first + i];
        packet.set_origin(i, ray.origin);
        packet.set_direction(i, ray.direction);
    }
    return packet;
}

}  // namespace quasimc::bench
