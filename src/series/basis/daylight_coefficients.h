#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "light/models/sky_basis.h"
#include "quasimc/run.h"
#include "quasimc/series.h"
#include "series/basis/light_sum.h"

namespace quasimc {

/// A sun as a beam: its direction (for a disk: of its centre), and the irradiance on a plane facing
/// it, per band.
struct SunBeam {
    Vec3 to_light;
    std::vector<double> facing;
};
[[nodiscard]] SunBeam beam_of(const Source& sun);

/// Number of basis directions on the hemisphere.
[[nodiscard]] std::uint32_t season_directions();

/// The common basis of the time steps of a series: daylight coefficients, the responses of a scene
/// to light from a set of directions (Tregenza and Waters 1983). Skies and the scattered light of
/// suns are combinations of them (docs/develop/decisions/daylight-coefficients.md).
class DaylightCoefficients {
  public:
    /// Solves for all directions that some time step needs, and for a few reference time steps,
    /// which give the interpolation error.
    /// @param spec  without errors of check_together()
    /// @param control  only its stop and work are used
    /// @throws Stopped  if it was stopped
    DaylightCoefficients(
        Simulator& simulator,
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        const RunControl& control);

    /// Amounts of light from the directions: [direction][LightSum::add's amounts].
    using Amounts = std::vector<double>;
    [[nodiscard]] Amounts no_light() const;
    /// The amounts of a time step's skies and of the scattered light of its suns.
    /// @param suns  their direct light, if known: its first scattering scales the scattered light
    [[nodiscard]] Amounts amounts_of(const Sources& sources, const LightResponse* suns) const;
    /// The light of given amounts.
    [[nodiscard]] LightSum light_of(const Amounts& amounts) const;
    /// Computes the light of several time steps together.
    /// @param light  result; may be longer than `amounts`
    void find_light(std::span<const Amounts> amounts, std::vector<LightSum>& light) const;
    /// The relative interpolation error by BinIndex, as in LightResponse.
    [[nodiscard]] const std::vector<double>& errors() const { return errors_; }

    /// The time steps that were solved directly.
    [[nodiscard]] const std::vector<std::size_t>& reference_steps() const {
        return reference_steps_;
    }

    [[nodiscard]] const BasisLayout& layout() const { return layout_; }
    /// Number of lights that were solved for, and rays of all of them.
    [[nodiscard]] std::size_t lights() const { return lights_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    struct ReferenceStep;
    class Solving;

    [[nodiscard]] std::vector<bool> needed_nodes(const std::vector<TimeStep>& time_steps) const;
    [[nodiscard]] ReferenceStep prepare_reference(const TimeStep& step) const;

    /// Per band, the part of direct light that is scattered, in all.
    [[nodiscard]] std::vector<double> scattered_first(const LightResponse& direct) const;
    /// Adds the scattered light of suns whose first scattering is `first` per band; empty: unknown.
    void add_suns(
        const std::vector<SunBeam>& suns, std::span<const double> first, Amounts& amounts) const;
    void add_sky(const Source& sky, Amounts& amounts) const;
    void set_errors(const std::vector<ReferenceStep>& reference_steps);

    SkyBasis mesh_;
    BasisLayout layout_;
    std::size_t replicates_, lights_ = 0;
    unsigned threads_;
    std::uint64_t rays_ = 0;
    std::vector<double> albedos_;                       // [region][side][band]
    std::vector<LightResponse> responses_;              // by node; empty: no time needs it
    std::vector<std::vector<double>> scattered_first_;  // by node, per band
    std::vector<double> errors_;
    std::vector<std::size_t> reference_steps_;
};

/// Selects the suns or the other sources of a time step, those with light.
enum class Shining { suns, skies };
[[nodiscard]] Sources shining(const Sources& sources, Shining which);

}  // namespace quasimc
