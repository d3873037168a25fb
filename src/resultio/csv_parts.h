#pragma once

// The parts that tables in CSV are made of. Included by their writers only.

#include <string>
#include <string_view>
#include <vector>

#include "quasimc/result.h"
#include "runfile/run_file.h"
#include "runfile/written.h"
#include "sums/statistics.h"

namespace quasimc {

/// A field as RFC 4180 has it; a '#' is quoted too, since readers take it for a comment.
[[nodiscard]] std::string csv_field(std::string_view text);
/// A comma and the number, or nothing after the comma if it is not finite.
void append_csv(std::string& out, double value);
/// Mean, standard error and upper end.
void append_csv(std::string& out, const Estimate& estimate);

/// Every key of a label, in the order in which they first appear: the same for all points of a
/// sweep.
[[nodiscard]] std::vector<std::string> label_columns(const Scene& scene);
/// The header line: `first`, the organ's columns with its labels (renamed if they clash), and
/// `columns`, each with _se and _ci95_high.
[[nodiscard]] std::string csv_organ_header(
    const std::vector<std::string>& first,
    const std::vector<std::string>& labels,
    const std::vector<std::string>& columns);
/// The header line of a table of groups.
[[nodiscard]] std::string csv_group_header(
    const std::vector<std::string>& first, const std::vector<std::string>& columns);
/// Appends the values of labels with these keys, empty where there is none.
void append_labels(std::string& out, const Labels& labels, const std::vector<std::string>& keys);
/// "id,name,labels,area" of an organ.
void append_organ(std::string& out, const Organ& organ, const std::vector<std::string>& labels);
/// The columns of a group before its light.
void append_group(std::string& out, const OrganGroup& group);

/// The light of an organ or of a group, column by column.
/// @param light  a Result, a GroupResults or a SeriesSum
template <typename Light>
void append_light(
    std::string& out, const WrittenColumns& columns, const Light& light, std::size_t index) {
    for (const std::size_t b : columns.bands) {
        for (const QuantityEntry& entry : columns.quantities) {
            append_csv(out, light.at(index, entry.quantity, b));
        }
    }
}

/// The light of an organ or of a group from each origin, column by column.
/// @param origins  of a Result or a SeriesSum
/// @param light_of  the Result, GroupResults or SeriesSum of one of them
template <typename Origins, typename LightOf>
void append_origins(
    std::string& out,
    const WrittenColumns& columns,
    const Origins& origins,
    const LightOf& light_of,
    std::size_t index) {
    for (const auto& origin : origins) {
        append_light(out, columns, light_of(origin), index);
    }
}

/// How light is counted: as it shines, or summed over the times of a day or a period.
enum class LightAmount { rate, sum };
/// The comments on the columns of light.
[[nodiscard]] std::string csv_light_columns(const RunFile& run, LightAmount amount);

// Parts for sweeps; all are empty in a run without [sweep].
/// A column for each swept key, and its comment.
[[nodiscard]] std::vector<std::string> csv_point_names(const RunFile& run);
[[nodiscard]] std::string csv_point_columns(const RunFile& run);
/// The values of the run's point, each with a comma, at the beginning of rows.
[[nodiscard]] std::string csv_point_fields(const RunFile& run);

/// How a run without [time] was computed, as comments; empty in a sweep, whose points differ.
[[nodiscard]] std::string csv_result_comments(const RunFile& run, const Result& result);

/// The comments on program, files and scene.
[[nodiscard]] std::string csv_origin(const RunFile& run, std::string_view what);
/// The comments on the columns that identify organs and groups, and on errors.
[[nodiscard]] std::string csv_organ_columns(const RunFile& run);
[[nodiscard]] std::string csv_group_columns(const RunFile& run);
[[nodiscard]] std::string csv_error_columns();

}  // namespace quasimc
