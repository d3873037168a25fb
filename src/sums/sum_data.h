#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/sums.h"
#include "sums/contributions.h"
#include "sums/exact_bins.h"
#include "sums/sum_layout.h"
#include "sums/work_unit.h"

namespace quasimc {

/// The meaning of a bin's unit, set once for a run. After n samples a sum x of region r represents
/// the flux x * flux[band] * region_scale[r] / n; of direct light, which is summed per spectrum,
/// times the spectrum's weight in the band.
struct SumUnits {
    std::vector<double> flux;               ///< per band, irradiance unit x square scene unit
    double sunlit_area = 0;                 ///< square scene units; 0 if no source counts as a sun
    std::vector<double> region_scale = {};  ///< per region; empty: 1

    [[nodiscard]] double scale(std::size_t region) const {
        return region_scale.empty() ? 1 : region_scale[region];
    }
    friend bool operator==(const SumUnits&, const SumUnits&) = default;
};

/// The organs whose light is summed.
enum class MeasuredOrgans {
    all,
    requested,  ///< only those with Organ::measured
};
/// How escaped light is obtained.
enum class EscapedLight {
    summed,
    remainder,  ///< emitted minus absorbed light
};

/// An origin of light, whose sums are kept apart.
struct SumOrigin {
    std::string name;
    bool has_suns = false;
    std::vector<std::size_t> spectra;
    std::vector<double> emitted_flux;  ///< per band, into the scene
    friend bool operator==(const SumOrigin&, const SumOrigin&) = default;
};

/// The content of Sums. evaluate() turns it into a Result.
struct SumData {
    SumLayout layout;
    SumUnits units;
    std::vector<ContributionBound> bounds;
    /// Strategies of all lights, first those whose contributions are counted (blocks "squares").
    /// Empty: only bounds apply.
    std::vector<SamplingStrategy> strategies;
    std::vector<std::vector<double>> spectra;   ///< [spectrum][band], relative
    std::vector<std::size_t> sun_spectra = {};  ///< indices of those of suns
    std::vector<double> emitted_flux;           ///< per band, of all sources into the scene
    MeasuredOrgans measured = MeasuredOrgans::all;
    EscapedLight escaped = EscapedLight::summed;
    std::vector<SumOrigin> origins = {};  ///< empty: light is not kept apart
    std::vector<ExactBins> replicates;
    std::uint64_t paths = 0;  ///< completed, per replicate
    std::uint64_t samples =
        0;  ///< per replicate, as units count them: points of an organ, or paths
    /// By strategy: largest light of a contribution in any round, in units.
    std::vector<double> per_contribution = {};
    std::uint64_t digest = 0;  ///< hash of scene, sources and specification; 0: unknown

    [[nodiscard]] std::size_t bands() const { return units.flux.size(); }
    /// The bound of a quantity; one of 0 if none was declared.
    [[nodiscard]] const ContributionBound& bound(std::string_view quantity) const;

    friend bool operator==(const SumData&, const SumData&) = default;
};

/// The work that all replicates did, counted in a unit.
[[nodiscard]] std::uint64_t work_of(const SumData& sums, WorkUnit unit);

/// Contributions of scattered light in a replicate (mean), to which its bound applies.
[[nodiscard]] double samples_of_scattered(const SumData& sums);

/// Copies the meaning of sums, without replicates, paths, samples or digest.
[[nodiscard]] SumData meaning_of(const SumData& sums);

/// The sums of a run's first replicates, which have completed a round.
[[nodiscard]] Sums first_replicates(
    const Sums& sums, std::size_t count, std::uint64_t paths, std::uint64_t samples);

}  // namespace quasimc
