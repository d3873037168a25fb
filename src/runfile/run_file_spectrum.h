#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runfile/run_file_sections.h"
#include "text/table_reader.h"

namespace quasimc {

/// Wavelengths [nm], in ascending order, and two values at each.
using SpectrumColumns = std::array<std::vector<double>, 3>;

/// What a file of such columns holds.
struct SpectrumForm {
    std::string_view names;  ///< with which its line of names begins
    std::string_view row;    ///< what a row holds, for messages
    bool (*is_row)(const std::vector<double>& values);
};

/// Reads a line of names, then rows of which the last value may be left out; '#' begins a comment.
[[nodiscard]] SpectrumColumns read_spectrum_columns(
    std::string_view text, const SpectrumForm& form, Reporter& reporter);

/// What a surface reflects and transmits at some wavelengths, in ascending order; linear between.
struct SurfaceSpectrum {
    std::vector<double> nm, reflectance, transmittance;
};

/// Where a spectrum is from, for messages, and what it is weighed by.
struct SpectrumUse {
    std::string_view key;  ///< of the material, that asks for it
    std::string source;    ///< the file or model
    /// `spectrum_light` of the material: global (usual), direct or flat.
    std::optional<std::string> light;
};

/// The means of a spectrum over each band, weighed by the light. Nothing after a fault: a band
/// whose wavelengths are not known, or not those of the spectrum.
[[nodiscard]] std::optional<SpectralOptics> optics_of_bands(
    TableReader& table,
    const RunFileContext& context,
    const SurfaceSpectrum& columns,
    const SpectrumUse& use);

}  // namespace quasimc
