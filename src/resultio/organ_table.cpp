#include "resultio/organ_table.h"

#include <fmt/format.h>

#include "quasimc/version.h"
#include "resultio/csv_parts.h"
#include "text/line_scanner.h"

namespace quasimc {

void write_organ_table(
    const Scene& scene,
    std::span<const OrganColumn> columns,
    const std::string& comments,
    const TextSink& sink) {
    std::vector<std::string> names;
    std::string text = fmt::format("# QuasiMC {}, table of organs\n{}", version(), comments);
    for (const OrganColumn& column : columns) {
        names.push_back(column.name);
        text += fmt::format(
            "# column {}: {}\n", one_line(column.name), column.unit.empty() ? "1" : column.unit);
    }
    text += columns.empty() ? "" : csv_error_columns();
    const std::vector<std::string> labels = label_columns(scene);
    text += csv_organ_header({}, labels, names);
    constexpr std::size_t kPiece = std::size_t{1} << 16U;
    for (std::size_t i = 0; i < scene.organs().size(); ++i) {
        append_organ(text, scene.organs()[i], labels);
        for (const OrganColumn& column : columns) {
            append_csv(text, column.values[i]);
        }
        text += '\n';
        if (text.size() >= kPiece) {
            sink(text);
            text.clear();
        }
    }
    sink(text);
}

}  // namespace quasimc
