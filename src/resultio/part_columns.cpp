#include "resultio/part_columns.h"

#include <fmt/format.h>

#include "resultio/csv_parts.h"
#include "resultio/describe_series.h"
#include "text/line_scanner.h"

namespace quasimc {

std::vector<PartColumn> part_columns(const WrittenColumns& columns) {
    std::vector<PartColumn> parts;
    for (const std::size_t b : columns.bands) {
        for (const SunShadeEntry& entry : columns.parts) {
            if (entry.has_bands()) {
                parts.push_back({entry, b});
            }
        }
    }
    for (const SunShadeEntry& entry : columns.parts) {
        if (!entry.has_bands()) {
            parts.push_back({entry});
        }
    }
    return parts;
}

std::string quantity_of(const PartColumn& column, CsvTimes times) {
    return std::string(is_summed(times) ? column.entry.of_sums : column.entry.name);
}

std::string name_of(const RunFile& run, const PartColumn& column, CsvTimes times) {
    const std::string name = quantity_of(column, times);
    return column.entry.has_bands()
               ? fmt::format("{}_{}", name, run.scene.bands()[column.band].name)
               : name;
}

std::string unit_of(const RunFile& run, const PartColumn& column, CsvTimes times) {
    const std::string& of_band = run.scene.bands()[column.band].unit;
    if (!column.entry.has_bands()) {
        return is_summed(times) ? "h" : "1";
    }
    const bool is_sum = is_summed(times) && column.entry.part == SunShadePart::direct;
    return is_sum ? summed_unit(of_band).name : of_band;
}

std::string per_day(const PartColumn& column, CsvTimes times) {
    const bool is_sum = column.entry.part == SunShadePart::direct || !column.entry.has_bands();
    return is_sum && times == CsvTimes::days ? " d-1" : "";
}

std::string summary_of(const PartColumn& column, CsvTimes times) {
    const bool is_same = !is_summed(times) || column.entry.part == SunShadePart::direct;
    const char* more = is_same                    ? ""
                       : column.entry.has_bands() ? ", mean over area and time"
                                                  : " x time";
    return std::string(column.entry.summary) + more;
}

void append_parts(
    std::string& out, const WrittenColumns& columns, const SunShadeLight& light, std::size_t row) {
    for (const PartColumn& column : part_columns(columns)) {
        append_csv(out, column.of(light, row));
    }
}

std::string csv_part_columns(const RunFile& run, CsvTimes times) {
    std::string out;
    for (const PartColumn& column : part_columns(written_columns(run))) {
        out +=
            one_line(fmt::format(
                "# column {} [{}{}]: {}", name_of(run, column, times), unit_of(run, column, times),
                per_day(column, times), summary_of(column, times))) +
            "\n";
    }
    return out;
}

}  // namespace quasimc
