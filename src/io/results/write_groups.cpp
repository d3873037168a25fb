#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/line_scanner.h"
#include "io/results/csv_parts.h"
#include "io/results/fraction_table.h"
#include "io/results/series_words.h"
#include "quasimc/file.h"

namespace quasimc {
namespace {

constexpr std::string_view kGroupColumns =
    "by,value,organs,area,low,high,plant_area_index,cumulative_plant_area_index";

/// What comes before the columns of light.
void append_group(std::string& out, const OrganGroup& group) {
    fmt::format_to(
        std::back_inserter(out), "{},{},{}", csv_field(group.by), csv_field(group.value),
        group.organs.size());
    for (const double x :
         {group.area, group.low, group.high, group.plant_area_index,
          group.cumulative_plant_area_index}) {
        append_csv(out, x);
    }
}

std::string group_comments(const RunFile& run) {
    const std::string length = one_line(run.scene.length_unit());
    return fmt::format(
        "# column by: what the organs of a row have in common: all, a key of labels, layer\n"
        "# column value: of the label; of a layer its number from below\n"
        "# column organs: how many; those that are measured, without the ground\n"
        "# column area [{0}2]: of one side of all of them\n"
        "# column low, high [{0}]: of a layer, whose organs have the centroids of their areas in "
        "it\n"
        "# column plant_area_index, cumulative_plant_area_index [1]: of a layer, of this one and "
        "those above: area / horizontal area of cell or ground\n",
        length);
}

/// "name,name_se,name_high" of each.
std::string estimate_header(const std::vector<std::string>& columns) {
    std::string line(kGroupColumns);
    for (const std::string& column : columns) {
        line += fmt::format(
            ",{},{},{}", csv_field(column), csv_field(column + "_se"), csv_field(column + "_high"));
    }
    return line + "\n";
}

std::vector<std::string> group_columns(const RunFile& run, const WrittenColumns& written) {
    std::vector<std::string> columns = light_columns_of(run, written);
    if (written.has_sunlit) {
        columns.insert(columns.end(), {"sunlit_fraction", "sunlit_area"});
    }
    for (const std::string& ratio : run.spec.ratios) {
        columns.push_back("ratio_" + ratio);
    }
    for (const std::size_t b : written.bands) {
        for (const FractionEntry& entry : fraction_table()) {
            columns.push_back(fmt::format("{}_{}", entry.name, run.scene.bands()[b].name));
        }
    }
    return columns;
}

std::string group_light_comments(const RunFile& run, const WrittenColumns& written) {
    std::string out = csv_light_columns(run, written, LightAmount::rate);
    if (written.has_sunlit) {
        out += fmt::format(
            "# column sunlit_fraction [1], sunlit_area [{}2]: part of the area lit straight by "
            "directional sources; empty without any\n",
            one_line(run.scene.length_unit()));
    }
    for (const std::string& ratio : run.spec.ratios) {
        out += fmt::format(
            "# column ratio_{} [1]: of the light that falls on the organs, both sides\n",
            one_line(ratio));
    }
    for (const FractionEntry& entry : fraction_table()) {
        out += fmt::format(
            "# column {}_BAND [1]: {}; in the row of all organs, over a ground or in a cell\n",
            entry.name, entry.summary);
    }
    return out;
}

void append_fractions(
    std::string& out, const WrittenColumns& written, const Result& result, std::size_t group) {
    const bool has_fractions = group == 0 && !result.canopy.empty();
    for (const std::size_t b : written.bands) {
        for (const FractionEntry& entry : fraction_table()) {
            if (has_fractions) {
                append_csv(out, result.canopy[b].*entry.part);
            } else {
                out += ",,,";
            }
        }
    }
}

void append_group_results(
    std::string& out, const WrittenColumns& written, const Result& result, std::size_t group) {
    const GroupResults& groups = result.groups;
    append_group(out, groups.groups[group]);
    append_light(out, written, groups, group);
    if (written.has_sunlit && groups.sunlit_fraction.empty()) {
        out += ",,,,,,";
    } else if (written.has_sunlit) {
        append_csv(out, groups.sunlit_fraction[group]);
        append_csv(out, groups.sunlit_area[group]);
    }
    for (std::size_t i = 0; i < groups.ratios; ++i) {
        append_csv(out, groups.ratio(group, i));
    }
    append_fractions(out, written, result, group);
    out += '\n';
}

}  // namespace

GroupsWriter::GroupsWriter(const RunFile& run, TextSink sink)
    : run_(&run), sink_(std::move(sink)) {}

void GroupsWriter::add_moment(std::size_t time_step, const Result& result) {
    const RunFile& run = *run_;
    const WrittenColumns written = written_columns(run);
    if (!std::exchange(has_head_, true)) {
        sink_(
            run.series ? csv_origin(run, "table of groups and times") + series_comments(run) +
                             "# column time: where the time that the row is the mean of begins\n"
                       : csv_origin(run, "table of groups") + csv_result_comments(run, result));
        sink_(
            csv_point_columns(run) + group_comments(run) + group_light_comments(run, written) +
            csv_error_columns() + csv_point_header(run) + (run.series ? "time," : "") +
            estimate_header(group_columns(run, written)));
    }
    if (!is_written(run, time_step, result)) {
        return;
    }
    for (std::size_t g = 0; g < result.groups.groups.size(); ++g) {
        std::string row = csv_point_fields(run);
        row += run.series ? run.series->notes[time_step].time + "," : "";
        append_group_results(row, written, result, g);
        sink_(row);
    }
}

GroupDaysWriter::GroupDaysWriter(const RunFile& run, TextSink sink)
    : run_(&run), sink_(std::move(sink)) {
    const WrittenColumns written = written_columns(run);
    sink_(csv_origin(run, "table of groups and days") + series_comments(run));
    sink_(
        csv_point_columns(run) +
        "# column date: of the day that the row is the sum over, or first and last day\n"
        "# column seconds: of the times that were summed; of a whole day 86400\n");
    sink_(group_comments(run) + csv_light_columns(run, written, LightAmount::sum));
    sink_(csv_error_columns() + csv_point_header(run) + "date,seconds,");
    sink_(estimate_header(light_columns_of(run, written)));
}

void GroupDaysWriter::add_day(std::size_t day, const SeriesSum& raw) {
    const SeriesSum sum = in_summed_units(*run_, raw);
    const WrittenColumns written = written_columns(*run_);
    for (std::size_t g = 0; g < sum.groups.groups.size(); ++g) {
        std::string row = fmt::format(
            "{}{},{},", csv_point_fields(*run_), run_->series->days[day], shortest(sum.seconds));
        append_group(row, sum.groups.groups[g]);
        append_light(row, written, sum.groups, g);
        sink_(row + "\n");
    }
}

}  // namespace quasimc
