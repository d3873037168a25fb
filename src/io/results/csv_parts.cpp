#include "io/results/csv_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "io/line_scanner.h"
#include "io/results/audit_words.h"
#include "io/results/series_words.h"
#include "io/results/stop_words.h"
#include "io/runfile/options.h"
#include "io/runfile/units.h"
#include "quasimc/version.h"
#include "results/groups.h"

namespace quasimc {
namespace {

std::string options_line(const RunSpec& spec) {
    std::string text;
    for (const Option& option : option_table()) {
        text += fmt::format(
            "{}{} = {}", text.empty() ? "" : ", ", option.key, option_toml(option.get(spec)));
    }
    return "# options: " + one_line(text) + "\n";
}

/// Where the light comes from; of a sweep at every point, and what the point sets.
std::string source_comments(const RunFile& run) {
    std::string out;
    if (!run.sweep) {
        for (const std::string& note : run.source_notes) {
            out += "# source: " + one_line(note) + "\n";
        }
        return out;
    }
    for (std::size_t i = 0; i < run.sweep->size(); ++i) {
        const SweepPoint& point = (*run.sweep)[i];
        out += fmt::format("# point {}: {}\n", i + 1, one_line(point_words(point)));
        for (const std::string& note : point.source_notes) {
            out += fmt::format("# point {}: source: {}\n", i + 1, one_line(note));
        }
    }
    return out;
}

}  // namespace

std::string csv_field(std::string_view text) {
    if (text.find_first_of(",\"\n\r#") == std::string_view::npos) {
        return std::string(text);
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

void append_csv(std::string& out, double value) {
    out += ',';
    if (std::isfinite(value)) {
        fmt::format_to(std::back_inserter(out), "{}", value);
    }
}

void append_csv(std::string& out, const Estimate& estimate) {
    const Estimate e = reported(estimate);
    append_csv(out, e.mean);
    append_csv(out, e.standard_error);
    append_csv(out, e.high);
}

std::vector<std::string> label_columns(const Scene& scene) {
    const std::vector<std::string_view> keys = label_keys(scene);
    return {keys.begin(), keys.end()};
}

std::string csv_header(
    const std::vector<std::string>& first,
    const std::vector<std::string>& labels,
    const std::vector<std::string>& columns) {
    std::vector<std::string> taken = first;
    taken.insert(taken.end(), {"id", "name", "area"});
    for (const std::string& column : columns) {
        taken.insert(taken.end(), {column, column + "_se", column + "_high"});
    }
    std::string line;
    for (const std::string& name : first) {
        line += name + ",";
    }
    line += "id,name";
    for (const std::string& label : labels) {
        const bool clashes = std::find(taken.begin(), taken.end(), label) != taken.end();
        line += "," + csv_field(clashes ? "label_" + label : label);
    }
    line += ",area";
    for (const std::string& column : columns) {
        line += fmt::format(
            ",{},{},{}", csv_field(column), csv_field(column + "_se"), csv_field(column + "_high"));
    }
    return line + "\n";
}

void append_organ(std::string& out, const Organ& organ, const std::vector<std::string>& labels) {
    fmt::format_to(std::back_inserter(out), "{},{}", organ.id, csv_field(organ.name));
    for (const std::string& key : labels) {
        const auto found = std::find_if(
            organ.labels.begin(), organ.labels.end(),
            [&](const auto& l) { return l.first == key; });
        out += ',';
        out += found == organ.labels.end() ? "" : csv_field(found->second);
    }
    append_csv(out, organ.area);
}

std::string csv_origin(const RunFile& run, std::string_view what) {
    const Orientation& axes = run.scene.orientation();
    std::string out = fmt::format("# QuasiMC {}, {}, format 1\n", version(), what);
    if (!run.title.empty()) {
        out += "# title: " + one_line(run.title) + "\n";
    }
    for (const InputFile& input : run.inputs) {
        out += fmt::format("# input: {} (sha256 {})\n", one_line(input.path), input.sha256);
    }
    out += options_line(run.spec);
    out += fmt::format(
        "# axes: up {}, north ({}, {}, {}); length unit {}\n", axes.up() == UpAxis::z ? "z" : "y",
        axes.north().x, axes.north().y, axes.north().z, one_line(run.scene.length_unit()));
    return out + source_comments(run);
}

std::vector<std::string> csv_point_names(const RunFile& run) {
    std::vector<std::string> names;
    for (std::size_t i = 0; run.sweep && i < run.sweep->front().values.size(); ++i) {
        names.push_back(run.sweep->front().values[i].key);
    }
    return names;
}

std::string csv_point_columns(const RunFile& run) {
    std::string out;
    for (const std::string& name : csv_point_names(run)) {
        out += "# column " + one_line(name) + ": value of the point of the sweep\n";
    }
    return out;
}

std::string csv_point_header(const RunFile& run) {
    std::string out;
    for (const std::string& name : csv_point_names(run)) {
        out += csv_field(name) + ",";
    }
    return out;
}

std::string csv_point_fields(const RunFile& run) {
    std::string out;
    for (std::size_t i = 0; run.sweep && i < run.sweep->front().values.size(); ++i) {
        out += csv_field((*run.sweep)[run.point].values[i].text) + ",";
    }
    return out;
}

std::string csv_result_comments(const RunFile& run, const Result& result) {
    if (run.sweep) {
        return "";
    }
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

std::string csv_light_columns(
    const RunFile& run, const WrittenColumns& columns, LightAmount amount) {
    const bool is_period = run.series && run.series->collapse == Collapse::period;
    std::string out;
    for (const std::size_t b : columns.bands) {
        const Band& band = run.scene.bands()[b];
        for (const QuantityEntry& entry : columns.quantities) {
            const std::string unit = unit_of(entry, band, run.scene.length_unit());
            const std::string shown = amount == LightAmount::rate
                                          ? unit
                                          : summed_unit(unit).name + (is_period ? "" : " d-1");
            out += one_line(fmt::format(
                       "# column {}_{} [{}]: {}", entry.name, band.name, shown, entry.summary)) +
                   "\n";
        }
    }
    return out;
}

std::string csv_organ_columns(const RunFile& run) {
    return fmt::format(
        "# column id, name, labels: of the organ, as given\n"
        "# column area [{}2]: of one side\n",
        one_line(run.scene.length_unit()));
}

std::string csv_error_columns() {
    return "# column ..._se: standard error of the number before it; empty where it can't be told "
           "(nothing was hit)\n"
           "# column ..._high: upper end of the 95 % confidence interval; a bound where nothing "
           "was "
           "hit\n";
}

}  // namespace quasimc
