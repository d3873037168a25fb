#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include "geometry/mesh/mesh.h"
#include "geometry/range_index.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A copy of a mesh, whose points p are at transform.point(p).
struct Instance {
    std::shared_ptr<const Mesh> mesh;
    Affine transform;

    [[nodiscard]] Triangle triangle(std::size_t i) const {
        const auto [a, b, c] = (*mesh)[i];
        return {transform.point(a), transform.point(b), transform.point(c)};
    }
};

/// The triangles of a scene, numbered consecutively: those of one mesh, then those of each
/// instance. An instance takes the memory of its transform, however large its mesh is.
class SceneGeometry {
  public:
    SceneGeometry() = default;
    /// @param mesh       vertices in the order of their first use by faces (order_vertices)
    /// @param instances  of ordered meshes, none empty. All triangles together: less than 2^32 - 1
    explicit SceneGeometry(Mesh mesh, std::vector<Instance> instances = {});

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] bool empty() const { return size_ == 0; }
    [[nodiscard]] Triangle operator[](std::size_t i) const {
        return i < mesh_.size() ? mesh_[i] : instance_triangle(i);
    }
    [[nodiscard]] Triangle back() const { return (*this)[size_ - 1]; }

    /// The triangles without an instance.
    [[nodiscard]] const Mesh& mesh() const { return mesh_; }
    [[nodiscard]] const std::vector<Instance>& instances() const { return instances_; }
    /// The triangles of each instance, as index ranges from mesh().size() on.
    [[nodiscard]] const RangeIndex& ranges() const { return ranges_; }

    class Iterator {
      public:
        using iterator_category = std::input_iterator_tag;
        using value_type = Triangle;
        using difference_type = std::ptrdiff_t;
        using pointer = const Triangle*;
        using reference = Triangle;

        Iterator(const SceneGeometry& geometry, std::size_t i) : geometry_(&geometry), i_(i) {}
        Triangle operator*() const { return (*geometry_)[i_]; }
        Iterator& operator++() {
            ++i_;
            return *this;
        }
        Iterator operator++(int) { return {*geometry_, i_++}; }
        friend bool operator==(const Iterator&, const Iterator&) = default;

      private:
        const SceneGeometry* geometry_;
        std::size_t i_;
    };
    using const_iterator = Iterator;
    using iterator = Iterator;
    using value_type = Triangle;
    [[nodiscard]] Iterator begin() const { return {*this, 0}; }
    [[nodiscard]] Iterator end() const { return {*this, size_}; }

    /// Whether the triangles are equal, and belong to the same instances.
    friend bool operator==(const SceneGeometry& a, const SceneGeometry& b);
    /// Whether the triangles equal a list.
    friend bool operator==(const SceneGeometry& a, const std::vector<Triangle>& b);

  private:
    [[nodiscard]] Triangle instance_triangle(std::size_t i) const;

    Mesh mesh_;
    std::vector<Instance> instances_;
    RangeIndex ranges_;
    std::size_t size_ = 0;
};

/// The bounds of all triangles.
[[nodiscard]] Bounds bounds_of(const SceneGeometry& geometry);
/// The bounds of each instance. Takes time for each mesh, and little for each instance.
[[nodiscard]] std::vector<Bounds> instance_bounds(const std::vector<Instance>& instances);

}  // namespace quasimc
