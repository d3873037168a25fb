#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <stop_token>
#include <vector>

#include "quasimc/run.h"
#include "series/basis/light_sum.h"
#include "series/basis/season_basis.h"

namespace quasimc {

/// The suns of a time, and the number of the trace that looks at them (trace_spec()).
struct SunsOfTime {
    Sources suns;  ///< none: no sun shines
    std::uint64_t trace = 0;
};

/// Light straight from the suns of a series, each where it stands: pixel by pixel, as many as make
/// its error a part of the error of all other light.
class SeasonSuns {
  public:
    SeasonSuns(
        Simulator& simulator,
        const Scene& scene,
        const RunSpec& spec,
        const BasisLayout& layout,
        std::stop_token stop);

    /// Sets the pixels of each sun, from what a few times say.
    /// @param others  the other light of each
    /// @throws Stopped  if it was stopped
    void choose_pixels(std::span<const SunsOfTime> times, std::span<const SumWithVariance> others);
    [[nodiscard]] double pixels() const { return pixels_; }

    /// Light straight from the suns of several times; none where no sun shines. The same bits with
    /// any number of threads.
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
