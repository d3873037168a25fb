#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "quasimc/run.h"
#include "series/basis/daylight_coefficients.h"
#include "series/basis/light_sum.h"

namespace quasimc {

/// The suns of a time step, and the number of the trace for them (trace_spec()).
struct SunsOfTime {
    Sources suns;  ///< none: no sun shines
    std::uint64_t trace = 0;
};

/// Direct light of the suns of a series, by item buffers: the number of pixels makes its error a
/// fixed part of the error of all other light.
class SeasonSuns {
  public:
    SeasonSuns(
        Simulator& simulator,
        const Scene& scene,
        const RunSpec& spec,
        const BasisLayout& layout,
        std::stop_token stop);

    /// Sets the number of pixels of each sun, from a few time steps.
    /// @param others  the other light of each time step
    /// @throws Stopped  if it was stopped
    void choose_pixels(std::span<const SunsOfTime> times, std::span<const SumWithVariance> others);
    [[nodiscard]] double pixels() const { return pixels_; }

    /// Direct light of the suns of several time steps; none without sun. The same bits with any
    /// number of threads.
    /// @throws Stopped  if it was stopped
    [[nodiscard]] std::vector<std::optional<LightResponse>> light_of(
        std::span<const SunsOfTime> times) const;

  private:
    Simulator& simulator_;
    const Scene& scene_;
    const RunSpec& spec_;
    BasisLayout layout_;
    std::stop_token stop_;
    double pixels_;
};

}  // namespace quasimc
