#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

#include "quasimc/base/text.h"
#include "quasimc/base/version.h"
#include "quasimc/io/line_scanner.h"
#include "quasimc/io/options.h"
#include "quasimc/io/units.h"
#include "quasimc/io/write_result.h"

namespace quasimc {
namespace {

using Buffer = std::string;

/// RFC 4180; a '#' is quoted too, since readers take it for a comment.
std::string field(std::string_view text) {
    if (text.find_first_of(",\"\n\r#") == std::string_view::npos) {
        return std::string(text);
    }
    std::string quoted = "\"";
    for (const char c : text) {
        quoted += c == '"' ? "\"\"" : std::string(1, c);
    }
    return quoted + '"';
}

void append_number(Buffer& out, double value) {
    out += ',';
    if (std::isfinite(value)) {
        fmt::format_to(std::back_inserter(out), "{}", value);
    }
}

void append_estimate(Buffer& out, const Estimate& estimate) {
    append_number(out, estimate.mean);
    append_number(out, estimate.standard_error);
    append_number(out, estimate.high);
}

/// Every key of a label, in the order in which they first appear.
std::vector<std::string> label_keys(const Scene& scene) {
    std::vector<std::string> keys;
    for (const Organ& organ : scene.organs()) {
        for (const auto& [key, value] : organ.labels) {
            if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
                keys.push_back(key);
            }
        }
    }
    return keys;
}

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

std::string header_line(const RunFile& run, const std::vector<std::string>& labels) {
    std::vector<std::string> taken{"id", "name", "area"};
    const std::vector<std::string> columns = estimate_columns(run);
    for (const std::string& column : columns) {
        taken.insert(taken.end(), {column, column + "_se", column + "_high"});
    }
    std::string line = "id,name";
    for (const std::string& label : labels) {
        const bool clashes = std::find(taken.begin(), taken.end(), label) != taken.end();
        line += "," + field(clashes ? "label_" + label : label);
    }
    line += ",area";
    for (const std::string& column : columns) {
        line +=
            fmt::format(",{},{},{}", field(column), field(column + "_se"), field(column + "_high"));
    }
    return line + "\n";
}

void append_options(Buffer& out, const RunSpec& spec) {
    std::string text;
    for (const Option& option : option_table()) {
        text += fmt::format(
            "{}{} = {}", text.empty() ? "" : ", ", option.key, option_toml(option.get(spec)));
    }
    out += "# options: " + text + "\n";
}

void append_columns(Buffer& out, const RunFile& run) {
    const std::string& length = run.scene.length_unit();
    out += "# column id, name, labels: of the organ, as given\n";
    out += fmt::format("# column area [{}2]: of one side\n", length);
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
    out +=
        "# column ..._se: standard error of the number before it; empty where it can't be told "
        "(nothing was hit)\n";
    out +=
        "# column ..._high: upper end of the 95 % confidence interval; a bound where nothing was "
        "hit\n";
}

std::string provenance(const RunFile& run, const Result& result) {
    const Orientation& axes = run.scene.orientation();
    Buffer out = fmt::format("# QuasiMC {}, table of organs, format 1\n", version());
    if (!run.title.empty()) {
        out += "# title: " + one_line(run.title) + "\n";
    }
    for (const InputFile& input : run.inputs) {
        out += fmt::format("# input: {} (sha256 {})\n", one_line(input.path), input.sha256);
    }
    append_options(out, run.spec);
    out += fmt::format(
        "# done: {} paths x {} replicates, {} rays\n", result.paths, result.replicates,
        result.rays);
    out += fmt::format(
        "# axes: up {}, north ({}, {}, {}); length unit {}\n", axes.up() == UpAxis::z ? "z" : "y",
        axes.north().x, axes.north().y, axes.north().z, one_line(run.scene.length_unit()));
    for (const std::string& note : run.source_notes) {
        out += "# source: " + one_line(note) + "\n";
    }
    append_columns(out, run);
    return out;
}

void append_organ(Buffer& out, const Organ& organ, const std::vector<std::string>& labels) {
    fmt::format_to(std::back_inserter(out), "{},{}", organ.id, field(organ.name));
    for (const std::string& key : labels) {
        const auto found = std::find_if(
            organ.labels.begin(), organ.labels.end(),
            [&](const auto& l) { return l.first == key; });
        out += ',';
        out += found == organ.labels.end() ? "" : field(found->second);
    }
    append_number(out, organ.area);
}

void append_results(Buffer& out, const Result& result, std::size_t organ) {
    for (std::size_t b = 0; b < result.bands; ++b) {
        for (const QuantityEntry& entry : quantity_table()) {
            append_estimate(out, result.at(organ, entry.quantity, b));
        }
    }
    if (result.sunlit_fraction.empty()) {
        out += ",,,";
    } else {
        append_estimate(out, result.sunlit_fraction[organ]);
    }
    for (std::size_t i = 0; i < result.ratios; ++i) {
        append_estimate(out, result.ratio(organ, i));
    }
    out += '\n';
}

}  // namespace

void write_csv(const RunFile& run, const Result& result, const TextSink& sink) {
    constexpr std::size_t kPiece = 1 << 16;
    const std::vector<std::string> labels = label_keys(run.scene);
    Buffer out = provenance(run, result) + header_line(run, labels);
    const std::vector<Organ>& organs = run.scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        append_organ(out, organs[i], labels);
        append_results(out, result, i);
        if (out.size() >= kPiece) {
            sink(out);
            out.clear();
        }
    }
    sink(out);
}

}  // namespace quasimc
