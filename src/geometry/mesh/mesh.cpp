#include "geometry/mesh/mesh.h"

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <utility>

#include "base/checks.h"

namespace quasimc {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// Whether two points have the same digits, signs of zeros included.
bool has_same_bits(const Vec3& a, const Vec3& b) {
    using Bits = std::array<std::uint64_t, 3>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

/// Whether order_vertices() would change nothing.
bool is_in_order(const Mesh& mesh) {
    std::uint32_t next = 0;
    for (const Face& face : mesh.faces) {
        for (const std::uint32_t vertex : face) {
            if (vertex > next) {
                return false;
            }
            next += vertex == next ? 1 : 0;
        }
    }
    return next == mesh.vertices.size();
}

}  // namespace

Mesh::Mesh(std::vector<Vec3> all_vertices, std::vector<Face> all_faces)
    : vertices(std::move(all_vertices)), faces(std::move(all_faces)) {
    for (const Face& face : faces) {
        for (const std::uint32_t vertex : face) {
            EXPECT(vertex < vertices.size());
        }
    }
}

Mesh::Mesh(const std::vector<Triangle>& triangles) {
    vertices.reserve(3 * triangles.size());
    faces.reserve(triangles.size());
    for (const Triangle& triangle : triangles) {
        push_back(triangle);
    }
}

Mesh::Mesh(std::initializer_list<Triangle> triangles) : Mesh(std::vector<Triangle>(triangles)) {}

void Mesh::push_back(const Triangle& triangle) {
    Face face{};
    for (std::size_t corner = 0; corner < face.size(); ++corner) {
        face[corner] = static_cast<std::uint32_t>(vertices.size());
        for (std::size_t i = 0; !faces.empty() && i < face.size(); ++i) {
            const std::uint32_t known = faces.back()[i];
            if (has_same_bits(vertices[known], triangle[corner])) {
                face[corner] = known;
                break;
            }
        }
        if (face[corner] == vertices.size()) {
            vertices.push_back(triangle[corner]);
        }
    }
    faces.push_back(face);
}

void Mesh::append(const Mesh& other) {
    const auto first = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), other.vertices.begin(), other.vertices.end());
    for (const auto& [a, b, c] : other.faces) {
        faces.push_back({first + a, first + b, first + c});
    }
}

double area(const Mesh& mesh) {
    double sum = 0;
    for (std::size_t i = 0; i < mesh.size(); ++i) {
        sum += area(mesh[i]);
    }
    return sum;
}

void order_vertices(Mesh& mesh) {
    if (is_in_order(mesh)) {
        return;
    }
    std::vector<std::uint32_t> number(mesh.vertices.size(), kNone);
    std::vector<Vec3> ordered;
    ordered.reserve(mesh.vertices.size());
    for (Face& face : mesh.faces) {
        for (std::uint32_t& vertex : face) {
            if (number[vertex] == kNone) {
                number[vertex] = static_cast<std::uint32_t>(ordered.size());
                ordered.push_back(mesh.vertices[vertex]);
            }
            vertex = number[vertex];
        }
    }
    mesh.vertices = std::move(ordered);
}

}  // namespace quasimc
