#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/numbers.h"
#include "io/runfile/run_file_time.h"

namespace quasimc {
namespace {

/// What an irradiance of this unit counts; nothing for units that daylight has not.
std::optional<SpectralSpan::Count> count_of(std::string_view unit) {
    if (unit == "W m-2") {
        return SpectralSpan::Count::energy;
    }
    if (unit == "umol m-2 s-1") {
        return SpectralSpan::Count::photons;
    }
    return unit == "lx" ? std::optional(SpectralSpan::Count::lumens) : std::nullopt;
}

/// A spectrum of the columns of a file.
struct SpectrumColumns {
    std::vector<double> nm, direct, diffuse;
};

void read_spectrum_row(
    std::string_view line, std::uint32_t number, SpectrumColumns& columns, Reporter& reporter) {
    std::vector<double> values;
    for (const std::string& field : split_fields(line, ',')) {
        values.push_back(parse_real(trimmed(field)).value_or(NAN));
    }
    const bool is_row =
        values.size() == 3 && std::all_of(values.begin(), values.end(), [](double x) {
            return std::isfinite(x) && x >= 0;
        });
    if (!is_row) {
        reporter.fault(
            number, "is no row of a spectrum",
            "a row holds wavelength [nm], direct and diffuse irradiance per nm, 0 or more");
    } else if (!columns.nm.empty() && values[0] <= columns.nm.back()) {
        reporter.fault(number, "the wavelength does not grow", "rows are in ascending order");
    } else {
        columns.nm.push_back(values[0]);
        columns.direct.push_back(values[1]);
        columns.diffuse.push_back(values[2]);
    }
}

/// wavelength_nm,direct,diffuse: a line of names, then rows; '#' begins a comment.
std::optional<DaylightSpectra> read_spectra(TimeContext& context, const std::string& path) {
    Reporter own{path, {}, {}};
    SpectrumColumns columns;
    try {
        const std::string text = context.run->files->read(path);
        LineScanner scanner(text);
        bool has_names = false;
        while (scanner.next() && !own.is_full()) {
            const std::string_view line = trimmed(scanner.line());
            if (line.empty() || line[0] == '#') {
                continue;
            }
            if (!has_names && line != "wavelength_nm,direct,diffuse") {
                own.fault(
                    scanner.number(), "the names are not those of a spectrum",
                    "they are wavelength_nm,direct,diffuse");
                break;
            }
            if (has_names) {
                read_spectrum_row(line, scanner.number(), columns, own);
            }
            has_names = true;
        }
    } catch (const InputError& error) {
        own.faults.add(error);
    }
    if (own.faults.empty() && columns.nm.size() < 2) {
        own.fault(0, "holds no spectrum", "at least two rows are needed");
    }
    if (own.faults.empty()) {
        Spectrum direct(columns.nm, columns.direct);
        Spectrum diffuse(columns.nm, columns.diffuse);
        const SpectralSpan all = span_of(LightUnit::full_spectrum);
        if (direct.within(all) > 0 && diffuse.within(all) > 0) {
            return DaylightSpectra(std::move(direct), std::move(diffuse));
        }
        own.fault(0, "has no light", "direct and diffuse must have some from 280 to 4000 nm");
    }
    context.table->reporter().add(own);
    return std::nullopt;
}

/// The name of a sky of the catalogue.
std::string read_sky_model(TableReader& table, std::string_view key, std::string_view usual) {
    std::vector<std::string_view> names;
    for (const SkyEntry& entry : sky_catalogue()) {
        names.push_back(entry.name);
    }
    return table.choice(key, names).value_or(std::string(usual));
}

}  // namespace

std::vector<SpectralSpan> band_spans(TableReader& table, const std::vector<Band>& bands) {
    std::vector<SpectralSpan> spans;
    for (const Band& band : bands) {
        std::optional<SpectralSpan> span = span_of_band(band.name);
        if (band.to_nm > 0) {
            span = SpectralSpan{band.from_nm, band.to_nm};
        }
        const auto count = count_of(band.unit);
        if (!span) {
            table.fault(
                fmt::format("the wavelengths of band '{}' are not known", band.name),
                "daylight is split by them", "give from_nm and to_nm in its [[band]]");
        } else if (!count) {
            table.fault(
                fmt::format("band '{}' is in {}", band.name, band.unit),
                "daylight is known in W m-2, umol m-2 s-1 and lx");
        } else {
            span->count = *count;
            spans.push_back(*span);
        }
    }
    return spans;
}

DaylightSources read_daylight(TimeContext& context) {
    TableReader& table = *context.table;
    DaylightSources how;
    how.orientation = context.run->orientation;
    how.bands = band_spans(table, context.run->bands);
    how.sky = read_sky_model(table, "sky", how.sky);
    how.overcast_sky = read_sky_model(table, "overcast_sky", how.overcast_sky);
    const bool needs_beam = how.overcast_sky == "preetham";
    if (needs_beam) {
        table.fault_at("overcast_sky", "overcast_sky is 'preetham'", "that is a clear sky");
    }
    const auto type = table.integer("cie_type", {1, 15});
    how.state.cie_type = static_cast<int>(type.value_or(how.state.cie_type));
    how.state.turbidity = table.real("turbidity", {kLowestTurbidity, kHighestTurbidity})
                              .value_or(how.state.turbidity);
    if (const auto path = table.text("spectrum")) {
        how.spectra = read_spectra(context, *path).value_or(how.spectra);
    }
    return how;
}

}  // namespace quasimc
