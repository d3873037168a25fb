#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "base/surface_side.h"

namespace quasimc {

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

/// What is summed, and in which bin.
///
/// Light that arrives straight from a source is summed per spectrum, not per band: all bands of it
/// follow by multiplication. So a band costs memory and time only where light has been scattered.
///
/// For each region (a part of an organ that is of one material) the bins stand together, because a
/// hit adds to several: direct[side][spectrum], scattered[side][band], sunlit, and where absorbed
/// light is summed absorbed_direct[band] and absorbed_scattered[band]; then those of the run:
/// emitted[spectrum], escaped_direct[spectrum], escaped_scattered[band], scattered_out[band],
/// cut_off[band], rays; then those of detectors.
struct SumLayout {
    std::size_t regions = 0;
    std::size_t spectra = 1;
    std::size_t bands = 1;
    AbsorbedLight absorbed_light = AbsorbedLight::inferred;
    std::vector<DetectorBins> detectors = {};

    [[nodiscard]] std::size_t absorbed_bands() const {
        return absorbed_light == AbsorbedLight::summed ? bands : 0;
    }
    [[nodiscard]] std::size_t stride() const {
        return 2 * spectra + 2 * bands + 1 + 2 * absorbed_bands();
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
    [[nodiscard]] std::size_t emitted() const { return regions * stride(); }
    [[nodiscard]] std::size_t escaped_direct() const { return emitted() + spectra; }
    [[nodiscard]] std::size_t escaped_scattered() const { return escaped_direct() + spectra; }
    [[nodiscard]] std::size_t scattered_out() const { return escaped_scattered() + bands; }
    [[nodiscard]] std::size_t cut_off() const { return scattered_out() + bands; }
    [[nodiscard]] std::size_t rays() const { return cut_off() + bands; }
    /// The first bin of a detector.
    [[nodiscard]] std::size_t detector(std::size_t index) const;
    [[nodiscard]] std::size_t bins() const { return detector(detectors.size()); }

    /// All of it by name: every bin belongs to one block.
    [[nodiscard]] std::vector<SumBlock> blocks() const;

    friend bool operator==(const SumLayout&, const SumLayout&) = default;
};

}  // namespace quasimc
