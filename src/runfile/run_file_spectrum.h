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

/// Format of a file with such columns.
struct SpectrumForm {
    std::string_view names;  ///< start of the line of names
    std::string_view row;    ///< content of a row, for messages
    bool (*is_row)(const std::vector<double>& values);
};

/// Reads a line of names, then rows whose last value is optional; '#' begins a comment.
[[nodiscard]] SpectrumColumns read_spectrum_columns(
    std::string_view text, const SpectrumForm& form, Reporter& reporter);

/// Reflectance and transmittance at wavelengths in ascending order; linear between.
struct SurfaceSpectrum {
    std::vector<double> nm, reflectance, transmittance;
};

/// Origin of a spectrum, for messages, and its weights.
struct SpectrumUse {
    std::string_view key;  ///< key of the material
    std::string source;    ///< the file or model
    /// `spectrum_light` of the material: global (usual), direct or flat.
    std::optional<std::string> light;
};

/// Means of a spectrum over each band, weighted by the light. Empty after a fault: the wavelengths
/// of a band are unknown, or outside the spectrum.
[[nodiscard]] std::optional<SpectralOptics> optics_of_bands(
    TableReader& table,
    const RunFileContext& context,
    const SurfaceSpectrum& columns,
    const SpectrumUse& use);

}  // namespace quasimc
