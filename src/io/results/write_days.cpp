#include <utility>

#include <fmt/format.h>

#include "base/text.h"
#include "io/results/csv_parts.h"
#include "io/results/series_words.h"
#include "quasimc/file.h"

namespace quasimc {

DaysWriter::DaysWriter(const RunFile& run, TextSink sink)
    : run_(&run), sink_(std::move(sink)), labels_(label_columns(run.scene)) {
    sink_(csv_origin(run, "table of organs and days") + series_comments(run));
    const bool is_period = run.series->collapse == Collapse::period;
    sink_(csv_point_columns(run));
    sink_(
        is_period ? "# column date: first and last day that the row is the sum over\n"
                  : "# column date: of the day that the row is the sum over\n");
    sink_("# column seconds: of the times that were summed; of a whole day 86400\n");
    sink_(csv_organ_columns(run));
    const WrittenColumns columns = written_columns(run);
    sink_(csv_light_columns(run, columns, LightAmount::sum));
    sink_(csv_error_columns());
    std::vector<std::string> first = csv_point_names(run);
    first.insert(first.end(), {"date", "seconds"});
    sink_(csv_header(first, labels_, light_columns_of(run, columns)));
}

void DaysWriter::add_day(std::size_t day, const SeriesSum& raw) {
    const SeriesSum sum = in_summed_units(*run_, raw);
    const WrittenColumns columns = written_columns(*run_);
    const std::string first = fmt::format(
        "{}{},{},", csv_point_fields(*run_), run_->series->days[day], shortest(sum.seconds));
    const std::vector<Organ>& organs = run_->scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        std::string row = first;
        append_organ(row, organs[i], labels_);
        append_light(row, columns, sum, i);
        sink_(row + "\n");
    }
}

}  // namespace quasimc
