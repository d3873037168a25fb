#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/results/csv_parts.h"
#include "io/results/series_words.h"
#include "io/results/written.h"
#include "quasimc/file.h"

namespace quasimc {
namespace {

constexpr std::size_t kCsvPiece = 1 << 16;

/// The columns of numbers: the name of each estimate.
std::vector<std::string> estimate_columns(const RunFile& run) {
    const WrittenColumns written = written_columns(run);
    std::vector<std::string> columns = light_columns_of(run, written);
    if (written.has_sunlit) {
        columns.emplace_back("sunlit_fraction");
    }
    for (const std::string& ratio : run.spec.ratios) {
        columns.push_back("ratio_" + ratio);
    }
    return columns;
}

/// The comments on the columns of light.
std::string light_columns(const RunFile& run) {
    const WrittenColumns written = written_columns(run);
    std::string out = csv_light_columns(run, written, LightAmount::rate);
    if (written.has_sunlit) {
        out +=
            "# column sunlit_fraction [1]: part of the area lit straight by directional sources; "
            "empty without any\n";
    }
    for (const std::string& ratio : run.spec.ratios) {
        out += fmt::format(
            "# column ratio_{} [1]: of the light that falls on the organ, both sides\n",
            one_line(ratio));
    }
    return out;
}

void append_results(
    std::string& out, const WrittenColumns& columns, const Result& result, std::size_t organ) {
    append_light(out, columns, result, organ);
    if (columns.has_sunlit && result.sunlit_fraction.empty()) {
        out += ",,,";
    } else if (columns.has_sunlit) {
        append_csv(out, result.sunlit_fraction[organ]);
    }
    for (std::size_t i = 0; i < result.ratios; ++i) {
        append_csv(out, result.ratio(organ, i));
    }
    out += '\n';
}

}  // namespace

CsvWriter::CsvWriter(const RunFile& run, TextSink sink)
    : run_(&run), sink_(std::move(sink)), labels_(label_columns(run.scene)) {}

void CsvWriter::write_head(const Result& result) {
    const RunFile& run = *run_;
    const std::string columns = csv_organ_columns(run) + light_columns(run) + csv_error_columns();
    std::vector<std::string> first = csv_point_names(run);
    if (run.series) {
        first.emplace_back("time");
        sink_(csv_origin(run, "table of organs and times") + series_comments(run));
        sink_(csv_point_columns(run));
        sink_("# column time: where the time that the row is the mean of begins\n" + columns);
    } else {
        sink_(csv_origin(run, "table of organs") + csv_result_comments(run, result));
        sink_(csv_point_columns(run) + columns);
    }
    sink_(csv_header(first, labels_, estimate_columns(run)));
}

void CsvWriter::add_moment(std::size_t time_step, const Result& result) {
    if (!std::exchange(has_head_, true)) {
        write_head(result);
    }
    if (!is_written(*run_, time_step, result)) {
        return;
    }
    const WrittenColumns columns = written_columns(*run_);
    const std::string first =
        csv_point_fields(*run_) + (run_->series ? run_->series->notes[time_step].time + "," : "");
    const std::vector<Organ>& organs = run_->scene.organs();
    std::string out;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        out += first;
        append_organ(out, organs[i], labels_);
        append_results(out, columns, result, i);
        if (out.size() >= kCsvPiece) {
            sink_(out);
            out.clear();
        }
    }
    sink_(out);
}

void write_csv(const RunFile& run, const Result& result, const TextSink& sink) {
    CsvWriter(run, sink).add_moment(0, result);
}

}  // namespace quasimc
