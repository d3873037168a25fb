#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "quasimc/sums.h"
#include "sums/contributions.h"
#include "sums/exact_bins.h"
#include "sums/sum_layout.h"

namespace quasimc {

/// What a bin's unit stands for, made once for a run. After n samples a sum x of region r stands
/// for the flux x * flux[band] * region_scale[r] / n; of direct light, which is summed per
/// spectrum, times the spectrum's weight in the band.
struct SumUnits {
    std::vector<double> flux;               ///< per band, irradiance unit x square scene unit
    double sunlit_area = 0;                 ///< square scene units; 0 if no source counts as a sun
    std::vector<double> region_scale = {};  ///< per region; empty: 1

    [[nodiscard]] double scale(std::size_t region) const {
        return region_scale.empty() ? 1 : region_scale[region];
    }
    friend bool operator==(const SumUnits&, const SumUnits&) = default;
};

/// Whose light is summed.
enum class MeasuredOrgans {
    all,
    asked_for,  ///< those with Organ::measured alone
};
/// What is known of light that leaves the scene.
enum class EscapedLight {
    summed,
    remainder,  ///< what was emitted and not absorbed
};

/// The content of Sums. evaluate() turns it into a Result.
struct SumData {
    SumLayout layout;
    SumUnits units;
    std::vector<ContributionBound> bounds;
    /// Of all lights, those first whose contributions are counted (blocks "squares"). Empty: a
    /// contribution is bounds' alone.
    std::vector<SamplingStrategy> strategies;
    std::vector<std::vector<double>> spectra;  ///< [spectrum][band], relative
    std::vector<double> emitted_flux;          ///< per band, of all sources into the scene
    MeasuredOrgans measured = MeasuredOrgans::all;
    EscapedLight escaped = EscapedLight::summed;
    std::vector<ExactBins> replicates;
    std::uint64_t paths = 0;    ///< done, per replicate
    std::uint64_t samples = 0;  ///< the same as the units count them: points of an organ, or paths
    /// By strategy: units of light of a contribution, where they were most in a round.
    std::vector<double> per_contribution = {};
    std::uint64_t digest = 0;  ///< of what was asked: scene, sources, specification; 0: not known

    [[nodiscard]] std::size_t bands() const { return units.flux.size(); }
    /// The bound of a quantity; one of 0 if none was declared.
    [[nodiscard]] const ContributionBound& bound(std::string_view quantity) const;

    friend bool operator==(const SumData&, const SumData&) = default;
};

/// Copies what sums mean, and nothing of what was summed: without replicates, paths, samples or
/// digest.
[[nodiscard]] SumData meaning_of(const SumData& sums);

/// The sums of a run's first replicates alone, which have traced all of a round.
[[nodiscard]] Sums first_replicates(
    const Sums& sums, std::size_t count, std::uint64_t paths, std::uint64_t samples);

}  // namespace quasimc
