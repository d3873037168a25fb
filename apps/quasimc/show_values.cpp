#include "show_values.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/text.h"
#include "files/input_files.h"
#include "resultio/describe_result.h"
#include "resultio/describe_series.h"
#include "resultio/read_result.h"
#include "resultio/read_rows.h"
#include "results/units.h"
#include "runfile/run_file.h"

namespace {

using quasimc::RunFile;

/// Quantities that a result may have for an organ.
std::vector<std::string> quantity_names(const RunFile& run) {
    std::vector<std::string> names;
    for (const quasimc::QuantityEntry& entry : quasimc::quantity_table()) {
        names.emplace_back(entry.name);
    }
    names.emplace_back("sunlit_fraction");
    names.insert(names.end(), run.spec.ratios.begin(), run.spec.ratios.end());
    return names;
}

const quasimc::QuantityEntry* find_quantity(const std::string& name) {
    const auto& table = quasimc::quantity_table();
    const auto* found = std::find_if(
        table.begin(), table.end(), [&](const auto& entry) { return entry.name == name; });
    return found == table.end() ? nullptr : found;
}

/// "did you mean 'PAR'?", or nothing.
std::string meant(const std::string& word, const std::vector<std::string>& names) {
    const std::vector<std::string_view> views(names.begin(), names.end());
    return quasimc::near_word_text(word, views);
}

const quasimc::Band& band_of(const RunFile& run, const std::string& name) {
    const auto& bands = run.scene.bands();
    const auto found = name.empty()
                           ? bands.begin()
                           : std::find_if(bands.begin(), bands.end(), [&](const auto& band) {
                                 return band.name == name;
                             });
    if (found == bands.end()) {
        std::vector<std::string> names;
        names.reserve(bands.size());
        for (const quasimc::Band& band : bands) {
            names.push_back(band.name);
        }
        throw quasimc::InputError(
            {{"--band", fmt::format("'{}' is not a band (bands: {})", name, fmt::join(names, ", ")),
              "", meant(name, names)}});
    }
    return *found;
}

/// The position of the numbers in the file; also sets their names.
quasimc::RowsQuery query_of(const RunFile& run, const ValueChoice& choice, ShownValues& values) {
    quasimc::RowsQuery query;
    query.part = !run.series            ? ""
                 : !choice.time.empty() ? "time_steps"
                 : !choice.day.empty()  ? "days"
                                        : "total";
    query.label = choice.time.empty() ? choice.day : choice.time;
    const quasimc::QuantityEntry* entry = find_quantity(choice.quantity);
    const auto& ratios = run.spec.ratios;
    if (entry != nullptr) {
        const quasimc::Band& band = band_of(run, choice.band);
        query.columns = {{std::string(entry->name), band.name}};
        values = named_values(run, *entry, band, query.part == "days" || query.part == "total");
    } else if (choice.quantity == "sunlit_fraction") {
        query.columns = {{"sunlit_fraction"}};
        values.key = "sunlit_fraction";
        values.name = "sunlit fraction";
    } else if (std::find(ratios.begin(), ratios.end(), choice.quantity) != ratios.end()) {
        query.columns = {{"ratios", choice.quantity}};
        values.key = choice.quantity;
        values.name = choice.quantity;
    } else {
        throw quasimc::InputError(
            {{"--quantity",
              fmt::format(
                  "'{}' is not one of {}", choice.quantity, fmt::join(quantity_names(run), ", ")),
              "", meant(choice.quantity, quantity_names(run))}});
    }
    if (run.sweep) {
        query.point = run.point;
    }
    return query;
}

void check_times(const RunFile& run, const ValueChoice& choice) {
    quasimc::Faults faults;
    for (const auto& [flag, text] :
         {std::pair("--time", &choice.time), std::pair("--day", &choice.day)}) {
        if (!run.series && !text->empty()) {
            faults.add({flag, "the run has no [time]", "", "remove it"});
        }
    }
    faults.throw_if_any();
}

[[noreturn]] void refuse_missing(
    const RunFile& run,
    const std::string& path,
    const ValueChoice& choice,
    const ShownValues& values) {
    const auto refuse = [&](const char* kind, const std::string& prefix, const std::string& first,
                            const std::string& last) {
        throw quasimc::InputError(
            {{fmt::format("--{}", kind),
              fmt::format("{} has no {} of a {} that begins '{}'", path, values.name, kind, prefix),
              fmt::format("{}s without light are left out", kind),
              first == last ? fmt::format("there is {}", first)
                            : fmt::format("there are {} to {}", first, last)}});
    };
    if (!choice.time.empty()) {
        const auto& notes = run.series->notes;
        refuse("time", choice.time, notes.front().time, notes.back().time);
    }
    if (!choice.day.empty()) {
        const auto& days = run.series->days;
        refuse("day", choice.day, days.front(), days.back());
    }
    throw quasimc::InputError(
        {{path, fmt::format("contains no {}", values.name),
          "the run did not write it, or there is none", "check [output] in the run file"}});
}

/// The available numbers among some choices, read in one pass.
/// @param choices  choices for one time
std::vector<ShownValues> find_shown_values(
    const ShownRun& shown, const std::string& path, const std::vector<ValueChoice>& choices) {
    const RunFile& run = shown.run;
    std::vector<ShownValues> requested(choices.size());
    std::vector<std::vector<std::string>> columns;
    quasimc::RowsQuery query;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        query = query_of(run, choices[i], requested[i]);
        columns.push_back(query.columns.front());
    }
    query.columns = columns;
    auto times = quasimc::read_rows(shown.result_text, path, query);
    std::vector<ShownValues> found;
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const auto first = std::find_if(
            times.begin(), times.end(), [&](const auto& time) { return !time.columns[i].empty(); });
        if (first == times.end()) {
            continue;
        }
        requested[i].estimates = std::move(first->columns[i]);
        requested[i].estimates.resize(run.scene.organs().size(), quasimc::kUnknownEstimate);
        requested[i].when = query.part == "total" ? "sum of all times" : first->position.label;
        found.push_back(std::move(requested[i]));
    }
    return found;
}

[[noreturn]] void refuse_choice(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    ShownValues sought;
    static_cast<void>(query_of(shown.run, choice, sought));
    refuse_missing(shown.run, path, choice, sought);
}

}  // namespace

ShownValues named_values(
    const RunFile& run,
    const quasimc::QuantityEntry& entry,
    const quasimc::Band& band,
    bool is_sum) {
    const std::string unit = quasimc::unit_of(entry, band, run.scene.length_unit());
    return {
        .estimates = {},
        .name = fmt::format("{}, {}", quasimc::describe_quantity(entry.name), band.name),
        .unit = is_sum ? quasimc::summed_unit(unit).name : unit,
        .key = fmt::format("{}_{}", entry.name, band.name),
        .when = ""};
}

Flag point_flag(std::size_t& point) {
    return {
        .name = "--sweep-point",
        .target = &point,
        .summary = "point of a sweep, from 1; default the first",
        .range = std::pair(1.0, 1e9)};
}

void subtract(
    const quasimc::Scene& scene,
    const ShownRun& other,
    const std::string& title,
    const ShownValues& of_other,
    ShownValues& values) {
    if (of_other.unit != values.unit) {
        throw quasimc::InputError(
            {quasimc::fault_of_units(title, values.name, values.unit, of_other.unit)});
    }
    std::unordered_map<std::int64_t, const quasimc::Estimate*> by_id;
    const auto& organs = other.run.scene.organs();
    for (std::size_t i = 0; i < organs.size(); ++i) {
        by_id[organs[i].id] = &of_other.estimates[i];
    }
    for (std::size_t i = 0; i < values.estimates.size(); ++i) {
        const auto found = by_id.find(scene.organs()[i].id);
        quasimc::Estimate& estimate = values.estimates[i];
        if (found == by_id.end()) {
            estimate = quasimc::kUnknownEstimate;
            continue;
        }
        estimate.mean -= found->second->mean;
        estimate.standard_error =
            std::hypot(estimate.standard_error, found->second->standard_error);
    }
    values.minus = title;
}

ShownRun read_shown_geometry(const std::string& path, const quasimc::FormatEntry& format) {
    quasimc::GeometryScene read = quasimc::read_geometry_scene(path, format);
    RunFile run{
        .path = path,
        .title = "",
        .scene = std::move(read.scene),
        .sources = {},
        .spec = {},
        .series = {},
        .gap_fractions = {},
        .output = {},
        .inputs = read.inputs,
        .folder = "",
        .source_notes = {},
        .warnings = std::move(read.warnings),
        .document = nullptr};
    return {std::move(run), "", std::move(read.inputs)};
}

const quasimc::FormatEntry* geometry_of(const std::string& path, const std::string& format) {
    const quasimc::FormatEntry* found =
        format.empty() ? quasimc::format_of_path(path) : quasimc::find_format(format);
    const quasimc::ForeignFormat* foreign = quasimc::foreign_format_of_path(path);
    if (found == nullptr && foreign != nullptr) {
        throw quasimc::InputError(
            {{path, fmt::format("is {}, which is not supported", foreign->name), "",
              std::string(foreign->advice)}});
    }
    return found;
}

ShownSweep read_shown_sweep(const std::string& path) {
    std::string text = quasimc::read_file(path);
    const std::size_t first = text.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) {
        throw quasimc::InputError({{path, "is empty", "", "give a result or a run file"}});
    }
    const bool is_result = text[first] == '{';
    // Standard input and pipes can be read only once.
    quasimc::FileAccess access;
    access.read = [&](const std::filesystem::path& file) {
        return file == path ? text : quasimc::read_file(file);
    };
    quasimc::RunSweep runs = is_result ? quasimc::read_result_sweep(path, {}, access).runs
                                       : quasimc::read_run_sweep(path, {}, access);
    return {std::move(runs), is_result ? std::move(text) : std::string()};
}

std::vector<quasimc::InputFile> shown_inputs(const quasimc::RunFile& run, const std::string& path) {
    std::vector<quasimc::InputFile> inputs = run.inputs;
    inputs.push_back({path, path, "", 0, false});
    return inputs;
}

ShownRun read_shown_run(const std::string& path, std::size_t point) {
    ShownSweep sweep = read_shown_sweep(path);
    if (point > sweep.runs.size()) {
        throw quasimc::InputError(
            {{"--sweep-point", fmt::format("{} is out of range", point),
              fmt::format("1 to {}", sweep.runs.size()), ""}});
    }
    ShownRun shown{sweep.runs.take(point == 0 ? 0 : point - 1), std::move(sweep.result_text), {}};
    shown.inputs = shown_inputs(shown.run, path);
    return shown;
}

std::vector<ShownValues> read_all_shown_values(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    check_times(shown.run, choice);
    std::vector<ValueChoice> choices;
    for (const std::string& name : quantity_names(shown.run)) {
        const bool has_bands = find_quantity(name) != nullptr;
        for (const quasimc::Band& band : shown.run.scene.bands()) {
            choices.push_back(choice);
            choices.back().quantity = name;
            choices.back().band = band.name;
            if (!has_bands) {
                break;
            }
        }
    }
    std::vector<ShownValues> all = find_shown_values(shown, path, choices);
    if (all.empty()) {
        refuse_choice(shown, path, choices.back());
    }
    return all;
}

std::vector<ShownValues> read_shown_times(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    ValueChoice any = choice;
    any.time = shown.run.series->notes.front().time;
    ShownValues named;
    quasimc::RowsQuery query = query_of(shown.run, any, named);
    query.label = "";
    std::vector<ShownValues> times;
    for (auto& rows : quasimc::read_rows(shown.result_text, path, query)) {
        if (!rows.columns.front().empty()) {
            times.push_back(named);
            times.back().estimates = std::move(rows.columns.front());
            times.back().estimates.resize(
                shown.run.scene.organs().size(), quasimc::kUnknownEstimate);
            times.back().when = rows.position.label;
        }
    }
    if (times.empty()) {
        refuse_choice(shown, path, choice);
    }
    return times;
}

ShownValues read_shown_values(
    const ShownRun& shown, const std::string& path, const ValueChoice& choice) {
    check_times(shown.run, choice);
    std::vector<ShownValues> found = find_shown_values(shown, path, {choice});
    if (found.empty()) {
        refuse_choice(shown, path, choice);
    }
    return std::move(found.front());
}
