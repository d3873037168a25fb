#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "raster/item_buffer.h"
#include "solvers/direct/projection_input.h"
#include "solvers/solver.h"

namespace quasimc {

/// Direct light of suns, as estimated by one replicate.
struct SunLight {
    std::vector<double> flux;         ///< incident, [region][side][band]
    std::vector<double> sunlit_area;  ///< by region, with suns weighted by their irradiance
    std::vector<double> emitted;      ///< per band, into the scene
    std::vector<double> escaped;      ///< per band, past all that is opaque
};

/// Direct light of suns by item buffers. For many suns that need not be accurate to a percent each,
/// this is faster than scan lines, the first few of which cost as much as all pixels
/// (docs/develop/notebook/time-series.md).
class SunPixels {
  public:
    /// @param input  with suns as its only lights
    /// @param pixels  approximate number for each beam, over the scene or a period of it
    SunPixels(const SolverInput& input, double pixels);

    /// The light of a replicate.
    /// @throws StopRequested  if a stop was requested
    [[nodiscard]] SunLight find(std::uint32_t replicate, ItemScratch& scratch) const;

  private:
    /// Light along one direction, as a fraction of the light of all suns.
    struct View {
        const BoundSource& light;
        Vec3 direction;
        double part = 0;
        double of_pixel = 0;  ///< light per pixel; at first per area, local units squared
    };

    /// The point that shifts a beam, and that of the first beam of its sun.
    struct Placing {
        const Stream& stream;
        std::uint64_t first, point;
    };

    [[nodiscard]] View view_of(const BoundSource& light, const Placing& placing) const;
    void score(const View& view, const ItemBuffer& image, SunLight& found) const;
    void normalize(SunLight& found) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    ProjectionInput projection_input_;
    double pixels_;
};

}  // namespace quasimc
