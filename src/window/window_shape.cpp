#include "window/window_shape.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {
namespace {

using Vertex = std::array<float, 3>;

/// The number of last vertices of an organ among which a repeated corner is searched.
constexpr std::size_t kSearched = 16;

class ShapeWriter {
  public:
    explicit ShapeWriter(const Scene& scene) : scene_(scene), middle_(window_middle(scene)) {
        corners_.reserve(3 * scene.triangle_count());
    }

    std::string text() {
        std::vector<float> areas, heights;
        std::vector<std::uint32_t> counts;
        for (const Organ& organ : scene_.organs()) {
            areas.push_back(static_cast<float>(organ.area));
            heights.push_back(static_cast<float>(add(organ)));
            counts.push_back(organ.triangle_count);
        }
        std::string bytes;
        bytes.reserve(12 * (areas.size() + vertices_.size()) + corners_.size());
        append(bytes, areas);
        append(bytes, heights);
        append(bytes, counts);
        append(bytes, vertices_);
        return bytes += corners_;
    }

  private:
    template <typename T>
    static void append(std::string& bytes, const std::vector<T>& values) {
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
    }

    /// @returns the height of its middle
    double add(const Organ& organ) {
        first_ = vertices_.size();
        double sum = 0, total = 0;
        for (std::uint32_t i = 0; i < organ.triangle_count; ++i) {
            const Triangle triangle = data_of(scene_).triangles()[organ.first_triangle + i];
            const double part = area(triangle);
            sum += part * (triangle[0].z + triangle[1].z + triangle[2].z) / 3;
            total += part;
            for (const Vec3& corner : triangle) {
                add(corner - middle_);
            }
        }
        return total > 0 ? sum / total : middle_.z;
    }

    void add(const Vec3& corner) {
        const Vertex vertex{
            static_cast<float>(corner.x), static_cast<float>(corner.y),
            static_cast<float>(corner.z)};
        const std::size_t known = std::min(kSearched, vertices_.size() - first_);
        for (std::size_t back = 1; back <= known; ++back) {
            if (vertices_[vertices_.size() - back] == vertex) {
                corners_.push_back(static_cast<char>(back));
                return;
            }
        }
        vertices_.push_back(vertex);
        corners_.push_back(0);
    }

    const Scene& scene_;
    Vec3 middle_;
    std::vector<Vertex> vertices_;
    std::size_t first_ = 0;  // first vertex of the organ
    std::string corners_;
};

}  // namespace

Vec3 window_middle(const Scene& scene) {
    return 0.5 * (scene.bounds().low + scene.bounds().high);
}

std::string window_shape(const Scene& scene) {
    return ShapeWriter(scene).text();
}

}  // namespace quasimc
