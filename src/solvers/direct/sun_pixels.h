#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "raster/item_buffer.h"
#include "solvers/direct/projection_input.h"
#include "solvers/solver.h"

namespace quasimc {

/// Light straight from suns, as one replicate sees it.
struct SunLight {
    std::vector<double> flux;         ///< [region][side][band], what falls on each
    std::vector<double> sunlit_area;  ///< by region, of suns by their share in the irradiance
    std::vector<double> emitted;      ///< per band, into the scene
    std::vector<double> escaped;      ///< per band, past all that is opaque
};

/// Direct light of suns alone, each viewed pixel by pixel. For several views of organs that need
/// not be seen to a percent each this is faster than scan lines, of which the first few cost as
/// much as all pixels (docs/develop/notebook/time-series.md).
class SunPixels {
  public:
    /// @param input  all lights of which are suns
    /// @param pixels  about as many of each beam, over the scene or a period of it
    SunPixels(const SolverInput& input, double pixels);

    /// The light of a replicate.
    /// @throws StopRequested  if a stop was requested
    [[nodiscard]] SunLight find(std::uint32_t replicate, ItemScratch& scratch) const;

  private:
    /// Light along one direction, in parts of the light of all suns.
    struct View {
        const BoundSource& light;
        Vec3 direction;
        double part = 0;
        double of_pixel = 0;  ///< of a pixel; at first of an area of 1, local units squared
    };

    /// The point that shifts a beam, and that of the first beam of its sun.
    struct Placing {
        const Stream& stream;
        std::uint64_t first, point;
    };

    [[nodiscard]] View view_of(const BoundSource& light, const Placing& placing) const;
    void score(const View& view, const ItemBuffer& image, SunLight& found) const;
    void settle(SunLight& found) const;

    const PreparedScene& prepared_;
    const Sampler& sampler_;
    const RunSpec& spec_;
    std::stop_token stop_;
    ProjectionInput seen_;
    double pixels_;
};

}  // namespace quasimc
