#include <iterator>
#include <type_traits>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "quasimc/error.h"
#include "quasimc/result_file.h"
#include "quasimc/run_file.h"
#include "resultio/csv_parts.h"
#include "resultio/describe_series.h"
#include "resultio/output_input.h"
#include "resultio/part_columns.h"
#include "results/fraction_table.h"
#include "runfile/written.h"
#include "text/line_scanner.h"

namespace quasimc {
namespace {

constexpr std::size_t kCsvPiece = 1 << 16;

/// The names of the estimates of a row.
std::vector<std::string> estimate_columns(const RunFile& run, CsvRows rows, CsvTimes times) {
    const WrittenColumns written = written_columns(run);
    std::vector<std::string> columns = light_columns_of(run, written);
    for (const PartColumn& part : part_columns(written)) {
        columns.push_back(name_of(run, part, times));
    }
    if (times == CsvTimes::days) {
        if (written.has_sunlit_hours) {
            columns.emplace_back(kSunlitHours);
        }
        if (written.has_sunlit_hours && rows == CsvRows::groups) {
            columns.emplace_back(kSunlitAreaHours);
        }
    } else {
        if (written.has_sunlit) {
            columns.emplace_back("sunlit_fraction");
        }
        if (written.has_sunlit && rows == CsvRows::groups) {
            columns.emplace_back("sunlit_area");
        }
        for (const std::string& ratio : run.spec.ratios) {
            columns.push_back("ratio_" + ratio);
        }
    }
    for (std::size_t i = 0; rows == CsvRows::groups && i < written.bands.size(); ++i) {
        const std::string& band = run.scene.bands()[written.bands[i]].name;
        for (const ShareEntry& entry : share_table()) {
            columns.push_back(fmt::format("{}_{}", entry.name, band));
        }
        for (const FractionEntry& entry : fraction_table()) {
            columns.push_back(fmt::format("{}_{}", entry.name, band));
        }
    }
    return columns;
}

/// The comments on the shares of groups, and on the fractions of the canopy.
std::string share_columns() {
    std::string out;
    for (const FractionEntry& entry : fraction_table()) {
        out += fmt::format(
            "# column {}_BAND [1]: {}; only in the row of all organs, above a ground or in a "
            "cell\n",
            entry.name, entry.summary);
    }
    for (const ShareEntry& entry : share_table()) {
        out += fmt::format("# column {}_BAND [1]: {}\n", entry.name, entry.summary);
    }
    return out;
}

/// The comments on the columns of days that time steps lack.
std::string day_columns(const RunFile& run, CsvRows rows) {
    if (!written_columns(run).has_sunlit_hours) {
        return "";
    }
    const std::string of_groups =
        rows == CsvRows::groups
            ? fmt::format(", {} [{}2 h d-1]", kSunlitAreaHours, one_line(run.scene.length_unit()))
            : "";
    return fmt::format(
        "# column {} [h d-1]{}: sunlit fraction of the area x time\n", kSunlitHours, of_groups);
}

/// The comments on the columns of time steps that days lack.
std::string time_step_columns(const RunFile& run, CsvRows rows) {
    const bool is_of_groups = rows == CsvRows::groups;
    std::string out;
    if (written_columns(run).has_sunlit) {
        out += fmt::format(
            "# column sunlit_fraction [1]{}: fraction of the area lit directly by directional "
            "sources; empty without them\n",
            is_of_groups ? fmt::format(", sunlit_area [{}2]", one_line(run.scene.length_unit()))
                         : "");
    }
    for (const std::string& ratio : run.spec.ratios) {
        out += fmt::format(
            "# column ratio_{} [1]: ratio of incident light, both sides of the {}\n",
            one_line(ratio), is_of_groups ? "organs" : "organ");
    }
    return out;
}

/// Appends the sunlit fraction and the ratios.
/// @param light  a Result or a GroupResults
template <typename Light>
void append_traits(
    std::string& out, const WrittenColumns& written, const Light& light, std::size_t index) {
    const auto append = [&](const std::vector<Estimate>& values) {
        append_csv(out, values.empty() ? kUnknownEstimate : values[index]);
    };
    if (written.has_sunlit) {
        append(light.sunlit_fraction);
        if constexpr (std::is_same_v<Light, GroupResults>) {
            append(light.sunlit_area);
        }
    }
    for (std::size_t i = 0; i < light.ratios; ++i) {
        append_csv(out, light.ratio(index, i));
    }
}

/// Appends hours in the sun, if they are written.
void append_hours(
    std::string& out,
    const WrittenColumns& written,
    const std::vector<Estimate>& hours,
    std::size_t index) {
    if (written.has_sunlit_hours) {
        append_csv(out, hours.empty() ? kUnknownEstimate : hours[index]);
    }
}

/// The shares of a group.
void append_shares(
    std::string& out, const GroupResults& groups, std::size_t group, std::size_t band) {
    for (const ShareEntry& entry : share_table()) {
        append_csv(out, share_or_unknown(groups, group, entry.share, band));
    }
}

/// The shares of a group, and the fractions of the canopy, which the group of all organs has.
/// @param light  a Result or a SeriesSum
template <typename Light>
void append_fractions(
    std::string& out, const WrittenColumns& written, const Light& light, std::size_t group) {
    const bool has_fractions = group == 0 && !light.canopy.empty();
    for (const std::size_t b : written.bands) {
        append_shares(out, light.groups, group, b);
        for (const FractionEntry& entry : fraction_table()) {
            append_csv(out, has_fractions ? light.canopy[b].*entry.part : kUnknownEstimate);
        }
    }
}

}  // namespace

CsvWriter::CsvWriter(const RunFile& run, TextSink sink, CsvRows rows, CsvTimes times)
    : run_(&run),
      sink_(std::move(sink)),
      rows_(rows),
      times_(times),
      labels_(label_columns(run.scene)) {
    if (times == CsvTimes::days) {
        write_head(nullptr);
    }
}

/// @param result  first time step; null in a table of days
void CsvWriter::write_head(const Result* result) {
    const RunFile& run = *run_;
    const bool is_of_organs = rows_ == CsvRows::organs;
    std::string what = is_of_organs ? "table of organs" : "table of groups";
    std::vector<std::string> first = csv_point_names(run);
    std::string times, origin;
    if (result == nullptr) {
        what += " and days";
        times =
            "# column date: day of the sum, or first and last day\n# column seconds: duration of "
            "the time steps that were summed; 86400 for a whole day\n";
        first.insert(first.end(), {"date", "seconds"});
    } else if (run.series) {
        what += " and times";
        times = "# column time: beginning of the time step; values are means over it\n";
        first.emplace_back("time");
    } else {
        origin = csv_result_comments(run, *result);
    }
    sink_(csv_origin(run, what) + (run.series ? series_comments(run) : origin));
    sink_(csv_point_columns(run) + times);
    sink_(is_of_organs ? csv_organ_columns(run) : csv_group_columns(run));
    sink_(csv_light_columns(run, result == nullptr ? LightAmount::sum : LightAmount::rate));
    sink_(csv_part_columns(run, times_));
    sink_(result == nullptr ? day_columns(run, rows_) : time_step_columns(run, rows_));
    sink_((is_of_organs ? "" : share_columns()) + csv_error_columns());
    const std::vector<std::string> columns = estimate_columns(run, rows_, times_);
    sink_(
        is_of_organs ? csv_organ_header(first, labels_, columns)
                     : csv_group_header(first, columns));
    has_head_ = true;
}

/// @param first   beginning of each row
/// @param append  appends the columns after the organ or the group of a given index
template <typename Append>
void CsvWriter::write_rows(
    const std::string& first, const std::vector<OrganGroup>& groups, Append append) const {
    const std::vector<Organ>& organs = run_->scene.organs();
    const bool is_of_organs = rows_ == CsvRows::organs;
    std::string out;
    for (std::size_t i = 0; i < (is_of_organs ? organs.size() : groups.size()); ++i) {
        out += first;
        is_of_organs ? append_organ(out, organs[i], labels_) : append_group(out, groups[i]);
        append(out, i);
        out += '\n';
        if (out.size() >= kCsvPiece) {
            sink_(out);
            out.clear();
        }
    }
    sink_(out);
}

void CsvWriter::on_time_step(const TimeStepResult& step) {
    const Result& result = step.result;
    if (times_ == CsvTimes::days) {
        return;
    }
    if (!has_head_) {
        write_head(&result);
    }
    if (!is_written(*run_, step.time_step, result)) {
        return;
    }
    const WrittenColumns written = written_columns(*run_);
    const std::string time = run_->series ? run_->series->notes[step.time_step].time + "," : "";
    write_rows(
        csv_point_fields(*run_) + time, result.groups.groups, [&](std::string& out, std::size_t i) {
            if (rows_ == CsvRows::organs) {
                append_light(out, written, result, i);
                append_origins(
                    out, written, result.origins,
                    [](const OriginLight& o) -> const Result& { return o.light; }, i);
                append_parts(out, written, result.sun_shade, i);
                append_traits(out, written, result, i);
            } else {
                append_light(out, written, result.groups, i);
                append_origins(
                    out, written, result.origins,
                    [](const OriginLight& o) -> const GroupResults& { return o.light.groups; }, i);
                append_parts(out, written, result.groups.sun_shade, i);
                append_traits(out, written, result.groups, i);
                append_fractions(out, written, result, i);
            }
        });
}

void CsvWriter::on_day(std::size_t day, const SeriesSum& raw) {
    if (times_ != CsvTimes::days) {
        return;
    }
    const SeriesSum sum = in_summed_units(*run_, raw);
    const WrittenColumns written = written_columns(*run_);
    write_rows(
        fmt::format(
            "{}{},{},", csv_point_fields(*run_), run_->series->days[day], shortest(sum.seconds)),
        sum.groups.groups, [&](std::string& out, std::size_t i) {
            if (rows_ == CsvRows::organs) {
                append_light(out, written, sum, i);
                append_origins(
                    out, written, sum.origins,
                    [](const OriginSum& o) -> const SeriesSum& { return o.light; }, i);
                append_parts(out, written, sum.sun_shade, i);
                append_hours(out, written, sum.sunlit_hours, i);
                return;
            }
            append_light(out, written, sum.groups, i);
            append_origins(
                out, written, sum.origins,
                [](const OriginSum& o) -> const GroupResults& { return o.light.groups; }, i);
            append_parts(out, written, sum.groups.sun_shade, i);
            append_hours(out, written, sum.groups.sunlit_fraction, i);
            append_hours(out, written, sum.groups.sunlit_area, i);
            append_fractions(out, written, sum, i);
        });
}

std::unique_ptr<OutputWriter> make_csv(const OutputInput& input) {
    return std::make_unique<CsvWriter>(input.run, input.sink);
}

std::unique_ptr<OutputWriter> make_daily_csv(const OutputInput& input) {
    return std::make_unique<CsvWriter>(input.run, input.sink, CsvRows::organs, CsvTimes::days);
}

std::unique_ptr<OutputWriter> make_groups_csv(const OutputInput& input) {
    return std::make_unique<CsvWriter>(input.run, input.sink, CsvRows::groups);
}

std::unique_ptr<OutputWriter> make_groups_daily_csv(const OutputInput& input) {
    return std::make_unique<CsvWriter>(input.run, input.sink, CsvRows::groups, CsvTimes::days);
}

void write_csv(const RunFile& run, const Result& result, const TextSink& sink) {
    CsvWriter(run, sink).on_time_step({0, result});
}

}  // namespace quasimc
