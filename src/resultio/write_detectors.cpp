// The table of detectors: docs/reference/detectors.md.

#include <string>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "resultio/csv_parts.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"
#include "results/units.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

/// Writes a row for each detector, bin and band at each time.
class DetectorTable final : public OutputWriter {
  public:
    explicit DetectorTable(const OutputInput& input) : run_(&input.run), sink_(input.sink) {}

    void next_run(const RunFile& run, const SeriesSummary& /*series_summary*/) override {
        run_ = &run;
    }

    void on_time_step(const TimeStepResult& step) override {
        if (!std::exchange(has_head_, true)) {
            write_head(step.result);
        }
        if (!is_written(*run_, step.time_step, step.result)) {
            return;
        }
        const std::string first =
            csv_point_fields(*run_) +
            (run_->series ? run_->series->notes[step.time_step].time + "," : "");
        for (const DetectorResult& detector : step.result.detectors) {
            write_rows(first, detector);
        }
    }

  private:
    /// @param result  first time step
    void write_head(const Result& result) {
        const RunFile& run = *run_;
        std::vector<std::string> names = csv_point_names(run);
        std::string out = csv_origin(run, "table of detectors");
        out += (run.series ? series_comments(run) : csv_result_comments(run, result)) +
               csv_point_columns(run);
        for (const DetectorResult& detector : result.detectors) {
            out += fmt::format(
                "# detector {}: {}, bins of {}\n", one_line(detector.name), detector.type,
                detector.quantity);
        }
        if (run.series) {
            names.emplace_back("time");
            out += "# column time: beginning of the time step; values are means over it\n";
        }
        out +=
            "# column mean: flux in the bin\n# column standard_error: of the mean; empty where it "
            "is unknown (no light sampled)\n# column ci95_low, ci95_high: ends of the 95 % "
            "confidence interval\n";
        for (std::string& name : names) {
            name = csv_field(name);
        }
        names.emplace_back("detector,bin,band,unit,mean,standard_error,ci95_low,ci95_high");
        sink_(out + fmt::format("{}\n", fmt::join(names, ",")));
    }

    /// @param first  beginning of each row
    void write_rows(const std::string& first, const DetectorResult& detector) const {
        const std::vector<std::size_t> bands = written_columns(*run_).bands;
        std::string out;
        for (std::size_t i = 0; i < detector.bins.size() * bands.size(); ++i) {
            const std::size_t bin = i / bands.size(), b = bands[i % bands.size()];
            const Band& band = run_->scene.bands()[b];
            out += fmt::format(
                "{}{},{},{},{}", first, csv_field(detector.name), csv_field(detector.bins[bin]),
                csv_field(band.name), csv_field(flux_unit(band.unit, run_->scene.length_unit())));
            const Estimate e = reported(detector.at(bin, b));
            for (const double x : {e.mean, e.standard_error, e.ci95_low, e.ci95_high}) {
                append_csv(out, x);
            }
            out += '\n';
        }
        sink_(out);
    }

    const RunFile* run_;
    TextSink sink_;
    bool has_head_ = false;
};

}  // namespace

std::unique_ptr<OutputWriter> make_detectors(const OutputInput& input) {
    return std::make_unique<DetectorTable>(input);
}

}  // namespace quasimc
