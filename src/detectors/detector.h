#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/vec3.h"
#include "sums/tally.h"

namespace quasimc {

/// Meaning of the bins of a detector.
struct DetectorAxis {
    std::string quantity;           ///< sorts the light; with its unit: "zenith angle (deg)"
    std::vector<std::string> bins;  ///< their names, in order: "0 to 20"
};

/// Sorts light into its own bins, in addition to those of the surfaces, without changing paths.
///
/// Const and shared by all threads; a pure function of its arguments. For every bin of the axis it
/// has one bin of the sums in each band: that of band b in bin i is first + i * bands + b.
class Detector {
  public:
    virtual ~Detector() = default;
    Detector() = default;
    Detector(const Detector&) = delete;
    Detector& operator=(const Detector&) = delete;

    /// The axis: at least one bin, with unique names.
    [[nodiscard]] virtual DetectorAxis axis() const = 0;

    /// Receives scattered light that leaves the scene. The detector must add exactly these amounts,
    /// or nothing.
    /// @param direction  direction of travel, unit length, z up
    /// @param amounts  per band, fixed point; in sums of empty_sums() flux as SumUnits says
    /// @param first  the detector's first bin in the tally
    virtual void on_escape(
        const Vec3& direction,
        std::span<const std::int64_t> amounts,
        std::size_t first,
        Tally& tally) const = 0;
};

}  // namespace quasimc
