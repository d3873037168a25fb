#include <type_traits>
#include <utility>

#include <nlohmann/json.hpp>

#include "files/sha256.h"
#include "files/spool.h"
#include "quasimc/result_file.h"
#include "resultio/describe_series.h"
#include "resultio/json_parts.h"
#include "resultio/output_input.h"
#include "results/sensor_transmittance.h"
#include "results/units.h"
#include "runfile/run_file.h"
#include "scene/sensors.h"

namespace quasimc {
namespace {

/// The members before the time steps of a run with [time].
Json series_head(const RunFile& run) {
    Json units = Json::object();  // of the sums
    for (const Band& band : run.scene.bands()) {
        units[band.name] = {
            {"density", summed_unit(band.unit).name},
            {"flux", summed_unit(flux_unit(band.unit, run.scene.length_unit())).name}};
    }
    return {{"time", run.series->words}, {"sum_units", units}};
}

/// The time of a time step, and its sources.
Json time_step_head(const TimeStepNotes& notes) {
    Json head = {{"time", notes.time}, {"seconds", notes.seconds}};
    if (notes.cumulated) {
        head["until"] = notes.cumulated->until;
        head["cumulative_sky"] = {
            {"times", notes.cumulated->times},
            {"with_daylight", notes.cumulated->with_light},
            {"sun_positions", notes.suns},
            {"skies", notes.cumulated->skies}};
    } else {
        head["sun"] = {
            {"azimuth_deg", notes.sun.azimuth_deg},
            {"elevation_deg", notes.sun.elevation_deg},
            {"true_elevation_deg", notes.sun.true_elevation_deg},
            {"towards", json_vector(notes.to_sun)},
            {"steps_with_beam", notes.suns}};
    }
    head["daylight_W_m-2"] = {
        {"direct", notes.daylight.direct}, {"diffuse", notes.daylight.diffuse}};
    return head;
}

/// @param light  a Result or a SeriesSum
template <typename Light>
void write_groups(JsonLines& json, const RunFile& run, const Light& light) {
    const GroupResults& groups = light.groups;
    if (groups.groups.empty()) {
        return;
    }
    std::vector<OriginGroups> origins;
    for (const auto& origin : light.origins) {
        origins.push_back({origin.name, &origin.light.groups});
    }
    const JsonNames names = json_names(run, written_columns(run));
    constexpr CsvTimes kTimes =
        std::is_same_v<Light, SeriesSum> ? CsvTimes::days : CsvTimes::time_steps;
    json.begin('[', "groups");
    for (std::size_t i = 0; i < groups.groups.size(); ++i) {
        json.line(json_group(groups, i, names, origins, kTimes));
    }
    json.end(']');
}

/// The sensors of a result or a sum, if there are any.
/// @param light  a Result or a SeriesSum
template <typename Light>
void write_sensors(JsonLines& json, const RunFile& run, const Light& light) {
    if (light.sensors == nullptr) {
        return;
    }
    const auto& sensors = *light.sensors;
    const SensorTransmittance fraction(run.scene);
    const JsonNames names = json_names(run, written_columns(run));
    const Scene rows = scene_of_sensors(run.scene);
    const std::vector<Vec3> positions = sensor_positions(run.scene);
    json.begin('[', "sensors");
    std::size_t i = 0;
    for (const SensorSet& set : run.scene.sensors()) {
        for (const std::size_t end = i + set.rows(); i < end; ++i) {
            const Vec3 position = run.scene.orientation().outward(positions[i]);
            SensorRow row{rows.organs()[i], position, set.receiver};
            for (std::size_t b = 0; fraction.has(i) && b < sensors.bands; ++b) {
                row.transmittance.push_back(fraction.at(light, i, b));
            }
            json.line(json_sensor(row, sensors, i, names));
        }
    }
    json.end(']');
}

/// The members of a sum, in its object.
void write_sum(JsonLines& json, const RunFile& run, const SeriesSum& raw) {
    const SeriesSum sum = in_summed_units(run, raw);
    const JsonNames names = json_names(run, written_columns(run));
    const std::vector<Organ>& organs = run.scene.organs();
    json.members({{"seconds", sum.seconds}});
    if (!sum.canopy.empty()) {
        std::vector<std::string> units;
        for (const Band& band : run.scene.bands()) {
            units.push_back(summed_unit(flux_unit(band.unit, run.scene.length_unit())).name);
        }
        json.members({{"canopy", json_canopy(run.scene, sum.canopy, units)}});
    }
    write_groups(json, run, sum);
    json.begin('[', "organs");
    for (std::size_t i = 0; i < organs.size(); ++i) {
        json.line(json_organ(organs[i], sum, i, names));
    }
    json.end(']');
    write_sensors(json, run, sum);
}

}  // namespace

/// The state of a JsonWriter.
class JsonWriter::State {
  public:
    State(const RunFile& run, TextSink sink);

    void add_time_step(const TimeStepResult& step);
    void add_day(std::size_t day, const SeriesSum& sum);
    void next_run(const RunFile& run, const SeriesSummary& summary);
    void finish(const SeriesSummary& summary);
    [[nodiscard]] bool writes() const { return writes_; }
    [[nodiscard]] bool has_times() const { return run_->series.has_value(); }
    [[nodiscard]] std::string digest() const { return digest_.hex(); }

  private:
    void begin_series();
    void begin_point();
    void end_point(const SeriesSummary& summary);
    void write_light(const Result& result);
    void write_organs(const Result& result, bool is_shown);
    void write_series_end(const SeriesSummary& summary);

    const RunFile* run_;
    bool writes_;
    JsonLines json_;
    std::unique_ptr<Spool> days_text_;
    std::unique_ptr<JsonLines> days_;
    Sha256 digest_;
    std::size_t points_ = 0;  // completed points of a sweep
    bool is_point_open_ = false;
    StopReason stop_ = StopReason::finished;
};

JsonWriter::State::State(const RunFile& run, TextSink sink)
    : run_(&run), writes_(static_cast<bool>(sink)), json_(std::move(sink)) {
    if (!writes_) {
        return;
    }
    json_.begin('{');
    json_.members(json_head(run));
    json_.members(json_warnings(run));
    if (run.sweep) {
        json_.begin('[', "points");
    } else if (run.series) {
        begin_series();
    }
}

void JsonWriter::State::begin_series() {
    json_.members(series_head(*run_));
    json_.begin('[', "time_steps");
    days_text_ = std::make_unique<Spool>();
    days_ = std::make_unique<JsonLines>([this](std::string_view text) { days_text_->add(text); });
    days_->begin('[');
}

/// A point of a sweep: what it sets, and its lights.
void JsonWriter::State::begin_point() {
    is_point_open_ = true;
    const SweepPoint& point = (*run_->sweep)[run_->point];
    Json values = Json::object();
    for (const SweptValue& value : point.values) {
        values[value.key] = json_value(*value.value);
    }
    json_.begin('{');
    json_.members({{"point", values}, {"sources", point.source_notes}});
    if (run_->series) {
        begin_series();
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
    }
    json_.end('}');
}

void JsonWriter::State::next_run(const RunFile& run, const SeriesSummary& summary) {
    if (writes_) {
        end_point(summary);
    }
    run_ = &run;
}

void JsonWriter::State::write_light(const Result& result) {
    json_.members(json_light(*run_, result));
    write_groups(json_, *run_, result);
    json_.begin('[', "organs");
    write_organs(result, true);
    json_.end(']');
    write_sensors(json_, *run_, result);
}

/// The digest covers all organs, even those that are not written.
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
            json_.line(columns.is_all ? line : json_organ(organs[i], result, i, shown));
        }
    }
}

void JsonWriter::State::add_time_step(const TimeStepResult& step) {
    const auto& [time_step, result, computed] = step;
    if (writes_ && run_->sweep && !is_point_open_) {
        begin_point();
    }
    if (!writes_ || !is_written(*run_, time_step, result)) {
        write_organs(result, false);
        return;
    }
    if (!run_->series) {
        json_.members(
            {{"timing",
              {{"preparation_s", result.preparation_seconds},
               {"solve_s", result.solve_seconds},
               {"solve_cpu_s", result.solve_cpu_seconds}}}});
        write_light(result);
        return;
    }
    json_.begin('{');
    json_.members(time_step_head(run_->series->notes[time_step]));
    json_.members({{"computed", run_->series->notes[computed].time}});
    write_light(result);
    json_.end('}');
}

void JsonWriter::State::add_day(std::size_t day, const SeriesSum& sum) {
    if (!writes_) {
        return;
    }
    days_->begin('{');
    days_->members({{"date", run_->series->days[day]}});
    write_sum(*days_, *run_, sum);
    days_->end('}');
}

void JsonWriter::State::write_series_end(const SeriesSummary& summary) {
    json_.end(']');
    days_->end(']');
    days_->flush();
    json_.line("\"days\": ");
    days_text_->copy_to([this](std::string_view text) { json_.text(text); });
    json_.begin('{', "total");
    write_sum(json_, *run_, summary.total);
    json_.end('}');
    if (!run_->series->outcomes.empty()) {
        json_.members({{"control", json_controls(*run_)}});
    }
    json_.members(
        {{"completed",
          {{"time_steps", summary.completed},
           {"time_steps_requested", run_->series->time_steps.size()},
           {"stop", stop_name(summary.stop)},
           {"with_fewer_paths", summary.with_fewer_paths},
           {"computed", summary.computed},
           {"rays", summary.rays},
           {"audited", summary.audited},
           {"audit_p_value", summary.audit_p_value}}},
         {"timing",
          {{"total_s", summary.seconds},
           {"preparation_s", summary.preparation_seconds},
           {"solve_s", summary.solve_seconds},
           {"solve_cpu_s", summary.solve_cpu_seconds}}}});
}

void JsonWriter::State::finish(const SeriesSummary& summary) {
    if (!writes_) {
        return;
    }
    if (run_->sweep) {
        end_point(summary);
        json_.end(']');
        json_.members(
            {{"completed",
              {{"points", points_},
               {"points_requested", run_->sweep->size()},
               {"stop", stop_name(stop_)}}}});
    } else if (run_->series) {
        write_series_end(summary);
    }
    json_.members({{"organs_sha256", digest()}});
    json_.end('}');
    json_.text("\n");
    json_.flush();
}

JsonWriter::JsonWriter(const RunFile& run, TextSink sink)
    : state_(std::make_unique<State>(run, std::move(sink))) {}
JsonWriter::~JsonWriter() = default;

void JsonWriter::on_time_step(const TimeStepResult& step) {
    state_->add_time_step(step);
}

void JsonWriter::on_day(std::size_t day, const SeriesSum& sum) {
    state_->add_day(day, sum);
}

void JsonWriter::finish(const SeriesSummary& series_summary) {
    state_->finish(series_summary);
}

void JsonWriter::next_run(const RunFile& run, const SeriesSummary& series_summary) {
    state_->next_run(run, series_summary);
}

bool JsonWriter::wants(SeriesPart part) const {
    return part == SeriesPart::time_steps ||
           (part != SeriesPart::sums && state_->writes() && state_->has_times());
}

std::string JsonWriter::digest() const {
    return state_->digest();
}

std::unique_ptr<OutputWriter> make_json(const OutputInput& input) {
    return std::make_unique<JsonWriter>(input.run, input.sink);
}

std::string write_json(const RunFile& run, const Result& result, const TextSink& sink) {
    JsonWriter writer(run, sink);
    writer.on_time_step({0, result});
    writer.finish({});
    return writer.digest();
}

std::string digest_of_organs(const RunFile& run, const Result& result) {
    return write_json(run, result, {});
}

}  // namespace quasimc
