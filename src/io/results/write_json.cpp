#include <utility>

#include "io/results/json_parts.h"
#include "io/results/json_stream.h"
#include "io/results/series_words.h"
#include "io/results/spool.h"
#include "io/runfile/run_file.h"
#include "io/runfile/units.h"
#include "io/sha256.h"

namespace quasimc {
namespace {

constexpr JsonLayout kRows = JsonLayout::rows;
constexpr JsonLayout kSpaced = JsonLayout::spaced;

/// Units of the sums, by band: of densities and of fluxes.
void write_sum_units(JsonStream& json, const Scene& scene) {
    json.key("sum_units");
    json.begin_object(kSpaced);
    for (const Band& band : scene.bands()) {
        json.key(band.name);
        json.begin_object(kSpaced);
        json.text("density", summed_unit(band.unit).name);
        json.text("flux", summed_unit(flux_unit(band.unit, scene.length_unit())).name);
        json.end_object();
    }
    json.end_object();
}

/// What precedes the moments of a run with [time].
void write_series_head(JsonStream& json, const RunFile& run) {
    json.key("time");
    json.begin_list(kSpaced);
    for (const std::string& words : run.series->words) {
        json.text(words);
    }
    json.end_list();
    write_sum_units(json, run.scene);
    json.key("moments");
    json.begin_list(kRows);
}

/// Where the sun of a moment stands.
void write_sun(JsonStream& json, const MomentNotes& notes) {
    json.key("sun");
    json.begin_object(kSpaced);
    json.number("azimuth_deg", notes.sun.azimuth_deg);
    json.number("elevation_deg", notes.sun.elevation_deg);
    json.number("true_elevation_deg", notes.sun.true_elevation_deg);
    json.key("towards");
    json.begin_list(kSpaced);
    for (const double x : {notes.to_sun.x, notes.to_sun.y, notes.to_sun.z}) {
        json.number(x);
    }
    json.end_list();
    json.count("steps_with_beam", notes.suns);
    json.end_object();
}

void write_collapsed(JsonStream& json, const MomentNotes& notes) {
    const MomentNotes::Collapsed& times = *notes.collapsed;
    json.text("until", times.until);
    json.key("collapsed");
    json.begin_object(kSpaced);
    json.count("times", times.times);
    json.count("with_daylight", times.with_light);
    json.count("suns", notes.suns);
    json.count("skies", times.skies);
    json.end_object();
}

void write_daylight(JsonStream& json, const Daylight& daylight) {
    json.key("daylight_W_m-2");
    json.begin_object(kSpaced);
    json.number("direct", daylight.direct);
    json.number("diffuse", daylight.diffuse);
    json.end_object();
}

/// The members of a sum, in its object.
void write_sum(JsonStream& json, const RunFile& run, const SeriesSum& raw) {
    const SeriesSum sum = in_summed_units(run, raw);
    const JsonNames names = json_names(run, written_columns(run));
    const std::vector<Organ>& organs = run.scene.organs();
    json.number("seconds", sum.seconds);
    json_groups(json, run, sum.groups);
    json.key("organs");
    json.begin_list(kRows);
    for (std::size_t i = 0; i < organs.size(); ++i) {
        json.raw(json_organ_sum(organs[i], sum, i, names));
    }
    json.end_list();
}

}  // namespace

/// What a JsonWriter writes, and where it stands.
class JsonWriter::State {
  public:
    State(const RunFile& run, TextSink sink);

    void add_moment(std::size_t time_step, const Result& result, std::size_t traced);
    void add_day(std::size_t day, const SeriesSum& sum);
    void next_run(const RunFile& run, const SeriesSummary& summary);
    std::string finish(const SeriesSummary& summary);

  private:
    void begin_point();
    void end_point(const SeriesSummary& summary);
    void write_single_head(const Result& result);
    void write_moment_head(std::size_t time_step, const Result& result, std::size_t traced);
    void write_organs(const Result& result, bool is_shown);
    void write_series_end(const SeriesSummary& summary);

    const RunFile* run_;
    bool writes_;
    JsonStream json_;
    std::unique_ptr<Spool> days_text_ = std::make_unique<Spool>();
    JsonStream days_;
    Sha256 digest_;
    std::size_t time_steps_ = 0;  // of the point
    std::size_t points_ = 0;      // of a sweep, that are done
    bool is_point_open_ = false;
    StopReason stop_ = StopReason::paths_done;
};

JsonWriter::State::State(const RunFile& run, TextSink sink)
    : run_(&run),
      writes_(static_cast<bool>(sink)),
      json_(std::move(sink)),
      days_([this](std::string_view text) { days_text_->add(text); }) {
    if (writes_) {
        json_.begin_object(kRows);
        json_head(json_, run);
    }
    if (writes_ && run.sweep) {
        json_warnings(json_, run);
        json_.key("points");
        json_.begin_list(kRows);
    } else if (writes_ && run.series) {
        json_warnings(json_, run);
        write_series_head(json_, run);
        days_.begin_list(kRows);
    }
}

/// A point of a sweep: what it sets, and its lights.
void JsonWriter::State::begin_point() {
    is_point_open_ = true;
    const SweepPoint& point = (*run_->sweep)[run_->point];
    json_.begin_object(kRows);
    json_.key("point");
    json_.begin_object(kSpaced);
    for (const SweptValue& value : point.values) {
        json_.key(value.key);
        json_value(json_, *value.value, kSpaced);
    }
    json_.end_object();
    json_.key("sources");
    json_.begin_list(kSpaced);
    for (const std::string& note : point.source_notes) {
        json_.text(note);
    }
    json_.end_list();
    if (run_->series) {
        write_series_head(json_, *run_);
        days_.begin_list(kRows);
    }
}

void JsonWriter::State::end_point(const SeriesSummary& summary) {
    stop_ = summary.stop;
    if (!is_point_open_) {
        return;
    }
    is_point_open_ = false;
    ++points_;
    if (run_->series) {
        write_series_end(summary);
        days_text_ = std::make_unique<Spool>();
        time_steps_ = 0;
    }
    json_.end_object();
}

void JsonWriter::State::next_run(const RunFile& run, const SeriesSummary& summary) {
    if (writes_) {
        end_point(summary);
    }
    run_ = &run;
}

void JsonWriter::State::write_single_head(const Result& result) {
    constexpr JsonLayout kPretty = JsonLayout::pretty;
    json_method(json_, *run_, result, kPretty);
    json_done(json_, result, kPretty);
    json_rounds(json_, result, kPretty);
    json_.key("seconds");
    json_.begin_object(kPretty);
    for (const auto& [key, seconds] :
         {std::pair("build", result.build_seconds), std::pair("trace", result.trace_seconds),
          std::pair("trace_cpu", result.trace_cpu_seconds)}) {
        json_.real(key, seconds);
    }
    json_.end_object();
    json_audit(json_, *run_, result, kPretty);
    json_energy(json_, *run_, result, kPretty);
    json_canopy(json_, *run_, result, kPretty);
    json_detectors(json_, *run_, result, kPretty);
    json_groups(json_, *run_, result.groups);
    json_.boolean("escaped_is_remainder", result.escaped_is_remainder);
    if (!run_->sweep) {
        json_warnings(json_, *run_);
    }
}

void JsonWriter::State::write_moment_head(
    std::size_t time_step, const Result& result, std::size_t traced) {
    constexpr JsonLayout kCompact = JsonLayout::compact;
    const MomentNotes& notes = run_->series->notes[time_step];
    json_.text("time", notes.time);
    json_.number("seconds", notes.seconds);
    notes.collapsed ? write_collapsed(json_, notes) : write_sun(json_, notes);
    write_daylight(json_, notes.daylight);
    json_.text("traced", run_->series->notes[traced].time);
    json_method(json_, *run_, result, kCompact);
    json_done(json_, result, kCompact);
    json_rounds(json_, result, kCompact);
    json_audit(json_, *run_, result, kCompact);
    json_energy(json_, *run_, result, kCompact);
    json_canopy(json_, *run_, result, kCompact);
    json_detectors(json_, *run_, result, kCompact);
    json_groups(json_, *run_, result.groups);
}

/// The digest is of everything, whatever of it is written.
void JsonWriter::State::write_organs(const Result& result, bool is_shown) {
    const WrittenColumns columns = written_columns(*run_);
    const JsonNames all = json_names(*run_, all_columns(*run_));
    const JsonNames shown = json_names(*run_, columns);
    const std::vector<Organ>& organs = run_->scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        const std::string line = json_organ(organs[i], result, i, all);
        digest_.add(line);
        digest_.add(i + 1 < organs.size() ? ",\n" : "\n");
        if (is_shown) {
            json_.raw(columns.is_all ? line : json_organ(organs[i], result, i, shown));
        }
    }
}

void JsonWriter::State::add_moment(
    std::size_t time_step, const Result& result, std::size_t traced) {
    ++time_steps_;
    if (writes_ && run_->sweep && !is_point_open_) {
        begin_point();
    }
    if (!writes_ || !is_written(*run_, time_step, result)) {
        write_organs(result, false);
        return;
    }
    if (run_->series) {
        json_.begin_object(kSpaced);
        write_moment_head(time_step, result, traced);
    } else {
        write_single_head(result);
    }
    json_.key("organs");
    json_.begin_list(kRows);
    write_organs(result, true);
    json_.end_list();
    if (run_->series) {
        json_.end_object();
    }
}

void JsonWriter::State::add_day(std::size_t day, const SeriesSum& sum) {
    if (!writes_) {
        return;
    }
    days_.begin_object(kSpaced);
    days_.text("date", run_->series->days[day]);
    write_sum(days_, *run_, sum);
    days_.end_object();
}

void JsonWriter::State::write_series_end(const SeriesSummary& summary) {
    json_.end_list();
    days_.end_list();
    days_.flush();
    json_.key("days");
    json_.raw("");
    days_text_->copy_to([this](std::string_view text) { json_.raw_continued(text); });
    json_.key("total");
    json_.begin_object(kSpaced);
    write_sum(json_, *run_, summary.total);
    json_.end_object();
    json_.key("done");
    json_.begin_object(kSpaced);
    json_.count("moments", time_steps_);
    json_.count("moments_asked", run_->series->time_steps.size());
    json_.text("stop", stop_name(summary.stop));
    json_.count("cut_short", summary.cut_short);
    json_.count("traced", summary.traced);
    json_.count("rays", summary.rays);
    json_.count("audited", summary.audited);
    json_.number("audit_chance", summary.audit_chance);
    json_.end_object();
    json_.number("seconds", summary.seconds);
}

std::string JsonWriter::State::finish(const SeriesSummary& summary) {
    std::string digest = digest_.hex();
    if (writes_) {
        if (run_->sweep) {
            end_point(summary);
            json_.end_list();
            json_.key("done");
            json_.begin_object(kSpaced);
            json_.count("points", points_);
            json_.count("points_asked", run_->sweep->size());
            json_.text("stop", stop_name(stop_));
            json_.end_object();
        } else if (run_->series) {
            write_series_end(summary);
        }
        json_.text("organs_sha256", digest);
        json_.end_object();
        json_.raw_continued("\n");
        json_.flush();
    }
    return digest;
}

JsonWriter::JsonWriter(const RunFile& run, TextSink sink)
    : state_(std::make_unique<State>(run, std::move(sink))) {}
JsonWriter::~JsonWriter() = default;

void JsonWriter::add_moment(std::size_t time_step, const Result& result, std::size_t traced) {
    state_->add_moment(time_step, result, traced);
}

void JsonWriter::add_day(std::size_t day, const SeriesSum& sum) {
    state_->add_day(day, sum);
}

void JsonWriter::next_run(const RunFile& run, const SeriesSummary& summary) {
    state_->next_run(run, summary);
}

std::string JsonWriter::finish(const SeriesSummary& summary) {
    return state_->finish(summary);
}

std::string write_json(const RunFile& run, const Result& result, const TextSink& sink) {
    JsonWriter writer(run, sink);
    writer.add_moment(0, result, 0);
    return writer.finish();
}

std::string digest_of_organs(const RunFile& run, const Result& result) {
    return write_json(run, result, {});
}

}  // namespace quasimc
