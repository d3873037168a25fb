#include "memory_scenes.h"

#include <bit>
#include <cmath>
#include <fstream>
#include <random>

#include <fmt/format.h>

namespace quasimc::bench {

std::vector<Triangle> Surface::triangles() const {
    std::vector<Triangle> result;
    result.reserve(faces.size());
    for (const auto& [a, b, c] : faces) {
        result.push_back({vertices[a], vertices[b], vertices[c]});
    }
    return result;
}

Surface soup(std::size_t triangles) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> coordinate(0, 1);
    const double size = 0.5 / std::sqrt(static_cast<double>(triangles));
    Surface surface;
    surface.vertices.reserve(3 * triangles);
    surface.faces.reserve(triangles);
    for (std::uint32_t i = 0; i < triangles; ++i) {
        const Vec3 middle{coordinate(random), coordinate(random), coordinate(random)};
        for (int corner = 0; corner < 3; ++corner) {
            const Vec3 way{
                coordinate(random) - 0.5, coordinate(random) - 0.5, coordinate(random) - 0.5};
            surface.vertices.push_back(middle + size * way);
        }
        surface.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
    return surface;
}

Surface sheet(std::size_t triangles) {
    const auto n = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 2));
    Surface surface;
    surface.vertices.reserve(std::size_t{n + 1} * (n + 1));
    for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j) {
            const double x = double(i) / n, y = double(j) / n;
            surface.vertices.push_back({x, y, 0.1 * std::sin(20 * x) * std::cos(30 * y)});
        }
    }
    surface.faces.reserve(std::size_t{2} * n * n);
    for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
            const std::uint32_t a = i * (n + 1) + j;
            const std::uint32_t b = a + n + 1;
            surface.faces.push_back({a, b, b + 1});
            surface.faces.push_back({a, b + 1, a + 1});
        }
    }
    return surface;
}

void write_obj_file(const Surface& surface, const std::string& path) {
    std::ofstream file(path);
    for (const Vec3& p : surface.vertices) {
        file << fmt::format("v {:.7g} {:.7g} {:.7g}\n", p.x, p.y, p.z);
    }
    for (const auto& [a, b, c] : surface.faces) {
        file << fmt::format("f {} {} {}\n", a + 1, b + 1, c + 1);
    }
}

void write_ply_file(const Surface& surface, const std::string& path) {
    static_assert(std::endian::native == std::endian::little);
    std::ofstream file(path, std::ios::binary);
    file << fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\n"
        "property float y\nproperty float z\nelement face {}\n"
        "property list uchar uint vertex_indices\nend_header\n",
        surface.vertices.size(), surface.faces.size());
    for (const Vec3& p : surface.vertices) {
        const std::array<float, 3> q{
            static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        file.write(reinterpret_cast<const char*>(q.data()), sizeof q);
    }
    for (const auto& face : surface.faces) {
        file.put(3);
        file.write(reinterpret_cast<const char*>(face.data()), sizeof face);
    }
}

}  // namespace quasimc::bench
