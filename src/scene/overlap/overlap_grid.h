#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/scene_geometry.h"
#include "quasimc/mesh.h"

namespace quasimc {

/// A direction about which normals of modelled organs are seldom symmetric.
inline constexpr Vec3 kGenericDirection{0.3518, 0.7143, 0.6049};

/// A triangle in a cube of the grids.
struct OverlapEntry {
    std::uint64_t cube;
    float facing;  ///< |cos| of the angle between the normal and a generic direction
    float blur;    ///< how much `facing` of a coplanar triangle may differ
    /// Distance of the plane from the cube's centre along the generic direction, in units of the
    /// edge.
    float offset;
    std::uint32_t triangle;

    /// Whether the planes may be parallel.
    [[nodiscard]] bool is_parallel_to(const OverlapEntry& other) const;
    /// Whether parallel planes may be the same in this cube.
    [[nodiscard]] bool is_in_plane_of(const OverlapEntry& other) const;
};

/// The extent of a triangle and what follows from it.
struct TriangleExtent {
    explicit TriangleExtent(const Triangle& t);
    Bounds bounds;
    double size;
};

/// Hierarchical grid of cubes for the search of overlaps, four times finer from level to level. The
/// home level of a triangle has cubes of at least twice its size; the triangle is a visitor on
/// coarser levels.
class OverlapGrid {
  public:
    /// @param changed  by triangle; if not empty, only cubes with a changed triangle are entered
    /// @param scene  bounds of the triangles, or of a scene that includes them
    OverlapGrid(
        const SceneGeometry& triangles, const std::vector<bool>& changed, const Bounds& scene);

    /// Number of passes over the cubes, which limits the memory for instanced scenes.
    [[nodiscard]] std::uint64_t passes() const { return passes_; }

    /// Enters all triangles into the cubes of one pass.
    void enter_all(std::uint64_t pass);

    /// Sorted by cubes.
    [[nodiscard]] std::vector<OverlapEntry>& natives() { return natives_; }
    [[nodiscard]] const std::vector<OverlapEntry>& visitors() const { return visitors_; }

    /// Largest distance from a triangle's plane that counts as coplanar.
    [[nodiscard]] double thickness(double triangle_size) const;

  private:
    static constexpr int kLevels = 9;
    static constexpr int kMarkBits = 20;
    using Homes = std::array<bool, kLevels>;

    /// The cubes of a level that a triangle's bounds reach into: the first, and how many along each
    /// axis.
    struct Cubes {
        std::array<std::uint64_t, 3> first, count;
        [[nodiscard]] std::uint64_t number() const { return count[0] * count[1] * count[2]; }
    };

    [[nodiscard]] bool is_partial() const { return !changed_.empty(); }
    [[nodiscard]] int home_level(double triangle_size) const;
    [[nodiscard]] Cubes cubes_at(const TriangleExtent& extent, int level) const;
    [[nodiscard]] Vec3 middle_of(std::uint64_t cube) const;
    [[nodiscard]] bool is_marked(std::uint64_t cube) const;
    [[nodiscard]] static std::uint64_t mark_of(std::uint64_t cube);
    template <typename Visit>
    static void for_each_cube(const Cubes& cubes, int level, const Visit& visit);
    template <typename Visit>
    static void for_each_entry(
        std::span<const std::int16_t> level_of, const Homes& is_home, const Visit& visit);
    void reserve(
        std::size_t natives,
        const std::array<std::size_t, kLevels>& visitors,
        const Homes& is_home);
    void mark_cubes(std::span<const std::int16_t> level_of, const Homes& is_home);
    void enter(std::uint32_t i, int level, bool is_native, std::uint64_t pass);

    const SceneGeometry& triangles_;
    const std::vector<bool>& changed_;
    Vec3 low_;
    double size_;
    std::array<double, kLevels> per_length_{};  // number of cubes of a level along a unit of length
    std::uint64_t passes_;
    std::vector<bool> marked_;  // cubes, by mark_of()
    std::vector<OverlapEntry> natives_, visitors_;
};

}  // namespace quasimc
