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

/// A sun as a beam: where its light comes from (of a disk: from its middle), and the irradiance on
/// a plane that faces it, per band.
struct SunBeam {
    Vec3 to_light;
    std::vector<double> facing;
};
[[nodiscard]] SunBeam beam_of(const Source& sun);

/// Directions over the hemisphere, from whose light that of all times is put together.
[[nodiscard]] std::uint32_t season_directions();

/// What the times of a series have in common: the responses of a scene to light from a set of
/// directions, of which skies, and the scattered light of suns, are put together
/// (docs/develop/decisions/daylight-coefficients.md).
class SeasonBasis {
  public:
    /// Solves for all directions that some time needs, and for a few times as they are, which tell
    /// the error of the others.
    /// @param spec  that check_together() found no fault with
    /// @param control  whose stop and work count
    /// @throws Stopped  if it was stopped
    SeasonBasis(
        Simulator& simulator,
        const Scene& scene,
        const std::vector<TimeStep>& time_steps,
        const RunSpec& spec,
        const RunControl& control);

    /// Amounts of light from the directions: [direction][LightSum::add's amounts].
    using Amounts = std::vector<double>;
    [[nodiscard]] Amounts no_light() const;
    /// Those of a time's skies and of the scattered light of its suns.
    /// @param suns  light straight from them, if it is known: what of it is scattered first tells
    ///        how much is scattered in all
    [[nodiscard]] Amounts amounts_of(const Sources& sources, const LightResponse* suns) const;
    /// That light.
    [[nodiscard]] LightSum light_of(const Amounts& amounts) const;
    /// That of several times at once.
    /// @param light  gets it, the first time first; it is longer where it was
    void find_light(std::span<const Amounts> amounts, std::vector<LightSum>& light) const;
    /// Its relative error by BinIndex, as in LightResponse.
    [[nodiscard]] const std::vector<double>& errors() const { return errors_; }

    /// The times that were solved for as they are.
    [[nodiscard]] const std::vector<std::size_t>& reference_steps() const {
        return reference_steps_;
    }

    [[nodiscard]] const BasisLayout& layout() const { return layout_; }
    /// Lights that were solved for, and rays of all of them.
    [[nodiscard]] std::size_t lights() const { return lights_; }
    [[nodiscard]] std::uint64_t rays() const { return rays_; }

  private:
    struct ReferenceStep;
    class Solving;

    [[nodiscard]] std::vector<bool> needed_nodes(const std::vector<TimeStep>& time_steps) const;
    [[nodiscard]] ReferenceStep prepare_reference(const TimeStep& step) const;

    /// Per band, what of the light straight from a source is scattered, in all.
    [[nodiscard]] std::vector<double> scattered_first(const LightResponse& direct) const;
    /// Adds scattered light of suns that would scatter `first` per band; empty: not known.
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

/// The sources of a time that are suns and shine, or those that are not and do.
enum class Shining { suns, skies };
[[nodiscard]] Sources shining(const Sources& sources, Shining which);

}  // namespace quasimc
