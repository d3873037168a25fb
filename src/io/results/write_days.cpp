#include <fmt/format.h>

#include "base/text.h"
#include "io/results/csv_parts.h"
#include "io/results/series_words.h"
#include "io/results/write_series.h"
#include "io/runfile/units.h"

namespace quasimc {
namespace {

std::vector<std::string> sum_columns(const RunFile& run) {
    std::vector<std::string> columns;
    for (const Band& band : run.scene.bands()) {
        for (const QuantityEntry& entry : quantity_table()) {
            columns.push_back(fmt::format("{}_{}", entry.name, band.name));
        }
    }
    return columns;
}

}  // namespace

void write_days_head(const RunFile& run, const TextSink& sink) {
    sink(csv_origin(run, "table of organs and days") + series_comments(run));
    const bool is_period = run.series->collapse == Collapse::period;
    sink(
        is_period ? "# column date: first and last day that the row is the sum over\n"
                  : "# column date: of the day that the row is the sum over\n");
    sink("# column seconds: of the times that were summed; of a whole day 86400\n");
    sink(csv_organ_columns(run));
    for (const Band& band : run.scene.bands()) {
        for (const QuantityEntry& entry : quantity_table()) {
            const std::string unit = unit_of(entry, band, run.scene.length_unit());
            sink(fmt::format(
                "# column {}_{} [{}{}]: {}\n", entry.name, band.name, summed_unit(unit).name,
                is_period ? "" : " d-1", entry.summary));
        }
    }
    sink(csv_error_columns());
    sink(csv_header({"date", "seconds"}, label_keys(run.scene), sum_columns(run)));
}

void write_days_day(
    const RunFile& run, std::size_t day, const SeriesSum& raw, const TextSink& sink) {
    const SeriesSum sum = in_summed_units(run, raw);
    const std::vector<std::string> labels = label_keys(run.scene);
    const std::vector<Organ>& organs = run.scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        std::string row = fmt::format("{},{},", run.series->days[day], shortest(sum.seconds));
        append_organ(row, organs[i], labels);
        for (std::size_t b = 0; b < sum.bands; ++b) {
            for (const QuantityEntry& entry : quantity_table()) {
                append_csv(row, sum.at(i, entry.quantity, b));
            }
        }
        sink(row + "\n");
    }
}

}  // namespace quasimc
