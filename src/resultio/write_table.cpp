// The tables of [[table]]: docs/reference/csv.md.

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "resultio/csv_parts.h"
#include "resultio/describe_result.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"
#include "resultio/sweep_sum.h"
#include "resultio/table_columns.h"
#include "resultio/write_control.h"
#include "runfile/table_rows.h"
#include "scene/sensors.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::size_t kTablePiece = 1 << 16;

/// A statistic of estimates: its column in narrow tables, and the end of those in wide ones.
struct StatisticRow {
    CsvStatistic statistic;
    std::string_view narrow, suffix, summary;
};
constexpr std::array kStatistics{
    StatisticRow{CsvStatistic::mean, "value", "", "the estimate"},
    StatisticRow{
        CsvStatistic::standard_error, "se", "_se",
        "standard error; empty where it is unknown (no light sampled)"},
    StatisticRow{
        CsvStatistic::ci95_low, "ci95_low", "_ci95_low",
        "lower end of the 95 % confidence interval"},
    StatisticRow{
        CsvStatistic::ci95_high, "ci95_high", "_ci95_high",
        "upper end of the 95 % confidence interval; an upper limit where no light was sampled"}};

const StatisticRow& row_of(CsvStatistic statistic) {
    return *std::find_if(kStatistics.begin(), kStatistics.end(), [&](const StatisticRow& row) {
        return row.statistic == statistic;
    });
}

double part_of(const Estimate& e, CsvStatistic statistic) {
    switch (statistic) {
        case CsvStatistic::mean:
            return e.mean;
        case CsvStatistic::standard_error:
            return e.standard_error;
        case CsvStatistic::ci95_low:
            return e.ci95_low;
        case CsvStatistic::ci95_high:
            return e.ci95_high;
    }
    return e.mean;
}

/// Writes a table of organs, groups or sensors.
class TableWriter final : public OutputWriter {
  public:
    TableWriter(const RunFile& run, const TableSpec& table, TextSink sink)
        : run_(&run), table_(table), sink_(std::move(sink)) {
        begin_run();
        labels_ = is_of_groups() ? group_keys(run) : label_columns(scene());
        if (table_.times == CsvTimes::sweep) {
            sweep_.emplace(run, table_);
        }
        if (is_summed(table_.times)) {
            write_head(nullptr);
        }
    }

    void next_run(const RunFile& run, const SeriesSummary& series_summary) override {
        finish(series_summary);
        run_ = &run;
        begin_run();
        if (sweep_) {
            sweep_->begin_point(run);
        }
    }
    [[nodiscard]] bool wants(SeriesPart part) const override {
        if (sweep_) {
            return part == SeriesPart::sums || part == SeriesPart::time_steps;
        }
        return part == (table_.times == CsvTimes::days     ? SeriesPart::days
                        : table_.times == CsvTimes::period ? SeriesPart::total
                                                           : SeriesPart::time_steps);
    }

    void on_time_step(const TimeStepResult& step) override {
        const bool has_rows = !is_of_sensors() || step.result.sensors != nullptr;
        lacks_sensors_ = lacks_sensors_ || !has_rows;
        if (is_summed(table_.times)) {
            return;
        }
        if (!std::exchange(has_head_, true)) {
            write_head(&step.result);
        }
        if (!has_rows || !is_written(*run_, step.time_step, step.result)) {
            return;
        }
        const std::string time = run_->series ? run_->series->notes[step.time_step].time + "," : "";
        write_rows(csv_point_fields(*run_) + time, {&step.result, nullptr}, step.result.groups);
    }

    void on_day(std::size_t day, const SeriesSum& sum) override {
        if (table_.times == CsvTimes::days) {
            write_sum(run_->series->days[day], sum);
        }
    }

    void on_sums(const SeriesSums& sums) override { sweep_->add(sums); }

    /// Writes the sum over a period or a sweep, unless some of its time steps are missing.
    void finish(const SeriesSummary& series_summary) override {
        if (sweep_) {
            finish_point(series_summary);
            return;
        }
        if (table_.times == CsvTimes::period &&
            series_summary.completed == run_->series->time_steps.size()) {
            const std::vector<std::string>& days = run_->series->days;
            write_sum(
                days.size() == 1 ? days.front() : days.front() + "/" + days.back(),
                series_summary.total);
        }
    }

  private:
    void finish_point(const SeriesSummary& series_summary) {
        sweep_->end_point(is_complete(*run_, series_summary) && !lacks_sensors_);
        if (!sweep_->is_complete()) {
            return;
        }
        const SeriesSum sum = sweep_->sum();
        write_rows(run_->series ? shortest(sum.seconds) + "," : "", {nullptr, &sum}, sum.groups);
    }

    void write_sum(const std::string& date, const SeriesSum& raw) {
        if (is_of_sensors() && !raw.sensors) {
            return;
        }
        const SeriesSum sum = in_summed_units(*run_, raw);
        const std::string first =
            fmt::format("{}{},{},", csv_point_fields(*run_), date, shortest(sum.seconds));
        write_rows(first, {nullptr, &sum}, sum.groups);
    }

    [[nodiscard]] bool is_of_groups() const { return table_.rows == CsvRows::groups; }
    [[nodiscard]] bool is_of_sensors() const { return table_.rows == CsvRows::sensors; }
    /// The scene whose organs are the rows of a table of organs or sensors.
    [[nodiscard]] const Scene& scene() const { return sensors_ ? *sensors_ : run_->scene; }
    [[nodiscard]] bool has_origins() const {
        return std::ranges::any_of(
            columns_, [](const TableColumn& column) { return !column.origin.empty(); });
    }
    [[nodiscard]] bool is_narrow() const { return table_.form == CsvForm::narrow; }

    /// Sets what depends on the point of a sweep.
    void begin_run() {
        if (is_of_sensors()) {
            sensors_ = scene_of_sensors(run_->scene);
            positions_ = sensor_positions(run_->scene);
        }
        columns_ = is_of_sensors() ? sensor_columns(*run_, table_) : table_columns(*run_, table_);
        rows_ = TableRows(*run_, table_);
    }

    /// @param result  first time step; null in a table of sums
    void write_head(const Result* result) {
        const RunFile& run = *run_;
        FirstColumns first = first_columns(result == nullptr);
        const bool is_single = result != nullptr && !run.series;
        sink_(
            csv_origin(
                run, is_of_groups()    ? "table of groups"
                     : is_of_sensors() ? "table of sensors"
                                       : "table of organs") +
            (run.series ? series_comments(run) : "") + (is_single ? result_comments(*result) : ""));
        sink_(first.comments + comments());
        add_names(first.names);
        sink_(fmt::format("{}\n", fmt::join(first.names, ",")));
    }

    /// @param result  the only one
    [[nodiscard]] std::string result_comments(const Result& result) const {
        if (!is_of_sensors()) {
            return csv_result_comments(*run_, result);
        }
        return result.sensors
                   ? csv_result_comments(*run_, *result.sensors)
                   : fmt::format(
                         "# sensors: {}\n", describe_missing_sensors(run_->spec, result.stop));
    }

    /// The columns before those of rows, and their comments.
    struct FirstColumns {
        std::vector<std::string> names;
        std::string comments;
    };
    [[nodiscard]] FirstColumns first_columns(bool is_of_sums) const {
        if (sweep_) {
            return {
                run_->series ? std::vector<std::string>{"seconds"} : std::vector<std::string>(),
                sweep_comments(*run_)};
        }
        FirstColumns first{csv_point_names(*run_), csv_point_columns(*run_)};
        if (is_of_sums) {
            first.comments +=
                "# column date: day of the sum, or first and last day\n# column seconds: duration "
                "of the time steps that were summed\n";
            first.names.insert(first.names.end(), {"date", "seconds"});
        } else if (run_->series) {
            first.comments +=
                "# column time: beginning of the time step; values are means over it\n";
            first.names.emplace_back("time");
        }
        return first;
    }

    [[nodiscard]] std::string comments() const {
        std::string out;
        if (!table_.where.empty()) {
            out += "# where: " + one_line(table_.where) + "\n";
        }
        for (const TableColumn& column : columns_) {
            if (is_narrow() && !column.origin.empty()) {
                continue;  // it is described with all light
            }
            const std::string name =
                is_narrow() && !column.band.empty()
                    ? fmt::format("quantity {} in {}", column.quantity, column.band)
                : is_narrow() ? "quantity " + column.quantity
                              : "column " + column.name();
            out += "# " + one_line(fmt::format("{} [{}]: {}", name, column.unit, column.summary)) +
                   "\n";
        }
        if (is_narrow() && has_origins()) {
            out += "# column origin: origin of the light; all: light of all origins\n";
        }
        for (const CsvStatistic statistic : table_.statistics) {
            const StatisticRow& row = row_of(statistic);
            if (is_narrow() || !row.suffix.empty()) {
                out += fmt::format(
                    "# column {}{}: {}\n", is_narrow() ? "" : "...",
                    is_narrow() ? row.narrow : row.suffix, row.summary);
            }
        }
        return out;
    }

    /// Adds the names of the columns after those of point and time.
    void add_names(std::vector<std::string>& names) const {
        std::vector<std::string> own{"id", "name"};
        if (is_of_groups()) {
            own = {"by", "value_of", "organs"};
        }
        if (is_of_sensors()) {
            own.insert(own.end(), {"x", "y", "z"});
        } else {
            own.emplace_back("area");
        }
        std::vector<std::string> numbers;
        if (is_narrow()) {
            numbers = {"quantity", "band"};
            if (has_origins()) {
                numbers.emplace_back("origin");
            }
            numbers.emplace_back("unit");
        }
        for (std::size_t c = 0; c < (is_narrow() ? 1 : columns_.size()); ++c) {
            for (const CsvStatistic statistic : table_.statistics) {
                const StatisticRow& row = row_of(statistic);
                numbers.push_back(
                    is_narrow() ? std::string(row.narrow)
                                : columns_[c].name() + std::string(row.suffix));
            }
        }
        std::vector<std::string> taken = names;
        taken.insert(taken.end(), own.begin(), own.end());
        taken.insert(taken.end(), numbers.begin(), numbers.end());
        for (const std::string& label : labels_) {
            const bool clashes = std::find(taken.begin(), taken.end(), label) != taken.end();
            own.push_back(clashes ? "label_" + label : label);
        }
        own.insert(own.end(), numbers.begin(), numbers.end());
        std::for_each(names.begin(), names.end(), [](auto& name) { name = csv_field(name); });
        std::transform(own.begin(), own.end(), std::back_inserter(names), csv_field);
    }

    void write_rows(const std::string& first, const RowLight& light, const GroupResults& groups) {
        const std::size_t count = is_of_groups() ? groups.groups.size() : scene().organs().size();
        std::string out;
        for (std::size_t i = 0; i < count; ++i) {
            if (!(is_of_groups() ? rows_.has(groups.groups[i]) : rows_.has_organ(i))) {
                continue;
            }
            const std::string start =
                first + (is_of_groups() ? begin_group(groups.groups[i]) : begin_organ(i));
            is_narrow() ? append_narrow(out, start, light, i) : append_wide(out, start, light, i);
            if (out.size() >= kTablePiece) {
                sink_(out);
                out.clear();
            }
        }
        sink_(out);
    }

    [[nodiscard]] std::string begin_organ(std::size_t i) const {
        const Organ& organ = scene().organs()[i];
        std::string out = fmt::format("{},{}", organ.id, csv_field(organ.name));
        if (is_of_sensors()) {
            const Vec3 p = run_->scene.orientation().outward(positions_[i]);
            for (const double x : {p.x, p.y, p.z}) {
                append_number(out, x);
            }
        } else {
            append_number(out, organ.area);
        }
        append_labels(out, organ.labels, labels_);
        return out;
    }

    [[nodiscard]] std::string begin_group(const OrganGroup& group) const {
        std::string out = fmt::format(
            "{},{},{}", csv_field(group.by), csv_field(group.value), group.organs.size());
        append_number(out, group.area);
        append_labels(out, group.labels, labels_);
        return out;
    }

    void append_wide(
        std::string& out, const std::string& start, const RowLight& light, std::size_t i) const {
        out += start;
        for (const TableColumn& column : columns_) {
            append_estimate(out, column.at(light, i));
        }
        out += '\n';
    }

    void append_narrow(
        std::string& out, const std::string& start, const RowLight& light, std::size_t i) const {
        for (const TableColumn& column : columns_) {
            const Estimate estimate = column.at(light, i);
            if (std::isnan(estimate.mean) && std::isnan(estimate.ci95_high)) {
                continue;  // a group without this quantity, an organ that is not measured
            }
            out +=
                fmt::format("{},{},{}", start, csv_field(column.quantity), csv_field(column.band));
            if (has_origins()) {
                out += "," + csv_field(column.origin.empty() ? "all" : column.origin);
            }
            out += "," + csv_field(column.unit);
            append_estimate(out, estimate);
            out += '\n';
        }
    }

    void append_estimate(std::string& out, const Estimate& estimate) const {
        const Estimate e = reported(estimate);
        for (const CsvStatistic statistic : table_.statistics) {
            append_number(out, part_of(e, statistic));
        }
    }

    void append_number(std::string& out, double value) const {
        constexpr int kAllDigits = 17;
        if (table_.digits >= kAllDigits) {
            append_csv(out, value);
            return;
        }
        out += ',';
        if (std::isfinite(value)) {
            fmt::format_to(std::back_inserter(out), "{:.{}g}", value, table_.digits);
        }
    }

    const RunFile* run_;
    TableSpec table_;
    TextSink sink_;
    std::vector<TableColumn> columns_;
    TableRows rows_;
    std::vector<std::string> labels_;  // columns of labels
    std::optional<Scene> sensors_;     // scene_of_sensors()
    std::vector<Vec3> positions_;      // of sensors
    std::optional<SweepSum> sweep_;    // of a table of the sum over a sweep
    bool lacks_sensors_ = false;       // whether the light on sensors was not computed once
    bool has_head_ = false;
};

/// A wide table of all sensors, with the selection of [output].
std::unique_ptr<OutputWriter> make_table_of_sensors(const OutputInput& input, CsvTimes times) {
    TableSpec table{.file = input.path, .rows = CsvRows::sensors, .times = times};
    const OutputSpec& output = input.run.output;
    const std::vector<std::string_view> known =
        table_quantities(table.rows, times, input.run.series.has_value());
    std::copy_if(
        output.quantities.begin(), output.quantities.end(), std::back_inserter(table.quantities),
        [&](const std::string& name) {
            return std::find(known.begin(), known.end(), name) != known.end();
        });
    if (!table.quantities.empty() && is_summed(times) &&
        written_columns(input.run).has_sunlit_hours) {
        table.quantities.emplace_back(kSunlitHours);
    }
    table.bands = output.bands;
    return std::make_unique<TableWriter>(input.run, table, input.sink);
}

}  // namespace

std::unique_ptr<OutputWriter> make_sensors_csv(const OutputInput& input) {
    return make_table_of_sensors(input, CsvTimes::time_steps);
}

std::unique_ptr<OutputWriter> make_sensors_daily_csv(const OutputInput& input) {
    return make_table_of_sensors(input, CsvTimes::days);
}

std::unique_ptr<OutputWriter> make_table(const OutputInput& input) {
    if (input.table->rows == CsvRows::detectors) {
        return make_detectors(input);
    }
    if (input.table->rows == CsvRows::control) {
        return make_control_table(input);
    }
    return std::make_unique<TableWriter>(input.run, *input.table, input.sink);
}

}  // namespace quasimc
