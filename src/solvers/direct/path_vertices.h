#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "raster/projected_scene.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// Light on surfaces along one direction.
struct SurfaceBeam {
    const BoundSource* light = nullptr;
    Vec3 direction;    ///< unit direction of the light
    double paths = 0;  ///< its light, as a number of paths
};

/// The first vertex of a path: a point on a triangle of the mesh.
struct PathVertex {
    std::uint32_t triangle = 0;
    std::uint32_t beam = 0;  ///< index in the list of beams
    float u = 0, v = 0;
    double weight = 1;
};

/// Light of each spectrum that each side of each material scatters, relative to the side that
/// scatters most: mean over the bands, weighted by their light. 0 for sensors.
class ScatteredShares {
  public:
    explicit ScatteredShares(const PreparedScene& prepared);

    [[nodiscard]] double of(std::size_t spectrum, std::size_t material, SurfaceSide side) const {
        return shares_[2 * (spectrum * materials_ + material) + index_of(side)];
    }

  private:
    std::size_t materials_;
    std::vector<double> shares_;  // [spectrum][material][side]
};

/// A piece of a lit surface, from which paths start.
struct ScatteringPiece {
    double scattered = 0;  ///< mean number of paths that start
    double weight = 0;     ///< per path
    std::uint32_t triangle = 0;
};

/// The piece that receives light of a beam: that of `amount` paths.
/// @param along  dot(unit normal of the upper side, direction of the beam)
[[nodiscard]] ScatteringPiece scattering_piece(
    const PreparedScene& prepared,
    const ScatteredShares& shares,
    const SurfaceBeam& beam,
    std::uint32_t triangle,
    double along,
    double amount);

/// Puts the first vertices of paths at equal steps of the scattered light (systematic sampling):
/// along the light in the order of the calls, each vertex represents the light of one path. So none
/// misses the scene, none is absorbed at its first hit, and bright surfaces get many.
class SystematicPlacement {
  public:
    /// @param residual  light to be scattered until the next vertex; uniform in [0, 1) at first
    explicit SystematicPlacement(double residual) : residual_(residual) {}

    /// Adds the vertices on a segment of `count` such pieces.
    /// @param beam  PathVertex::beam
    /// @param point_at  (f) the point, u and v, for a number in [0, 1) that grows along the segment
    template <typename PointAt>
    void add_vertices(
        const ScatteringPiece& piece,
        double count,
        std::uint32_t beam,
        const PointAt& point_at,
        std::vector<PathVertex>& vertices) {
        const double scattered = piece.scattered * count;
        double at = residual_;
        while (at < scattered) {
            const Barycentric where = point_at(at / scattered);
            vertices.push_back({piece.triangle, beam, where.u, where.v, piece.weight});
            at += 1;
        }
        residual_ = at - scattered;
    }

  private:
    double residual_;
};

/// Scores the direct light of one beam: on triangles, and as escaped light.
class DirectLightScore {
  public:
    /// Scores the light that `add_all(score)` adds, and the remainder of the beam as escaped.
    template <typename AddAll>
    static void score(
        const PreparedScene& prepared,
        const SurfaceBeam& beam,
        Tally& tally,
        const AddAll& add_all) {
        DirectLightScore direct(prepared, beam, tally);
        add_all(direct);
        direct.add_escaped();
    }

    /// Adds the light of `amount` paths on a triangle. @param along  as in scattering_piece()
    void add(std::uint32_t triangle, double along, double amount) {
        const std::uint32_t region = prepared_.region(triangle);
        // Slivers receive the light of their exact area; all light that is not stopped escapes.
        const double exact =
            amount * prepared_.rounding().light_share(triangle, beam_.direction, along);
        const std::int64_t fixed = to_fixed(exact);
        stopped_ += prepared_.material(region).is_transparent() ? 0 : fixed;
        if (!prepared_.fields_of_view().contain(region, std::abs(along))) {
            return;
        }
        tally_.add(region * stride_ + sides_[along > 0 ? 1 : 0], fixed);
        if (sums_sunlit_ && along != 0) {
            add_sunlit(triangle, along, amount);
        }
        if (sums_absorbed_) {
            add_absorbed(region, along, exact);
        }
    }

  private:
    DirectLightScore(const PreparedScene& prepared, const SurfaceBeam& beam, Tally& tally)
        : prepared_(prepared),
          beam_(beam),
          tally_(tally),
          stride_(tally.blocks().stride()),
          sides_{
              tally.blocks().direct(0, SurfaceSide::upper, beam.light->spectrum),
              tally.blocks().direct(0, SurfaceSide::lower, beam.light->spectrum)},
          sums_sunlit_(beam.light->lit_area > 0),
          sums_absorbed_(tally.blocks().has_absorbed()) {}

    void add_sunlit(std::uint32_t triangle, double along, double amount);
    void add_absorbed(std::uint32_t region, double along, double amount);
    void add_escaped();

    const PreparedScene& prepared_;
    const SurfaceBeam& beam_;
    Tally& tally_;
    std::size_t stride_;
    std::array<std::size_t, 2> sides_;  // bins of direct light of the two sides
    bool sums_sunlit_, sums_absorbed_;
    std::int64_t stopped_ = 0;  // fixed point
};

/// Sets `order` to that of the triangles, and of the points on each; stable.
struct VertexOrder {
    std::vector<std::uint32_t> order;
    std::vector<std::uint32_t> keys, key_counts, next;  // scratch
};
void order_by_position(
    std::span<const PathVertex> vertices, std::uint32_t triangles, VertexOrder& order);

}  // namespace quasimc
