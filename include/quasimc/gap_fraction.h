#pragma once

// Gaps of a canopy as seen from positions in it, by zenith angle and azimuth, and the plant
// area indices that follow from them. Geometry alone: no light is needed.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/scene.h"
#include "quasimc/sums.h"

namespace quasimc {

/// Positions below a canopy, and the bins of the directions upwards from them.
struct GapFractionSpec {
    std::string name = "gap_fraction";
    std::vector<Vec3> positions;  ///< at least one; the file's axes, unit of length
    /// Bounds of rings, degrees from the zenith, ascending within 0 to 90; default: those of the
    /// LAI-2000 (LI-COR).
    std::vector<double> rings_deg = {0, 13, 28, 43, 58, 74};
    std::uint32_t azimuths = 8;  ///< equal sectors, the first begins at north, clockwise
    std::string where = {};      ///< condition on the organs that block the view; "": all
    std::uint32_t rays = 4096;   ///< number for each position and replicate, equal for all bins
    std::uint32_t replicates = 8;
    std::uint64_t seed = 1;
    unsigned threads = 0;       ///< 0: all of the machine; does not change results
    std::string location = {};  ///< for messages; default: its name

    [[nodiscard]] std::size_t rings() const { return rings_deg.size() - 1; }
};

/// Indices from the gaps of one position, or of several. Standard errors are those of the sampled
/// directions; the differences between positions are not in them.
///
/// With P the gap fraction of a bin, the contact number of a ring is K = -ln(P) (cos a + cos b) / 2
/// for its bounds a and b, and the plant area index 2 sum(K (cos a - cos b)), where the last ring
/// represents all angles up to the horizon (Miller 1967, Australian Journal of Botany 15, eq. 6). A
/// bin without a gap counts as half a ray.
struct GapIndices {
    std::vector<Estimate> gap;  ///< mean gap fraction, by ring
    /// By ring: ln of the mean gap over the mean of ln of the gaps of sectors and positions, 0 to
    /// 1; NaN where nothing blocks or all is blocked (Lang and Xiang 1986, Agricultural and Forest
    /// Meteorology 37).
    std::vector<Estimate> clumping;
    /// Transmitted fraction of a uniform sky's irradiance on the horizontal, by unscattered light,
    /// where each ring has its mean gap and the last one represents all angles down to the horizon.
    Estimate sky_transmittance;
    /// One-sided plant area per ground area from mean gaps: as if leaves were spread at random.
    Estimate effective_plant_area_index;
    Estimate plant_area_index;  ///< from the mean of ln of the gaps of sectors and positions
    Estimate clumping_index;    ///< the effective index over the corrected one
    /// With the default rings: the index that the instrument would report, from the mean of ln of
    /// the gaps of positions, with its weights and path lengths (Welles and Norman 1991, Agronomy
    /// Journal 83).
    std::optional<Estimate> lai_2000;
    std::size_t closed_bins = 0;  ///< number of sectors without a gap, over positions and rings
};

/// Gap fractions of a scene.
struct GapFractions {
    GapFractionSpec spec;
    std::vector<Estimate> gaps;           ///< see gap()
    GapIndices all;                       ///< all positions together
    std::vector<GapIndices> by_position;  ///< per position

    /// The gap fraction of a sector of a ring as a position sees it, 0 to 1.
    [[nodiscard]] const Estimate& gap(
        std::size_t position, std::size_t ring, std::size_t sector) const {
        return gaps[(position * spec.rings() + ring) * spec.azimuths + sector];
    }
};

/// The largest numbers of a specification.
inline constexpr std::uint32_t kMaxGapAzimuths = 360, kMaxGapRays = 1U << 24U,
                               kMaxGapReplicates = 1024;

/// Adds a fault for each key of `spec` outside its domain, a name in `where` that no organ of the
/// scene has, and positions below the ground.
void check_gap_fraction(const Scene& scene, const GapFractionSpec& spec, Faults& faults);

/// The part of check_gap_fraction() that needs no scene.
void check_gap_keys(const GapFractionSpec& spec, Faults& faults);

/// Casts rays from the positions. Takes about a microsecond a ray.
/// @throws InputError  as check_gap_fraction()
/// @throws StopRequested  if a stop is requested before it is complete
[[nodiscard]] GapFractions gap_fractions(
    const Scene& scene, const GapFractionSpec& spec, const std::stop_token& stop = {});

}  // namespace quasimc
