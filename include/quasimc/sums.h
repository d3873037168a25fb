#pragma once

// Estimates, and the sums of a run that they are made of.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"

namespace quasimc {

/// A number estimated from independent randomizations.
struct Estimate {
    double mean = 0;
    double standard_error =
        0;           ///< of the mean; NaN when it can't be told (one replicate, or nothing was hit)
    double low = 0;  ///< 95 % confidence interval
    double high = 0;
};

/// Of a number of which nothing is known: NaN in all places.
inline constexpr Estimate kUnknownEstimate{
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN(),
    std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// The estimate of a number times `factor` >= 0.
[[nodiscard]] constexpr Estimate scaled(const Estimate& e, double factor) {
    return {e.mean * factor, e.standard_error * factor, e.low * factor, e.high * factor};
}

/// Where the bins of one kind of sum stand: a table of rows and columns.
struct SumBlock {
    std::string name;       ///< "direct", "scattered", ...
    std::size_t first = 0;  ///< bin of row 0, column 0
    std::size_t rows = 1, columns = 1;
    std::size_t stride = 1;  ///< bins from one row to the next

    [[nodiscard]] std::size_t bin(std::size_t row, std::size_t column) const {
        return first + row * stride + column;
    }
    friend bool operator==(const SumBlock&, const SumBlock&) = default;
};

/// Bins that a detector asks for, beside those of the surfaces.
struct DetectorBins {
    std::string name;
    std::size_t bins = 0;
    friend bool operator==(const DetectorBins&, const DetectorBins&) = default;
};

/// Whether what surfaces absorb is summed on its own, in every band. It follows from the light that
/// falls on them, and need not be, where no albedo depends on the angle.
enum class AbsorbedLight { inferred, summed };

/// Whether the light is summed that would come straight from the sources if nothing stood in its
/// way: what a sample of an organ could have found.
enum class UnoccludedLight { left_out, summed };

/// Whether scattered light was computed with patches of surfaces, each as bright all over, on two
/// levels: the sums hold that of the finer patches, and beside it that of the coarser ones. The
/// difference of the two tells the error of the finer (docs/theory/ray-bundles.md).
enum class PatchLevels { none, two };

/// What is summed, and in which bin.
///
/// Light that arrives straight from a source is summed per spectrum, not per band: all bands of it
/// follow by multiplication. So a band costs memory and time only where light has been scattered.
///
/// For each region (a part of an organ that is of one material) the bins stand together, because a
/// hit adds to several: direct[side][spectrum], scattered[side][band], sunlit, and where absorbed
/// light is summed absorbed_direct[band] and absorbed_scattered[band], and where unoccluded light
/// is summed unoccluded[side][spectrum], and of kinds of lights whose finds are counted
/// squares[kind][side], and of two levels of patches coarse_scattered[side][band]; then those of
/// the run: emitted[spectrum], escaped_direct[spectrum], escaped_scattered[band],
/// scattered_out[band], cut_off[band], rays, and of two levels of patches the three before once
/// more; then those of detectors.
struct SumLayout {
    std::size_t regions = 0;
    std::size_t spectra = 1;
    std::size_t bands = 1;
    AbsorbedLight absorbed_light = AbsorbedLight::inferred;
    UnoccludedLight unoccluded_light = UnoccludedLight::left_out;
    std::vector<DetectorBins> detectors = {};
    std::size_t counted_kinds = 0;  ///< SumUnits::kinds, the first so many of them
    PatchLevels patch_levels = PatchLevels::none;

    [[nodiscard]] std::size_t coarse_bands() const {
        return patch_levels == PatchLevels::two ? bands : 0;
    }
    [[nodiscard]] std::size_t absorbed_bands() const {
        return absorbed_light == AbsorbedLight::summed ? bands : 0;
    }
    [[nodiscard]] std::size_t unoccluded_spectra() const {
        return unoccluded_light == UnoccludedLight::summed ? spectra : 0;
    }
    [[nodiscard]] std::size_t stride() const {
        return 2 * spectra + 2 * bands + 1 + 2 * absorbed_bands() + 2 * unoccluded_spectra() +
               2 * counted_kinds + 2 * coarse_bands();
    }
    [[nodiscard]] std::size_t direct(
        std::size_t region, SurfaceSide side, std::size_t spectrum) const {
        return region * stride() + index_of(side) * spectra + spectrum;
    }
    [[nodiscard]] std::size_t scattered(std::size_t region, SurfaceSide side) const {
        return region * stride() + 2 * spectra + index_of(side) * bands;
    }
    [[nodiscard]] std::size_t sunlit(std::size_t region) const {
        return region * stride() + 2 * spectra + 2 * bands;
    }
    [[nodiscard]] std::size_t absorbed_direct(std::size_t region) const {
        return sunlit(region) + 1;
    }
    [[nodiscard]] std::size_t absorbed_scattered(std::size_t region) const {
        return absorbed_direct(region) + absorbed_bands();
    }
    [[nodiscard]] std::size_t unoccluded(
        std::size_t region, SurfaceSide side, std::size_t spectrum) const {
        return absorbed_scattered(region) + absorbed_bands() + index_of(side) * spectra + spectrum;
    }
    /// Of the light that each find of a kind brought, the square, in squares of the most it could
    /// (LightKind::step).
    [[nodiscard]] std::size_t squares(
        std::size_t region, SurfaceSide side, std::size_t kind) const {
        return unoccluded(region, SurfaceSide::upper, 0) + 2 * unoccluded_spectra() + 2 * kind +
               index_of(side);
    }
    /// Of two levels of patches.
    [[nodiscard]] std::size_t coarse_scattered(std::size_t region, SurfaceSide side) const {
        return squares(region, SurfaceSide::upper, 0) + 2 * counted_kinds +
               index_of(side) * coarse_bands();
    }
    [[nodiscard]] std::size_t emitted() const { return regions * stride(); }
    [[nodiscard]] std::size_t escaped_direct() const { return emitted() + spectra; }
    [[nodiscard]] std::size_t escaped_scattered() const { return escaped_direct() + spectra; }
    [[nodiscard]] std::size_t scattered_out() const { return escaped_scattered() + bands; }
    [[nodiscard]] std::size_t cut_off() const { return scattered_out() + bands; }
    [[nodiscard]] std::size_t rays() const { return cut_off() + bands; }
    /// Of two levels of patches: escaped_scattered, scattered_out and cut_off of the coarser.
    [[nodiscard]] std::size_t coarse_escaped() const { return rays() + 1; }
    /// The first bin of a detector.
    [[nodiscard]] std::size_t detector(std::size_t index) const;
    [[nodiscard]] std::size_t bins() const { return detector(detectors.size()); }

    /// All of it by name: every bin belongs to one block.
    [[nodiscard]] std::vector<SumBlock> blocks() const;

    friend bool operator==(const SumLayout&, const SumLayout&) = default;
};

/// Exact sums of any size: one 64-bit number for each bin, and a second one, which counts carries,
/// for all of them once the first of them needs it.
///
/// Between calls every bin's lower number lies within (-kCarry, kCarry), but for those that others
/// add to through shared().
class ExactBins {
  public:
    /// Steps that a carry stands for.
    static constexpr std::int64_t kCarry = std::int64_t{1} << 62U;

    /// Steps of a unit.
    static constexpr double kStepsPerUnit = 268435456.0;

    ExactBins() = default;
    explicit ExactBins(std::size_t bins) : low_(bins) {}

    [[nodiscard]] std::size_t size() const { return low_.size(); }
    /// The sum in units.
    [[nodiscard]] double value(std::size_t bin) const {
        return carries_.empty() ? static_cast<double>(low_[bin]) / kStepsPerUnit
                                : value_with_carries(bin);
    }
    /// The sum as steps: carries * kCarry + low, both of one sign. One sum is one pair, in whatever
    /// order it was added up.
    struct Steps {
        std::int64_t carries = 0, low = 0;
        friend bool operator==(const Steps&, const Steps&) = default;
    };
    [[nodiscard]] Steps steps(std::size_t bin) const {
        return carries_.empty() ? Steps{0, low_[bin]} : steps_with_carries(bin);
    }

    /// Adds any number of steps to a bin.
    void add(std::size_t bin, std::int64_t steps) {
        std::int64_t sum = 0;
        const bool is_out = __builtin_add_overflow(low_[bin], steps, &sum);
        if (is_out || sum >= kCarry || sum <= -kCarry) [[unlikely]] {
            add_with_carry(bin, steps);
        } else {
            low_[bin] = sum;
        }
    }
    void add(std::size_t bin, Steps steps);
    /// Adds the sums of another, of the same size.
    ExactBins& operator+=(const ExactBins& other);

    /// The lower numbers, to which workers may add atomically. settle() carries what has grown too
    /// large; each may grow by kCarry in between.
    [[nodiscard]] std::span<std::int64_t> shared() { return low_; }
    void settle();

    /// Makes the bins from `first` up to `last` 0, which most of their memory is not needed for.
    void clear(std::size_t first, std::size_t last);

    friend bool operator==(const ExactBins& a, const ExactBins& b);

  private:
    [[nodiscard]] Steps steps_with_carries(std::size_t bin) const;
    [[nodiscard]] double value_with_carries(std::size_t bin) const;
    void add_with_carry(std::size_t bin, std::int64_t steps);
    void carry(std::size_t bin, std::int64_t carries);

    std::vector<std::int64_t> low_;
    std::vector<std::int64_t> carries_;  // empty: 0
};

/// How the direct light of some lights is found: each path is a find, or all that comes along a
/// scan line, or a direction of the skies.
enum class FoundBy { paths, lines, directions };

/// Lights whose direct light is found in one way. What a run may have overlooked is told kind by
/// kind: one find brings more or less, and what the sun lights the sky may not have found.
struct LightKind {
    FoundBy found_by = FoundBy::paths;
    bool has_suns = false;
    /// Of these lights, and of no others; empty: of another kind's lights too, so that it is not
    /// known what of their light these have brought.
    std::vector<std::size_t> spectra;
    std::vector<double> flux;  ///< per band, as SumUnits::flux: of the brightest spectrum
    /// By side of a region (2 * region + side): how much of the light of one find it can get, 0
    /// where it faces none of the lights. Of lines: a length, in local units. Empty: all.
    std::vector<double> reach = {};
    std::vector<double> sunlit_reach = {};  ///< of suns, by region: the same of the area lit
    double step = 1;                        ///< light of a find in the first round, in units
    double many = 5;  ///< finds in each replicate from which on replicates tell all
    /// How much of `reach` one find could be of light that no replicate has found at all: of a lit
    /// part that slips through between lines none could cut more than that.
    double unseen_reach = std::numeric_limits<double>::infinity();

    friend bool operator==(const LightKind&, const LightKind&) = default;
};

/// What a bin's unit stands for, made once for a run. After n samples (Sums::samples) a sum x of
/// region r stands for the flux x * flux[band] * region_scale[r] / n; of direct light, which is
/// summed per spectrum, times the spectrum's weight in the band.
struct SumUnits {
    std::vector<double> flux;  ///< per band, irradiance unit x square scene unit
    /// The same for what a single sample would have brought to a region, had it found light: the
    /// upper bound for a region that received nothing is made of it.
    std::vector<double> flux_per_find;
    /// The same of scattered light; empty: the same.
    std::vector<double> scattered_flux_per_find = {};
    /// The same of a light path that is followed along with a sample, whatever region it meets;
    /// empty if there are none.
    std::vector<double> flux_per_light_path = {};
    /// Per region, how much of that one may bring; empty: all.
    std::vector<double> light_path_part = {};
    double sunlit_area = 0;  ///< square scene units; 0 if no source counts as a sun
    double sunlit_area_per_find = 0;
    std::vector<double> region_scale = {};  ///< per region; empty: 1
    std::vector<double> find_scale = {};    ///< the same of a find; empty: region_scale
    /// Of all lights, those first whose finds are counted. Empty: a find is flux_per_find.
    std::vector<LightKind> kinds = {};

    [[nodiscard]] double scale(std::size_t region) const {
        return region_scale.empty() ? 1 : region_scale[region];
    }
    [[nodiscard]] double scale_of_find(std::size_t region) const {
        return find_scale.empty() ? scale(region) : find_scale[region];
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
/// kept and sent. evaluate() turns it into a Result.
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
    /// By kind of lights: units of light that a find brought, where it was most in a round.
    std::vector<double> per_find = {};
    std::uint64_t digest = 0;  ///< of what was asked: scene, sources, specification; 0: not known

    /// Adds the sums of other paths of the same run.
    /// @throws std::invalid_argument  if the two are not of one run: layout, units, number of
    ///         replicates or digest differ
    Sums& operator+=(const Sums& other);
    /// Adds the sums of another share of the same paths.
    /// @throws std::invalid_argument  if the two are not of one run, or not of as many paths
    Sums& add_share(const Sums& other);

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
