#include "io/runfile/run_file_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/numbers.h"
#include "io/runfile/row_faults.h"
#include "io/runfile/run_file_sections.h"
#include "io/runfile/run_file_time.h"
#include "sources/band_mean.h"
#include "sources/solar_reference.h"

namespace quasimc {
namespace {

void read_optics_row(
    std::string_view line, std::uint32_t number, SurfaceSpectrum& columns, RowFaults& faults) {
    std::vector<double> values;
    for (const std::string& field : split_fields(line, ',')) {
        values.push_back(parse_real(trimmed(field)).value_or(NAN));
    }
    if (values.size() == 2) {
        values.push_back(0);
    }
    const bool is_row = values.size() == 3 && std::isfinite(values[0]) && values[0] > 0 &&
                        values[1] >= 0 && values[2] >= 0 && values[1] + values[2] <= 1;
    if (!is_row) {
        faults.add(
            number, "is no row of a surface's spectrum",
            "a row holds wavelength [nm], reflectance and, if there is any, transmittance, "
            "together "
            "at most 1");
    } else if (!columns.nm.empty() && values[0] <= columns.nm.back()) {
        faults.add(number, "the wavelength does not grow", "rows are in ascending order");
    } else {
        columns.nm.push_back(values[0]);
        columns.reflectance.push_back(values[1]);
        columns.transmittance.push_back(values[2]);
    }
}

/// A line of names, then rows; '#' begins a comment.
SurfaceSpectrum read_optics_columns(std::string_view bytes, Reporter& reporter) {
    SurfaceSpectrum columns;
    RowFaults faults;
    LineScanner scanner(bytes);
    bool has_names = false;
    while (scanner.next()) {
        const std::string_view line = trimmed(scanner.line().substr(0, scanner.line().find('#')));
        if (line.empty()) {
            continue;
        }
        if (!has_names) {
            has_names = true;
            if (!line.starts_with("wavelength_nm,reflectance")) {
                reporter.fault(
                    scanner.number(), "the names of the columns are missing", "",
                    "begin with wavelength_nm,reflectance,transmittance");
            }
            continue;
        }
        read_optics_row(line, scanner.number(), columns, faults);
    }
    faults.report(reporter);
    if (columns.nm.size() < 2 && reporter.faults.empty()) {
        reporter.faults.add({reporter.file, "has less than two wavelengths", "", ""});
    }
    return columns;
}

/// What is weighed by: daylight, its beam, or every wavelength alike.
const Spectrum& light_of(const std::optional<std::string>& name, const Spectrum& flat) {
    if (name == "flat") {
        return flat;
    }
    return name == "direct" ? reference_direct() : reference_global();
}

}  // namespace

std::optional<SpectralOptics> optics_of_bands(
    TableReader& table,
    const RunFileContext& context,
    const SurfaceSpectrum& columns,
    const SpectrumUse& use) {
    const std::vector<SpectralSpan> spans = band_spans(table, context.bands);
    if (table.failed()) {
        return std::nullopt;
    }
    const Spectrum flat({columns.nm.front(), columns.nm.back()}, {1, 1});
    const Spectrum& light = light_of(use.light, flat);
    const Spectrum reflectance(columns.nm, columns.reflectance);
    const Spectrum transmittance(columns.nm, columns.transmittance);
    SpectralOptics optics;
    for (std::size_t b = 0; b < spans.size(); ++b) {
        if (spans[b].from_nm < columns.nm.front() || spans[b].to_nm > columns.nm.back()) {
            table.fault_at(
                use.key,
                fmt::format(
                    "'{}' has {} to {} nm, band '{}' {} to {} nm", use.source, columns.nm.front(),
                    columns.nm.back(), context.bands[b].name, spans[b].from_nm, spans[b].to_nm),
                "what is not measured is not made up");
            return std::nullopt;
        }
        optics.reflectance.push_back(band_mean(reflectance, light, spans[b]));
        optics.transmittance.push_back(band_mean(transmittance, light, spans[b]));
    }
    return optics;
}

std::optional<SpectralOptics> read_spectral_optics(
    TableReader& table, const RunFileContext& context) {
    constexpr std::array<std::string_view, 3> kLights{"global", "direct", "flat"};
    const std::optional<std::string> file = table.text("spectrum");
    const std::optional<std::string> light_name = table.choice("spectrum_light", kLights);
    if (!file) {
        return std::nullopt;
    }
    Reporter own{*file, {}, {}};
    SurfaceSpectrum columns;
    try {
        columns = read_optics_columns(context.files->read(*file), own);
    } catch (const InputError& error) {
        table.fault_at(
            "spectrum", fmt::format("file '{}' can't be read", *file), error.faults().front().why);
        return std::nullopt;
    }
    table.reporter().add(own);
    return optics_of_bands(table, context, columns, {"spectrum", *file, light_name});
}

}  // namespace quasimc
