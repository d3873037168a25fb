#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/results/csv_parts.h"
#include "io/results/series_words.h"
#include "io/runfile/units.h"
#include "quasimc/file.h"

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

DaysWriter::DaysWriter(const RunFile& run, TextSink sink)
    : run_(run), sink_(std::move(sink)), labels_(label_keys(run.scene)) {
    sink_(csv_origin(run, "table of organs and days") + series_comments(run));
    const bool is_period = run.series->collapse == Collapse::period;
    sink_(
        is_period ? "# column date: first and last day that the row is the sum over\n"
                  : "# column date: of the day that the row is the sum over\n");
    sink_("# column seconds: of the times that were summed; of a whole day 86400\n");
    sink_(csv_organ_columns(run));
    for (const Band& band : run.scene.bands()) {
        for (const QuantityEntry& entry : quantity_table()) {
            const std::string unit = unit_of(entry, band, run.scene.length_unit());
            sink_(fmt::format(
                "# column {}_{} [{}{}]: {}\n", entry.name, band.name, summed_unit(unit).name,
                is_period ? "" : " d-1", entry.summary));
        }
    }
    sink_(csv_error_columns());
    sink_(csv_header({"date", "seconds"}, labels_, sum_columns(run)));
}

void DaysWriter::add_day(std::size_t day, const SeriesSum& raw) {
    const SeriesSum sum = in_summed_units(run_, raw);
    const std::string first = fmt::format("{},{},", run_.series->days[day], shortest(sum.seconds));
    const std::vector<Organ>& organs = run_.scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        std::string row = first;
        append_organ(row, organs[i], labels_);
        for (std::size_t b = 0; b < sum.bands; ++b) {
            for (const QuantityEntry& entry : quantity_table()) {
                append_csv(row, sum.at(i, entry.quantity, b));
            }
        }
        sink_(row + "\n");
    }
}

}  // namespace quasimc
