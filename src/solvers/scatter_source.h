#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "solvers/estimator.h"
#include "transport/particle.h"

namespace quasimc {

/// What each side of each material scatters of the light of each spectrum, relative to the side
/// that scatters most: mean over the bands, weighted by their light. 0 for sensors.
class ScatteredShares {
  public:
    explicit ScatteredShares(const PreparedScene& prepared);

    [[nodiscard]] double of(std::size_t spectrum, std::size_t material, bool lower) const {
        return shares_[2 * (spectrum * materials_ + material) + (lower ? 1 : 0)];
    }

  private:
    std::size_t materials_;
    std::vector<double> shares_;  // [spectrum][material][upper, lower]
};

/// BoundSource known to fall on surfaces straight from the sources, a block of it: scores it,
/// places the starts of paths at equal steps of what is scattered, and traces these.
///
/// Systematic sampling: along the light in the order in which it is told, each start stands for as
/// much as one path brings, so that none misses the scene, none is absorbed at its first hit, and
/// bright surfaces get many.
class ScatterSource {
  public:
    /// @param rules  stream and limits; the number of points and the dimensions are set here
    ScatterSource(
        const ScatteredShares& shares, const PathRules& rules, Workspace& workspace, Tally& tally);

    /// BoundSource that comes along `direction` is told from now on, until end_beam().
    /// @param paths  how many paths' light there is in all
    /// @param to_next  light to be scattered until the next start; goes on from beam to beam.
    ///        Uniform in [0, 1) at first
    void begin_beam(
        const BoundSource& light, const Vec3& direction, double paths, double& residual);
    /// `amount` paths' light falls on a triangle. @param cosine  of the upper side and the beam's
    /// direction: above 0 it is the lower side that is lit
    void fall(std::uint32_t triangle, double cosine, double amount);
    /// What such light starts.
    [[nodiscard]] ShiningPiece shining(std::uint32_t triangle, double cosine, double amount) const;
    /// Places starts on a stretch of so many pieces.
    /// @param place  (f) of a number in [0, 1) that grows along the light: where it falls, u and v
    template <typename Place>
    void scatter(const ShiningPiece& piece, double count, const Place& place) {
        const double scattered = piece.scattered * count;
        double at = *residual_;
        while (at < scattered) {
            const auto [u, v] = place(at / scattered);
            add_start(piece.triangle, u, v, piece.weight);
            at += 1;
        }
        *residual_ = at - scattered;
    }
    /// What has fallen on nothing, flies by.
    void end_beam();

    /// Traces the paths, surface after surface, so that the directions in which one scatters are
    /// neighbours in the point set. Tallies the rays.
    void trace();

  private:
    [[nodiscard]] Particle path_of(std::size_t i) const;
    void depart_from(std::size_t first, std::size_t end);
    [[nodiscard]] std::span<double> weights_of(std::size_t departure);
    void draw_numbers(std::size_t first, std::size_t end);
    void add_start(std::uint32_t triangle, float u, float v, double weight);

    const ScatteredShares& shares_;
    PathRules rules_;
    const PreparedScene& prepared_;
    Workspace& workspace_;
    Tally& tally_;
    const BoundSource* light_ = nullptr;
    double* residual_ = nullptr;
    bool spread_ = false;                     // points over all of the set
    std::int64_t emitted_ = 0, stopped_ = 0;  // of the beam, fixed point
};

}  // namespace quasimc
