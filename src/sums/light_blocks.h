#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/mesh.h"
#include "sums/sum_layout.h"
#include "sums/work_unit.h"

namespace quasimc {

/// A pair of blocks holds a quantity of each side of the regions: "NAME_upper" and "NAME_lower".
class SideBlocks {
  public:
    SideBlocks() = default;
    SideBlocks(const SumLayout& layout, std::string_view name);

    [[nodiscard]] bool exists() const { return columns_ > 0; }
    [[nodiscard]] std::size_t columns() const { return columns_; }
    [[nodiscard]] std::size_t bin(
        std::size_t region, SurfaceSide side, std::size_t column = 0) const {
        return first_[index_of(side)] + region * stride_ + column;
    }
    /// The first bin of light from an origin.
    [[nodiscard]] std::size_t of_origin(
        std::size_t origin, std::size_t region, SurfaceSide side) const {
        return bin(region, side, origin * columns_);
    }

  private:
    std::array<std::size_t, 2> first_{};
    std::size_t stride_ = 0, columns_ = 0;
};

/// Declares a pair of blocks.
void declare_sides(
    const std::string& name,
    const SumColumns& columns,
    SumBlocks& blocks,
    std::uint32_t origins = 1);

/// The blocks of scattered light: incident on surfaces, escaped, scattered and cut off.
struct ScatteredBlocks {
    explicit ScatteredBlocks(const SumLayout& layout);

    SideBlocks on_surfaces;
    BlockBins escaped, scattered_out, cut_off;  ///< per band
};

/// The block of the run that counts the contributions of scattered light, where these are not
/// samples.
inline constexpr std::string_view kScatteredCount = "scattered_count";

/// The block of the run that counts its work, with a column for each WorkUnit.
inline constexpr std::string_view kWork = "work";

/// Declares the blocks that every method sums.
///
/// Direct light is summed per spectrum, not per band: all bands of it follow by multiplication. So
/// a band costs memory and time only for scattered light.
/// @param sums_absorbed  whether absorbed light is summed separately, per band. It follows from
/// incident light if no albedo depends on the angle.
/// @param origins  of light: each has its own columns of all that is summed per band. A spectrum
/// has one origin.
/// @param sun_shade  adds the blocks of sunlit and shaded parts: the area whose upper side
/// is sunlit and, with `sums_absorbed`, the absorbed light that came straight from suns
[[nodiscard]] SumBlocks light_blocks(
    std::size_t spectra,
    std::size_t bands,
    bool sums_absorbed = false,
    std::uint32_t origins = 1,
    bool sun_shade = false);

/// A detector's block has a column for each band, for each of its bins.
[[nodiscard]] SumBlock detector_block(
    const std::string& name, std::size_t axis_bins, std::size_t bands, std::uint32_t origins = 1);

/// The handles of light_blocks() and of detectors. Functions give the first bin of a row, or that
/// of a column or of an origin's columns if they have one as parameter.
class LightBlocks {
  public:
    explicit LightBlocks(const SumLayout& layout);

    [[nodiscard]] std::size_t stride() const { return stride_; }
    [[nodiscard]] std::size_t direct(
        std::size_t region, SurfaceSide side, std::size_t spectrum) const {
        return direct_.bin(region, side, spectrum);
    }
    [[nodiscard]] std::size_t scattered(
        std::size_t region, SurfaceSide side, std::size_t origin = 0) const {
        return scattered_.on_surfaces.of_origin(origin, region, side);
    }
    [[nodiscard]] std::size_t sunlit(std::size_t region) const { return sunlit_.bin(region); }
    /// Whether light of sunlit and shaded parts is summed.
    [[nodiscard]] bool has_sun_shade() const { return sunlit_upper_.exists(); }
    /// The part of sunlit() whose upper side is lit.
    [[nodiscard]] std::size_t sunlit_upper(std::size_t region) const {
        return sunlit_upper_.bin(region);
    }
    [[nodiscard]] bool has_absorbed() const { return absorbed_direct_.exists(); }
    /// The part of absorbed_direct() of suns, of all origins; with has_sun_shade().
    [[nodiscard]] std::size_t absorbed_beam(std::size_t region) const {
        return absorbed_beam_.bin(region);
    }
    [[nodiscard]] std::size_t absorbed_direct(std::size_t region, std::size_t origin = 0) const {
        return absorbed_direct_.of_origin(origin, region);
    }
    [[nodiscard]] std::size_t absorbed_scattered(std::size_t region, std::size_t origin = 0) const {
        return absorbed_scattered_.of_origin(origin, region);
    }
    [[nodiscard]] std::size_t emitted() const { return emitted_.first; }
    [[nodiscard]] std::size_t escaped_direct() const { return escaped_direct_.first; }
    [[nodiscard]] std::size_t escaped_scattered(std::size_t origin = 0) const {
        return scattered_.escaped.of_origin(origin);
    }
    [[nodiscard]] std::size_t scattered_out(std::size_t origin = 0) const {
        return scattered_.scattered_out.of_origin(origin);
    }
    [[nodiscard]] std::size_t cut_off(std::size_t origin = 0) const {
        return scattered_.cut_off.of_origin(origin);
    }
    [[nodiscard]] std::size_t work(WorkUnit unit) const {
        return work_.bin(0, static_cast<std::size_t>(unit));
    }
    [[nodiscard]] std::size_t scattered_count() const { return scattered_count_.first; }
    /// The first bin of a detector, in the order of their declaration.
    [[nodiscard]] std::size_t detector(std::size_t index, std::size_t origin = 0) const {
        return detectors_[index].of_origin(origin);
    }

    [[nodiscard]] const ScatteredBlocks& scattered_blocks() const { return scattered_; }

  private:
    std::size_t stride_;
    SideBlocks direct_;
    ScatteredBlocks scattered_;
    BlockBins sunlit_, sunlit_upper_, absorbed_direct_, absorbed_scattered_, absorbed_beam_,
        emitted_, escaped_direct_, work_, scattered_count_;
    std::vector<BlockBins> detectors_;
};

}  // namespace quasimc
