#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "base/parallel.h"
#include "solvers/from_organs/from_organs_units.h"
#include "solvers/from_organs/lamp_near_field.h"
#include "solvers/from_organs/light_vertices.h"
#include "solvers/solver.h"
#include "sums/tally.h"

namespace quasimc {

/// The weights and light vertices of a subpath, reused by each worker.
struct LightSubpathScratch {
    explicit LightSubpathScratch(std::size_t bands) { resize_apart(weights, bands); }
    std::vector<double> weights;  // per band
    LightVertices vertices;
};

/// Light subpaths: paths from suns and lamps, which sample the light that points of organs do not
/// (PathClass).
class LightSubpaths {
  public:
    /// @param narrow_from  peak_brightness() from which on lobes count as narrow
    LightSubpaths(
        const SolverInput& input,
        const MeasuredArea& measured,
        const LampNearField& near,
        double narrow_from);

    /// Whether there may be such light; otherwise no subpath need be traced.
    [[nodiscard]] bool any() const { return any_; }
    /// Whether points of a region are connected with light vertices.
    [[nodiscard]] bool are_connected_with(std::uint32_t region) const {
        return !rules_.connected.empty() && rules_.connected[region] != 0;
    }
    /// Traces the subpath of a point of the set and scores its light. Its light vertices are then
    /// those in scratch.vertices. Returns the number of rays cast.
    /// @throws StopRequested  if a stop was requested
    std::uint64_t trace(
        const Stream& stream,
        std::uint64_t index,
        LightSubpathScratch& scratch,
        Tally& tally) const;

    /// The paths that count, and their units.
    struct Rules {
        const LampNearField& near;
        double narrow_from;
        std::vector<double> scales;   // by region: factor on its light
        std::vector<char> connected;  // by region: are_connected_with(), not 0; empty: none is
        bool has_unconnected;         // whether light counts on regions that are not
    };

  private:
    const PreparedScene& prepared_;
    const Sampler& sampler_;
    std::stop_token stop_;
    std::uint32_t max_depth_;
    double roulette_threshold_;
    Rules rules_;
    bool any_;
    std::uint32_t start_dimensions_;  // 2 if all sources are beams
};

}  // namespace quasimc
