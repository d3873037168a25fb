#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/results/json_parts.h"
#include "io/results/series_words.h"
#include "io/results/write_series.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

std::string list_of(const std::vector<std::string>& texts) {
    std::string out = "[";
    for (const std::string& text : texts) {
        out += (out.size() > 1 ? ", " : "") + json_quoted(text);
    }
    return out + "]";
}

/// Units of the sums, by band: of densities and of fluxes.
std::string sum_units(const RunFile& run) {
    std::string out = "{";
    for (const Band& band : run.scene.bands()) {
        const std::string flux = flux_unit(band.unit, run.scene.length_unit());
        out += fmt::format(
            "{}{}: {{\"density\": {}, \"flux\": {}}}", out.size() > 1 ? ", " : "",
            json_quoted(band.name), json_quoted(summed_unit(band.unit).name),
            json_quoted(summed_unit(flux).name));
    }
    return out + "}";
}

/// Where the sun of a moment stands.
std::string sun_of(const MomentNotes& notes) {
    std::string out = ", \"sun\": {\"azimuth_deg\": ";
    append_json(out, notes.sun.azimuth_deg);
    out += ", \"elevation_deg\": ";
    append_json(out, notes.sun.elevation_deg);
    out += ", \"true_elevation_deg\": ";
    append_json(out, notes.sun.true_elevation_deg);
    out += ", \"towards\": [";
    append_json(out, notes.to_sun.x);
    out += ", ";
    append_json(out, notes.to_sun.y);
    out += ", ";
    append_json(out, notes.to_sun.z);
    return out + fmt::format("], \"steps_with_beam\": {}}}", notes.suns);
}

/// The members that tell a moment, open at the end.
std::string moment_head(const MomentNotes& notes) {
    std::string out = fmt::format("{{\"time\": {}, \"seconds\": ", json_quoted(notes.time));
    append_json(out, notes.seconds);
    if (notes.collapsed) {
        const MomentNotes::Collapsed& times = *notes.collapsed;
        out += fmt::format(
            ", \"until\": {}, \"collapsed\": {{\"times\": {}, \"with_daylight\": {}, "
            "\"suns\": {}, \"skies\": {}}}",
            json_quoted(times.until), times.times, times.with_light, notes.suns, times.skies);
    } else {
        out += sun_of(notes);
    }
    out += ", \"daylight_W_m-2\": {\"direct\": ";
    append_json(out, notes.daylight.direct);
    out += ", \"diffuse\": ";
    append_json(out, notes.daylight.diffuse);
    return out + "}";
}

/// The organs of a sum, in a list.
std::string sums_of(const RunFile& run, const SeriesSum& raw) {
    const SeriesSum sum = in_summed_units(run, raw);
    const JsonNames names = json_names(run);
    const std::vector<Organ>& organs = run.scene.organs();
    std::string out = "[\n";
    for (std::size_t i = 0; i < organs.size(); ++i) {
        out += json_organ_sum(organs[i], sum, i, names) + (i + 1 < organs.size() ? ",\n" : "\n");
    }
    return out + "]";
}

}  // namespace

SeriesJson::SeriesJson(const RunFile& run, TextSink sink) : run_(run), sink_(std::move(sink)) {
    sink_("{\n" + json_head(run) + json_warnings(run));
    sink_(fmt::format("\"time\": {},\n", list_of(run.series->words)));
    sink_(fmt::format("\"sum_units\": {},\n\"moments\": [\n", sum_units(run)));
}

void SeriesJson::write_organs(const std::string& text) {
    digest_.add(text);
    sink_(text);
}

void SeriesJson::add_moment(std::size_t time_step, const Result& result, std::size_t traced) {
    const MomentNotes& notes = run_.series->notes[time_step];
    sink_((time_steps_++ > 0 ? ",\n" : "") + moment_head(notes));
    sink_(fmt::format(
        ", \"traced\": {}, \"method\": {}, \"done\": {}, \"audit\": {}, \"energy\": {}, "
        "\"organs\": [\n",
        json_quoted(run_.series->notes[traced].time), json_method(run_, result), json_done(result),
        json_audit(run_, result), json_energy(run_, result)));
    const JsonNames names = json_names(run_);
    const std::vector<Organ>& organs = run_.scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        write_organs(
            json_organ(organs[i], result, i, names) + (i + 1 < organs.size() ? ",\n" : "\n"));
    }
    sink_("]}");
}

void SeriesJson::add_day(std::size_t day, const SeriesSum& sum) {
    days_ += fmt::format(
        "{}{{\"date\": {}, \"seconds\": {}, \"organs\": {}}}", days_.empty() ? "" : ",\n",
        json_quoted(run_.series->days[day]), shortest(sum.seconds), sums_of(run_, sum));
}

std::string SeriesJson::finish(const SeriesSummary& summary) {
    sink_("\n],\n\"days\": [\n" + days_ + "\n],\n");
    sink_(fmt::format(
        "\"total\": {{\"seconds\": {}, \"organs\": {}}},\n", shortest(summary.total.seconds),
        sums_of(run_, summary.total)));
    sink_(fmt::format(
        "\"done\": {{\"moments\": {}, \"traced\": {}, \"rays\": {}, \"audited\": {}, "
        "\"audit_chance\": {}}},\n\"seconds\": {},\n",
        time_steps_, summary.traced, summary.rays, summary.audited, shortest(summary.audit_chance),
        shortest(summary.seconds)));
    std::string digest = digest_.hex();
    sink_(fmt::format("\"organs_sha256\": \"{}\"\n}}\n", digest));
    return digest;
}

}  // namespace quasimc
