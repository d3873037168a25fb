#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/runfile/run_file_sections.h"
#include "io/runfile/table_reader.h"

namespace quasimc {

/// What a surface reflects and transmits at some wavelengths, in ascending order; linear between.
struct SurfaceSpectrum {
    std::vector<double> nm, reflectance, transmittance;
};

/// Where a spectrum is from, for messages, and what it is weighed by.
struct SpectrumUse {
    std::string_view key;  ///< of the material, that asks for it
    std::string source;    ///< the file or model
    std::optional<std::string>
        light;  ///< `spectrum_light` of the material: global (usual), direct or flat
};

/// The means of a spectrum over each band, weighed by the light. Nothing after a fault: a band
/// whose wavelengths are not known, or not those of the spectrum.
[[nodiscard]] std::optional<SpectralOptics> optics_of_bands(
    TableReader& table,
    const RunFileContext& context,
    const SurfaceSpectrum& columns,
    const SpectrumUse& use);

}  // namespace quasimc
