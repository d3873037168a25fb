#include "netcdf/netcdf_writer.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "netcdf/netcdf_axes.h"
#include "netcdf/netcdf_controls.h"
#include "netcdf/netcdf_detectors.h"
#include "netcdf/netcdf_file.h"
#include "netcdf/netcdf_gaps.h"
#include "netcdf/netcdf_organs.h"
#include "netcdf/netcdf_parts.h"
#include "netcdf/netcdf_sensors.h"
#include "quasimc/error.h"
#include "resultio/describe_series.h"
#include "runfile/written.h"

namespace quasimc {

namespace {

class NetcdfLight final : public OutputWriter {
  public:
    NetcdfLight(const RunFile& run, TextSink sink, std::string_view program_version)
        : run_(&run),
          sink_(std::move(sink)),
          axes_(run, file_),
          organ_light_(run, axes_, file_),
          detectors_(run, axes_),
          sensors_(axes_, file_),
          controls_(run, axes_),
          gaps_(run, axes_, file_) {
        file_.add_attributes(netcdf_attributes(run, program_version));
        times_ = times_of(run);
        if (run.sweep) {
            organs_ = run.scene.organs();
        }
    }

    void on_time_step(const TimeStepResult& step) override {
        const Result& result = step.result;
        begin_run();
        std::vector<std::size_t> start = axes_.indices_of(*run_);
        if (!is_written(*run_, step.time_step, result)) {
            return;
        }
        if (run_->series) {
            const auto row = axes_.row_of(step.time_step);
            if (!row) {
                return;
            }
            start.push_back(*row);
        }
        organ_light_.put(start, result);
        detectors_.put(start, result);
        sensors_.put(*run_, start, result);
    }

    void on_day(std::size_t day, const SeriesSum& raw) override {
        begin_run();
        const SeriesSum sum = in_summed_units(*run_, raw);
        std::vector<std::size_t> start = axes_.indices_of(*run_);
        start.push_back(day);
        organ_light_.put_day(start, sum);
        sensors_.put_day(*run_, start, sum);
    }

    [[nodiscard]] bool wants(SeriesPart part) const override {
        return part == SeriesPart::time_steps ||
               (part == SeriesPart::days && run_->series.has_value());
    }

    void next_run(const RunFile& run, const SeriesSummary& /*series_summary*/) override {
        if (times_of(run) != times_) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have different time steps",
                  "a file has one time axis", "sweep something else, or write CSV"}});
        }
        if (!has_same_organs(run)) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have different organs",
                  "a file has one axis of organs with ids, names and labels",
                  "sweep something else, or write CSV"}});
        }
        if (!controls_.fits(run)) {
            throw InputError(
                {{"NetCDF", "the points of the sweep have different controls",
                  "a file has one axis of controls with lamps, sensors and bands",
                  "sweep other keys of controls, or write CSV"}});
        }
        run_ = &run;
        has_begun_ = false;
        organ_light_.put_areas(run);
    }

    void finish(const SeriesSummary& /*series_summary*/) override { file_.copy_to(sink_); }

  private:
    /// Writes what belongs to all times of a run, before the first.
    void begin_run() {
        if (std::exchange(has_begun_, true)) {
            return;
        }
        gaps_.put(*run_);
        if (run_->series) {
            controls_.put(*run_, in_summed_units(*run_, run_->series->outcomes));
        }
    }

    static std::vector<std::string> times_of(const RunFile& run) {
        std::vector<std::string> times;
        for (std::size_t i = 0; run.series && i < run.series->notes.size(); ++i) {
            times.push_back(run.series->notes[i].time);
        }
        return times;
    }

    [[nodiscard]] bool has_same_organs(const RunFile& run) const {
        return std::equal(
            organs_.begin(), organs_.end(), run.scene.organs().begin(), run.scene.organs().end(),
            [](const Organ& a, const Organ& b) {
                return a.id == b.id && a.name == b.name && a.labels == b.labels;
            });
    }

    const RunFile* run_;
    TextSink sink_;
    NetcdfFile file_;
    NetcdfAxes axes_;
    NetcdfOrgans organ_light_;
    NetcdfDetectors detectors_;
    NetcdfSensors sensors_;
    NetcdfControls controls_;
    NetcdfGaps gaps_;
    bool has_begun_ = false;
    std::vector<std::string> times_;  // of the first point, like `organs_`
    std::vector<Organ> organs_;
};

}  // namespace

bool has_netcdf() {
    return true;
}

std::unique_ptr<OutputWriter> make_netcdf_writer(
    const RunFile& run, TextSink sink, std::string_view program_version) {
    return std::make_unique<NetcdfLight>(run, std::move(sink), program_version);
}

}  // namespace quasimc
