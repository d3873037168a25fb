#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/parallel.h"
#include "geometry/raster/item_buffer.h"
#include "geometry/raster/scan_lines.h"
#include "samplers/sampler.h"
#include "solvers/run_spec.h"
#include "sums/tally.h"
#include "transport/prepared_scene.h"

namespace quasimc {

/// The points a run traces at one go, the same in every replicate.
struct Round {
    std::uint64_t first = 0;  ///< points traced before
    std::uint64_t count = 0;
};

/// BoundSource that comes to surfaces along one direction.
struct SurfaceBeam {
    const BoundSource* light = nullptr;
    Vec3 direction;
};

/// Where a path starts on a lit surface: a place on a triangle of the mesh.
struct PathVertex {
    std::uint32_t triangle = 0;
    std::uint32_t beam = 0;  ///< in Workspace::beams
    float u = 0, v = 0;
    double weight = 1;
};

/// BoundSource on its way from a surface.
struct ScatteredRay {
    Vec3 place, direction;
    std::uint32_t triangle = 0;  ///< from which it comes
    std::size_t start = 0;       ///< number of its path in the block
};

/// A piece of a lit surface as paths start from it.
struct ShiningPiece {
    double scattered = 0;  ///< as many starts, on average
    double weight = 0;     ///< of each
    std::uint32_t triangle = 0;
};

/// What a worker keeps between blocks so that nothing is allocated on the way. Its own alone: no
/// cache line is shared with another worker's.
struct alignas(2 * kCacheLine) Workspace {
    explicit Workspace(std::size_t bands) {
        resize_apart(weights, bands);
        resize_apart(products, bands);
        resize_apart(gathered, bands);
        resize_apart(fixed, bands);
    }

    std::vector<double> u0, u1, u2;     // coordinates of a block's points
    std::vector<std::uint32_t> lights;  // the light each picks; empty if there is one
    std::vector<std::uint32_t> order;   // in which to trace them
    std::vector<std::uint32_t> keys, key_counts, next_order;
    std::vector<double> weights, products, gathered;  // per band
    std::vector<std::int64_t> fixed;                  // per band
    ScanLines lines;
    std::optional<std::array<std::uint64_t, 3>> lines_of;  // their part, replicate and round
    ItemBuffer pixels;
    std::vector<ShiningPiece> shining;  // by item of the lines or pixels
    std::vector<SurfaceBeam> beams;
    std::vector<PathVertex> starts;
    std::vector<ScatteredRay> departures;  // of some of the starts
    std::vector<double> departing;         // their weights, per band
};

/// A way to compute the light on the organs: what one path does, and what a tally then means.
class Estimator {
  public:
    virtual ~Estimator() = default;
    Estimator() = default;
    Estimator(const Estimator&) = delete;
    Estimator& operator=(const Estimator&) = delete;

    /// Number of pieces a round of one replicate is cut into; does not depend on the number of
    /// threads.
    [[nodiscard]] virtual std::uint64_t blocks(const Round& round) const = 0;
    /// Traces a piece; a pure function of its arguments but for the order of the additions to
    /// `tally`.
    virtual void trace(
        const Round& round,
        std::uint32_t replicate,
        std::uint64_t block,
        Workspace& workspace,
        Tally& tally) const = 0;

    /// What one unit in a cell of `element` stands for after `paths` points: flux in `band` for
    /// direct and scattered light (direct light of a spectrum: times PreparedScene::spectra), lit
    /// area for the sunlit cell.
    [[nodiscard]] virtual double flux_per_unit(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const = 0;
    [[nodiscard]] virtual double sunlit_area_per_unit(
        std::uint32_t region, std::uint64_t paths) const = 0;
    /// The flux in `band` that a single one of `paths` points would have brought to `element`, had
    /// it found light: what the upper bound for an element that received nothing is made of.
    [[nodiscard]] virtual double flux_per_find(
        std::uint32_t region, std::size_t band, std::uint64_t paths) const = 0;

    [[nodiscard]] virtual double sunlit_area_per_find(
        std::uint32_t region, std::uint64_t paths) const = 0;

    /// Whether it computes the light of an organ.
    [[nodiscard]] virtual bool measures(const Organ&) const { return true; }
    /// Whether escaped and cut off light are counted on their own.
    [[nodiscard]] virtual bool counts_escapes() const = 0;
};

/// The estimator of a specification that was planned: trace_from is not automatic.
[[nodiscard]] std::unique_ptr<Estimator> make_estimator(
    const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec);

/// BoundSource tracing (solvers/light_tracing.cpp), tracing from the organs
/// (solvers/from_organs.cpp) and from lit surfaces (solvers/first_hits.cpp).
enum class Lights { all, lamps };
[[nodiscard]] std::unique_ptr<Estimator> make_forward_estimator(
    const PreparedScene& prepared,
    const Sampler& sampler,
    const RunSpec& spec,
    Lights lights = Lights::all);
[[nodiscard]] std::unique_ptr<Estimator> make_lit_surfaces_estimator(
    const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec);
[[nodiscard]] std::unique_ptr<Estimator> make_backward_estimator(
    const PreparedScene& prepared, const Sampler& sampler, const RunSpec& spec);

[[nodiscard]] inline TallyLayout tally_layout(const PreparedScene& prepared) {
    return {prepared.scene().regions().size(), prepared.spectra().size(), prepared.bands()};
}

}  // namespace quasimc
