#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "sums/exact_bins.h"
#include "sums/sum_layout.h"

namespace quasimc {

/// What a bin's unit stands for, made once for a run. After n samples (Sums::samples) a sum x of
/// region r stands for the flux x * flux[band] * region_scale[r] / n; of direct light, which is
/// summed per spectrum, times the spectrum's weight in the band.
struct SumUnits {
    std::vector<double> flux;  ///< per band, irradiance unit x square scene unit
    /// The same for what a single sample would have brought to a region, had it found light: the
    /// upper bound for a region that received nothing is made of it.
    std::vector<double> flux_per_find;
    double sunlit_area = 0;  ///< square scene units; 0 if no source counts as a sun
    double sunlit_area_per_find = 0;
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

/// The sums of a run, and all that is needed to tell what they mean: a value that can be added to,
/// kept and sent. results/evaluate.h turns it into a Result.
struct Sums {
    SumLayout layout;
    SumUnits units;
    std::vector<std::vector<double>> spectra;  ///< [spectrum][band], relative
    std::vector<double> emitted_flux;          ///< per band, of all sources into the scene
    MeasuredOrgans measured = MeasuredOrgans::all;
    EscapedLight escaped = EscapedLight::summed;
    std::vector<ExactBins> replicates;
    std::uint64_t paths = 0;    ///< done, per replicate
    std::uint64_t samples = 0;  ///< the same as the units count them: points of an organ, or paths
    std::uint64_t digest = 0;   ///< of what was asked: scene, sources, specification; 0: not known

    /// Adds the sums of other paths of the same run.
    /// @throws std::invalid_argument  if the two are not of one run: layout, units, number of
    ///         replicates or digest differ
    Sums& operator+=(const Sums& other);

    friend bool operator==(const Sums&, const Sums&) = default;
};

/// Sums as bytes, for files and other machines: the same on every machine of one byte order.
[[nodiscard]] std::string save_sums(const Sums& sums);
/// @throws std::invalid_argument  if these are not the bytes of sums: cut off, changed, of another
///         version or byte order
[[nodiscard]] Sums load_sums(std::string_view bytes);

/// Rays cast in all replicates.
[[nodiscard]] std::uint64_t count_rays(const Sums& sums);

}  // namespace quasimc
