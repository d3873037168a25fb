#include "runfile/run_file_spectrum.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "light/daylight/band_mean.h"
#include "light/daylight/solar_reference.h"
#include "runfile/run_file_sections.h"
#include "runfile/run_file_time.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

/// Collects the faults of a table's rows and reports each kind once.
class RowFaults {
  public:
    explicit RowFaults(Reporter& reporter) : reporter_(reporter) {}

    /// @param problem, why  identify the kind, and must outlive the object
    void add(std::uint32_t line, std::string_view problem, std::string_view why) {
        const auto known = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& kind) {
            return kind.problem == problem;
        });
        if (known != kinds_.end()) {
            ++known->more;
        } else {
            kinds_.push_back({problem, why, line});
        }
    }
    void report() const {
        for (const Kind& kind : kinds_) {
            reporter_.fault(
                kind.first, std::string(kind.problem), std::string(kind.why),
                kind.more > 0 ? counted(kind.more, "more row") + " with this error" : "");
        }
    }

  private:
    struct Kind {
        std::string_view problem, why;
        std::uint32_t first = 0;
        std::size_t more = 0;  // rows
    };
    Reporter& reporter_;
    std::vector<Kind> kinds_;
};

constexpr SpectrumForm kOpticsForm{
    "wavelength_nm,reflectance",
    "a row contains wavelength [nm], reflectance and optionally transmittance; their sum is at "
    "most 1",
    [](const std::vector<double>& v) {
        const double transmittance = v.size() == 3 ? v[2] : 0;
        return (v.size() == 2 || v.size() == 3) && std::isfinite(v[0]) && v[0] > 0 && v[1] >= 0 &&
               transmittance >= 0 && v[1] + transmittance <= 1;
    }};

/// The weights of wavelengths: daylight, its beam, or constant.
const Spectrum& light_of(const std::optional<std::string>& name, const Spectrum& flat) {
    if (name == "flat") {
        return flat;
    }
    return name == "direct" ? reference_direct() : reference_global();
}

}  // namespace

SpectrumColumns read_spectrum_columns(
    std::string_view text, const SpectrumForm& form, Reporter& reporter) {
    SpectrumColumns columns;
    RowFaults faults(reporter);
    LineScanner scanner(text);
    bool has_names = false;
    while (scanner.next()) {
        const std::string_view line = trimmed(scanner.line().substr(0, scanner.line().find('#')));
        if (line.empty()) {
            continue;
        }
        if (!has_names) {
            has_names = true;
            if (!line.starts_with(form.names)) {
                reporter.fault(
                    scanner.number(), "the names of the columns are missing", "",
                    fmt::format("begin with {}", form.names));
                break;
            }
            continue;
        }
        std::vector<double> values;
        for (const std::string& field : split_fields(line, ',')) {
            values.push_back(parse_real(trimmed(field)).value_or(NAN));
        }
        if (!form.is_row(values)) {
            faults.add(scanner.number(), "is not a row of a spectrum", form.row);
        } else if (!columns[0].empty() && values[0] <= columns[0].back()) {
            faults.add(
                scanner.number(), "the wavelength does not increase",
                "rows must be in ascending order");
        } else {
            values.resize(columns.size());
            for (std::size_t i = 0; i < columns.size(); ++i) {
                columns[i].push_back(values[i]);
            }
        }
    }
    faults.report();
    if (reporter.faults.empty() && columns[0].size() < 2) {
        reporter.fault(0, "contains no spectrum", "at least two rows are needed");
    }
    return columns;
}

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
                    "'{}' covers {} to {} nm, band '{}' {} to {} nm", use.source,
                    columns.nm.front(), columns.nm.back(), context.bands[b].name, spans[b].from_nm,
                    spans[b].to_nm),
                "spectra are not extrapolated");
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
    SurfaceSpectrum spectrum;
    try {
        auto [nm, reflectance, transmittance] =
            read_spectrum_columns(context.files->read(*file), kOpticsForm, own);
        spectrum = {std::move(nm), std::move(reflectance), std::move(transmittance)};
    } catch (const InputError& error) {
        table.fault_at(
            "spectrum", fmt::format("file '{}' can't be read", *file), error.faults().front().why);
        return std::nullopt;
    }
    table.reporter().add(own);
    return optics_of_bands(table, context, spectrum, {"spectrum", *file, light_name});
}

}  // namespace quasimc
