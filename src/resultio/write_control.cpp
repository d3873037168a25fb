// The table of lamps under control: docs/reference/csv.md.

#include "resultio/write_control.h"

#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "resultio/csv_parts.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"

namespace quasimc {
namespace {

/// Writes a row for each control and time, or day, once a run has ended.
class ControlTable final : public OutputWriter {
  public:
    explicit ControlTable(const OutputInput& input)
        : run_(&input.run), sink_(input.sink), times_(input.table->times) {}

    void next_run(const RunFile& run, const SeriesSummary& /*series_summary*/) override {
        write_run();
        run_ = &run;
    }
    void finish(const SeriesSummary& /*series_summary*/) override { write_run(); }
    [[nodiscard]] bool wants(SeriesPart /*part*/) const override { return false; }

  private:
    [[nodiscard]] bool is_daily() const { return times_ == CsvTimes::days; }

    void write_run() {
        if (!std::exchange(has_head_, true)) {
            write_head();
        }
        const auto outcomes = in_summed_units(*run_, run_->series->outcomes);
        std::string out;
        for (std::size_t k = 0; k < outcomes.size(); ++k) {
            is_daily() ? append_days(k, outcomes[k], out) : append_steps(k, outcomes[k], out);
        }
        sink_(out);
    }

    void write_head() const {
        std::vector<std::string> names = csv_point_names(*run_);
        for (std::string& name : names) {
            name = csv_field(name);
        }
        const std::string shared =
            "# column control: pattern of its lamps\n# column kwh: electrical energy\n"
            "# column lamps: light of its lamps at the sensors; column light: all light there\n"
            "# column ..._se: standard error\n";
        const char* own =
            is_daily()
                ? "# column hours_on: hours in which the lamps are on, dimmed or not\n"
                  "# column hours_near_threshold: hours in which daylight is within two standard "
                  "errors of on_below\n"
                : "# column factor: on the light of the lamps, mean over the time\n"
                  "# column on: part of the time in which they are on, dimmed or not\n"
                  "# column daylight: daylight at the sensors\n";
        names.emplace_back(
            is_daily() ? "date,control,hours_on,kwh,hours_near_threshold,band,unit,lamps,lamps_se,"
                         "light,light_se"
                       : "time,control,factor,on,kwh,band,unit,daylight,daylight_se,lamps,lamps_se,"
                         "light,light_se");
        sink_(
            csv_origin(*run_, "table of lamps under control") + csv_point_columns(*run_) + shared +
            own + fmt::format("{}\n", fmt::join(names, ",")));
    }

    [[nodiscard]] const Band& band_of(std::size_t k) const {
        return run_->scene.bands()[run_->series->controls[k].band];
    }

    static void append(std::string& out, const Estimate& estimate) {
        const Estimate e = reported(estimate);
        append_csv(out, e.mean);
        append_csv(out, e.standard_error);
    }

    void append_steps(std::size_t k, const ControlOutcome& outcome, std::string& out) const {
        const TimeSeries& series = *run_->series;
        const std::string control = csv_field(series.controls[k].sources);
        for (std::size_t i = 0; i < series.time_steps.size(); ++i) {
            const ControlStep& step = outcome.steps[i];
            out += csv_point_fields(*run_) + series.notes[i].time + "," + control;
            for (const double number : {step.factor, step.on, step.kwh}) {
                append_csv(out, number);
            }
            out += "," + csv_field(band_of(k).name) + "," + csv_field(band_of(k).unit);
            append(out, step.daylight);
            append(out, step.lamps);
            append(out, step.light);
            out += '\n';
        }
    }

    void append_days(std::size_t k, const ControlOutcome& outcome, std::string& out) const {
        const TimeSeries& series = *run_->series;
        const std::string unit = summed_unit(band_of(k).unit).name;
        for (std::size_t i = 0; i < series.days.size(); ++i) {
            const ControlDay& day = outcome.days[i];
            out += csv_point_fields(*run_) + series.days[i] + "," +
                   csv_field(series.controls[k].sources);
            for (const double number : {day.hours_on, day.kwh, day.hours_near_threshold}) {
                append_csv(out, number);
            }
            out += "," + csv_field(band_of(k).name) + "," + csv_field(unit);
            append(out, day.lamps);
            append(out, day.light);
            out += '\n';
        }
    }

    const RunFile* run_;
    TextSink sink_;
    CsvTimes times_;
    bool has_head_ = false;
};

}  // namespace

std::unique_ptr<OutputWriter> make_control_table(const OutputInput& input) {
    return std::make_unique<ControlTable>(input);
}

}  // namespace quasimc
