#include "resultio/describe_series.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "base/text.h"
#include "text/line_scanner.h"
#include "text/numbers.h"

namespace quasimc {
namespace {

std::string describe_cumulated(const TimeStepNotes& notes) {
    const TimeStepNotes::Cumulated& times = *notes.cumulated;
    return fmt::format(
        "{} to {}, {} s: {}, {} with daylight, as {} and {}; mean on the "
        "horizontal direct {:.6g}, diffuse {:.6g} W m-2",
        notes.time, times.until, shortest(notes.seconds), counted(times.times, "time step"),
        times.with_light, counted(notes.suns, "sun position"), counted(times.skies, "sky", "skies"),
        notes.daylight.direct, notes.daylight.diffuse);
}

std::string describe_time_step(const TimeStepNotes& notes) {
    if (notes.cumulated) {
        return describe_cumulated(notes);
    }
    std::string text = notes.time;
    text += notes.seconds > 0 ? fmt::format(", {} s", shortest(notes.seconds)) : ", an instant";
    text += fmt::format(
        "; sun azimuth {:.4f} deg, elevation {:.4f} deg, towards ({:.6f}, {:.6f}, {:.6f})",
        notes.sun.azimuth_deg, notes.sun.elevation_deg, without_rounding(notes.to_sun.x),
        without_rounding(notes.to_sun.y), without_rounding(notes.to_sun.z));
    return text + fmt::format(
                      "; on the horizontal direct {:.6g}, diffuse {:.6g} W m-2; {}",
                      notes.daylight.direct, notes.daylight.diffuse,
                      counted(notes.suns, "sun position"));
}

}  // namespace

std::string series_comments(const RunFile& run) {
    std::string out;
    for (const std::string& words : run.series->words) {
        out += "# " + one_line(words) + "\n";
    }
    for (const TimeStepNotes& notes : run.series->notes) {
        out += "# time_step: " + describe_time_step(notes) + "\n";
    }
    return out;
}

std::string describe_quantity(std::string_view name) {
    std::string words(name);
    std::replace(words.begin(), words.end(), '_', ' ');
    return words;
}

SeriesSum in_summed_units(const RunFile& run, SeriesSum sum) {
    return in_summed_units(run.scene.bands(), std::move(sum));
}

SeriesSum in_summed_units(const std::vector<Band>& bands, SeriesSum sum) {
    if (std::exchange(sum.has_file_units, true)) {
        return sum;
    }
    std::vector<double> factors;
    factors.reserve(bands.size());
    for (const Band& band : bands) {
        factors.push_back(summed_unit(band.unit).factor);
    }
    for (OriginSum& origin : sum.origins) {
        origin.light = in_summed_units(bands, std::move(origin.light));
    }
    if (sum.sensors) {
        sum.sensors = std::make_shared<const SeriesSum>(in_summed_units(bands, *sum.sensors));
    }
    for (std::vector<Estimate>* values : {&sum.values, &sum.groups.values}) {
        for (std::size_t i = 0; i < values->size(); ++i) {
            (*values)[i] = scaled((*values)[i], factors[i % factors.size()]);
        }
    }
    for (std::size_t b = 0; b < sum.canopy.size(); ++b) {
        sum.canopy[b].incident *= factors[b];
    }
    for (SunShadeLight* light : {&sum.sun_shade, &sum.groups.sun_shade}) {
        for (std::size_t i = 0; i < light->values.size(); ++i) {
            const auto& entry = sun_shade_table()[i / light->bands % kSunShadeQuantities];
            if (entry.part == SunShadePart::direct) {
                light->values[i] = scaled(light->values[i], factors[i % factors.size()]);
            }
        }
    }
    return sum;
}

std::vector<ControlOutcome> in_summed_units(
    const RunFile& run, std::vector<ControlOutcome> outcomes) {
    return in_summed_units(run.scene.bands(), run.series->controls, std::move(outcomes));
}

std::vector<ControlOutcome> in_summed_units(
    const std::vector<Band>& bands,
    const std::vector<LampControl>& controls,
    std::vector<ControlOutcome> outcomes) {
    for (std::size_t k = 0; k < outcomes.size(); ++k) {
        if (std::exchange(outcomes[k].has_file_units, true)) {
            continue;
        }
        const Band& band = bands[controls[k].band];
        const double factor = summed_unit(band.unit).factor;
        for (ControlDay& day : outcomes[k].days) {
            day.lamps = scaled(day.lamps, factor);
            day.light = scaled(day.light, factor);
        }
    }
    return outcomes;
}

}  // namespace quasimc
