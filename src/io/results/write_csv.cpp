#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/results/audit_words.h"
#include "io/results/csv_parts.h"
#include "io/results/series_words.h"
#include "io/results/stop_words.h"
#include "io/runfile/options.h"
#include "io/runfile/units.h"
#include "quasimc/file.h"

namespace quasimc {
namespace {

constexpr std::size_t kCsvPiece = 1 << 16;

/// The columns of numbers: the name of each estimate.
std::vector<std::string> estimate_columns(const RunFile& run) {
    std::vector<std::string> columns;
    for (const Band& band : run.scene.bands()) {
        for (const QuantityEntry& entry : quantity_table()) {
            columns.push_back(fmt::format("{}_{}", entry.name, band.name));
        }
    }
    columns.emplace_back("sunlit_fraction");
    for (const std::string& ratio : run.spec.ratios) {
        columns.push_back("ratio_" + ratio);
    }
    return columns;
}

/// The comments on the columns of light.
std::string light_columns(const RunFile& run) {
    const std::string& length = run.scene.length_unit();
    std::string out;
    for (const Band& band : run.scene.bands()) {
        for (const QuantityEntry& entry : quantity_table()) {
            out += fmt::format(
                "# column {}_{} [{}]: {}\n", entry.name, band.name, unit_of(entry, band, length),
                entry.summary);
        }
    }
    out +=
        "# column sunlit_fraction [1]: part of the area lit straight by directional sources; empty "
        "without any\n";
    for (const std::string& ratio : run.spec.ratios) {
        out += fmt::format(
            "# column ratio_{} [1]: of the light that falls on the organ, both sides\n", ratio);
    }
    return out;
}

void append_results(std::string& out, const Result& result, std::size_t organ) {
    for (std::size_t b = 0; b < result.bands; ++b) {
        for (const QuantityEntry& entry : quantity_table()) {
            append_csv(out, result.at(organ, entry.quantity, b));
        }
    }
    if (result.sunlit_fraction.empty()) {
        out += ",,,";
    } else {
        append_csv(out, result.sunlit_fraction[organ]);
    }
    for (std::size_t i = 0; i < result.ratios; ++i) {
        append_csv(out, result.ratio(organ, i));
    }
    out += '\n';
}

/// How a run without [time] was computed.
std::string result_comments(const RunFile& run, const Result& result) {
    std::string out = fmt::format(
        "# method: {}, {}\n", method_name(result.chosen.method), one_line(result.chosen.reason));
    out += fmt::format(
        "# done: {} paths x {} replicates, {} rays\n", result.paths, result.replicates,
        result.rays);
    const std::string stopped = stop_words(run.spec, result);
    out += stopped.empty() ? "" : "# stopped: " + stopped + "\n";
    for (const std::string& words : audit_lines(run, result)) {
        out += "# audit: " + one_line(words) + "\n";
    }
    return out;
}

}  // namespace

CsvWriter::CsvWriter(const RunFile& run, TextSink sink)
    : run_(run), sink_(std::move(sink)), labels_(label_keys(run.scene)) {}

void CsvWriter::write_head(const Result& result) {
    const std::string columns = csv_organ_columns(run_) + light_columns(run_) + csv_error_columns();
    if (run_.series) {
        sink_(csv_origin(run_, "table of organs and times") + series_comments(run_));
        sink_("# column time: where the time that the row is the mean of begins\n" + columns);
        sink_(csv_header({"time"}, labels_, estimate_columns(run_)));
    } else {
        sink_(csv_origin(run_, "table of organs") + result_comments(run_, result) + columns);
        sink_(csv_header({}, labels_, estimate_columns(run_)));
    }
}

void CsvWriter::add_moment(std::size_t time_step, const Result& result) {
    if (!std::exchange(has_head_, true)) {
        write_head(result);
    }
    const std::string first = run_.series ? run_.series->notes[time_step].time + "," : "";
    const std::vector<Organ>& organs = run_.scene.organs();
    std::string out;
    for (std::size_t i = 0; i < organs.size(); ++i) {
        out += first;
        append_organ(out, organs[i], labels_);
        append_results(out, result, i);
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
