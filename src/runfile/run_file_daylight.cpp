#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "light/daylight/solar_reference.h"
#include "runfile/run_file_spectrum.h"
#include "runfile/run_file_time.h"

namespace quasimc {
namespace {

/// Whether an irradiance of a unit counts energy or photons; empty for units without daylight.
std::optional<SpectralSpan::Count> count_of(std::string_view unit) {
    if (unit == "W m-2") {
        return SpectralSpan::Count::energy;
    }
    if (unit == "umol m-2 s-1") {
        return SpectralSpan::Count::photons;
    }
    return unit == "lx" ? std::optional(SpectralSpan::Count::lumens) : std::nullopt;
}

constexpr SpectrumForm kDaylightForm{
    "wavelength_nm,direct,diffuse",
    "a row contains wavelength [nm], direct and diffuse irradiance per nm, 0 or more",
    [](const std::vector<double>& values) {
        return values.size() == 3 && std::all_of(values.begin(), values.end(), [](double x) {
                   return std::isfinite(x) && x >= 0;
               });
    }};

/// The spectra of the columns, continued beyond their ends.
struct DaylightColumns {
    Spectrum direct, diffuse;
};

/// Fraction of a span's light outside the wavelengths of the rows.
double share_outside(
    const Spectrum& light, const SpectralSpan& span, const std::vector<double>& nm) {
    SpectralSpan inside = span;
    inside.from_nm = std::max(span.from_nm, nm.front());
    inside.to_nm = std::min(span.to_nm, nm.back());
    const double all = light.within(span);
    return all > 0 ? 1 - (inside.from_nm < inside.to_nm ? light.within(inside) : 0) / all : 0;
}

/// Warns of rows that lack a thousandth or more of daylight or of a band.
void warn_of_short_rows(
    const std::vector<double>& nm,
    const DaylightColumns& continued,
    const std::vector<SpectralSpan>& bands,
    Reporter& reporter) {
    const SpectralSpan all = span_of(LightUnit::full_spectrum);
    std::vector<SpectralSpan> spans = bands;
    spans.push_back(all);
    constexpr double kLittle = 1e-3;
    const bool is_short = std::any_of(spans.begin(), spans.end(), [&](const SpectralSpan& span) {
        return share_outside(reference_global(), span, nm) >= kLittle;
    });
    if (is_short) {
        reporter.warn(fmt::format(
            "the rows cover {} to {} nm, daylight {} to {} nm; outside the rows the standard "
            "spectrum (ASTM G173-03) is used, scaled to the rows, and 0 beyond a row of 0: {:.2g} "
            "% of the direct and {:.2g} % of the diffuse light; add rows to replace it",
            shortest(nm.front()), shortest(nm.back()), all.from_nm, all.to_nm,
            100 * share_outside(continued.direct, all, nm),
            100 * share_outside(continued.diffuse, all, nm)));
    }
}

std::optional<DaylightSpectra> read_spectra(
    TimeContext& context, const std::string& path, const std::vector<SpectralSpan>& bands) {
    Reporter own{path, {}, {}};
    SpectrumColumns columns;
    try {
        columns = read_spectrum_columns(context.run->files->read(path), kDaylightForm, own);
    } catch (const InputError& error) {
        own.faults.add(error);
    }
    std::optional<DaylightSpectra> spectra;
    if (own.faults.empty()) {
        const auto& [nm, direct_values, diffuse_values] = columns;
        const Spectrum direct(nm, direct_values);
        const Spectrum diffuse(nm, diffuse_values);
        const SpectralSpan all = span_of(LightUnit::full_spectrum);
        if (direct.within(all) > 0 && diffuse.within(all) > 0) {
            // Under clouds skylight has the spectrum of global light.
            const DaylightColumns whole{
                continued(direct, reference_direct()), continued(diffuse, reference_global())};
            warn_of_short_rows(nm, whole, bands, own);
            spectra = DaylightSpectra(whole.direct, whole.diffuse);
        } else {
            own.fault(
                0, "contains no light",
                "direct and diffuse must be above 0 somewhere from 280 to 4000 nm");
        }
    }
    context.table->reporter().add(own);
    return spectra;
}

/// Warns of bands without daylight.
void warn_of_dark_bands(TimeContext& context, const DaylightSources& how) {
    constexpr Daylight kOne{0.5, 0.5};
    for (std::size_t b = 0; b < how.bands.size() && b < context.run->bands.size(); ++b) {
        const SpectralSpan& band = how.bands[b];
        if (how.spectra.direct(band) <= 0 && how.spectra.diffuse(band, kOne) <= 0) {
            context.table->warn(fmt::format(
                "daylight has no light in band '{}', {} to {} nm", context.run->bands[b].name,
                shortest(band.from_nm), shortest(band.to_nm)));
        }
    }
}

/// The name of a sky of the catalogue.
std::string read_sky_model(TableReader& table, std::string_view key, std::string_view usual) {
    return table.choice(key, names_in(sky_catalogue())).value_or(std::string(usual));
}

}  // namespace

std::vector<SpectralSpan> band_spans(TableReader& table, const std::vector<Band>& bands) {
    std::vector<SpectralSpan> spans;
    for (const Band& band : bands) {
        std::optional<SpectralSpan> span = span_of_band(band.name, band.from_nm, band.to_nm);
        const auto count = count_of(band.unit);
        if (!span) {
            table.fault(
                fmt::format("the wavelengths of band '{}' are unknown", band.name),
                "they are needed to divide daylight among bands", "give its from_nm and to_nm");
        } else if (!count) {
            table.fault(
                fmt::format("band '{}' is in {}", band.name, band.unit),
                "daylight is available in W m-2, umol m-2 s-1 and lx");
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
        how.spectra = read_spectra(context, *path, how.bands).value_or(how.spectra);
    }
    warn_of_dark_bands(context, how);
    return how;
}

}  // namespace quasimc
