#include "resultio/csv_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "options/options.h"
#include "quasimc/version.h"
#include "resultio/describe_result.h"
#include "resultio/describe_series.h"
#include "results/groups.h"
#include "results/units.h"
#include "text/line_scanner.h"

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

/// The comments on sources; in a sweep, for every point, with the values that the point sets.
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
        out += fmt::format("# point {}: {}\n", i + 1, one_line(describe_point(point)));
        for (const std::string& note : point.source_notes) {
            out += fmt::format("# point {}: source: {}\n", i + 1, one_line(note));
        }
    }
    return out;
}

/// @param columns  of estimates, each with its error and upper end
std::string header_line(
    const std::vector<std::string>& names, const std::vector<std::string>& columns) {
    std::string line;
    const auto add = [&](const std::string& name) {
        line += (line.empty() ? "" : ",") + csv_field(name);
    };
    std::for_each(names.begin(), names.end(), add);
    for (const std::string& column : columns) {
        add(column);
        add(column + "_se");
        add(column + "_ci95_high");
    }
    return line + "\n";
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
    append_csv(out, e.ci95_high);
}

std::vector<std::string> label_columns(const Scene& scene) {
    const std::vector<std::string_view> keys = label_keys(scene);
    return {keys.begin(), keys.end()};
}

std::string csv_organ_header(
    const std::vector<std::string>& first,
    const std::vector<std::string>& labels,
    const std::vector<std::string>& columns) {
    std::vector<std::string> taken = first;
    taken.insert(taken.end(), {"id", "name", "area"});
    for (const std::string& column : columns) {
        taken.insert(taken.end(), {column, column + "_se", column + "_ci95_high"});
    }
    std::vector<std::string> names = first;
    names.insert(names.end(), {"id", "name"});
    for (const std::string& label : labels) {
        const bool clashes = std::find(taken.begin(), taken.end(), label) != taken.end();
        names.push_back(clashes ? "label_" + label : label);
    }
    names.emplace_back("area");
    return header_line(names, columns);
}

std::string csv_group_header(
    const std::vector<std::string>& first, const std::vector<std::string>& columns) {
    std::vector<std::string> names = first;
    names.insert(
        names.end(), {"by", "value", "organs", "area", "height_min", "height_max",
                      "plant_area_index", "cumulative_plant_area_index"});
    return header_line(names, columns);
}

void append_labels(std::string& out, const Labels& labels, const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
        const std::string* label = find_label(labels, key);
        out += ',';
        out += label == nullptr ? "" : csv_field(*label);
    }
}

void append_organ(std::string& out, const Organ& organ, const std::vector<std::string>& labels) {
    fmt::format_to(std::back_inserter(out), "{},{}", organ.id, csv_field(organ.name));
    append_labels(out, organ.labels, labels);
    append_csv(out, organ.area);
}

void append_group(std::string& out, const OrganGroup& group) {
    fmt::format_to(
        std::back_inserter(out), "{},{},{}", csv_field(group.by), csv_field(group.value),
        group.organs.size());
    for (const double x :
         {group.area, group.height_min, group.height_max, group.plant_area_index,
          group.cumulative_plant_area_index}) {
        append_csv(out, x);
    }
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
        "# completed: {} paths x {} replicates, {} rays\n", result.paths, result.replicates,
        result.rays);
    const std::string stopped = describe_stop(run.spec, result);
    out += stopped.empty() ? "" : "# stopped: " + stopped + "\n";
    for (const std::string& words : audit_lines(run, result)) {
        out += "# audit: " + one_line(words) + "\n";
    }
    return out;
}

std::string csv_light_columns(const RunFile& run, LightAmount amount) {
    const WrittenColumns columns = written_columns(run);
    std::string out;
    if (!columns.origins.empty()) {
        out +=
            "# columns ..._from_ORIGIN: the part of the light that came from that origin, direct "
            "or scattered\n";
    }
    const bool is_period = run.series && run.series->cumulative_sky == CumulativeSky::period;
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
        "# column id, name, labels: of the organ\n"
        "# column area [{}2]: one-sided area of the organ\n",
        one_line(run.scene.length_unit()));
}

std::string csv_group_columns(const RunFile& run) {
    return fmt::format(
        "# column by: all, the key of a label, or layer\n# column value: value of the label, or "
        "number of the layer from below\n# column organs: number of measured organs, without the "
        "ground\n# column area [{0}2]: their one-sided area\n# column height_min, height_max "
        "[{0}]: ends of the layer; it contains organs by the centroid of their area\n# column "
        "plant_area_index, cumulative_plant_area_index [1]: area / horizontal area of cell or "
        "ground, for this layer, and for it and those above\n",
        one_line(run.scene.length_unit()));
}

std::string csv_error_columns() {
    return "# column ..._se: standard error of the number before it; empty where it is unknown (no "
           "light sampled)\n# column ..._ci95_high: upper end of the 95 % confidence interval; an "
           "upper limit where no light was sampled\n";
}

}  // namespace quasimc
