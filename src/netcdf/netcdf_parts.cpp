#include "netcdf/netcdf_parts.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "options/options.h"
#include "text/line_scanner.h"
#include "weather/civil_time_text.h"

namespace quasimc {

std::vector<NetcdfBands> netcdf_bands(const RunFile& run, const WrittenColumns& columns) {
    const std::vector<Band>& all = run.scene.bands();
    const bool is_one = std::all_of(columns.bands.begin(), columns.bands.end(), [&](std::size_t b) {
        return all[b].unit == all[columns.bands.front()].unit;
    });
    if (is_one) {
        return {{columns.bands, ""}};
    }
    std::vector<NetcdfBands> lists;
    for (const std::size_t b : columns.bands) {
        lists.push_back({{b}, "_" + all[b].name});
    }
    return lists;
}

double netcdf_seconds(const std::string& time) {
    constexpr double kDayOf1970 = 2440587.5, kSecondsPerDay = 86400, kMilli = 1000;
    Faults faults;
    const auto civil = parse_civil_time(time, 0, "time", faults);
    faults.throw_if_any();
    return std::round((julian_day(*civil) - kDayOf1970) * kSecondsPerDay * kMilli) / kMilli;
}

std::vector<std::size_t> netcdf_rows(const RunFile& run, bool may_be_dark) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; run.series && i < run.series->time_steps.size(); ++i) {
        Result result;
        result.paths = run.series->time_steps[i].sources.empty() && !may_be_dark ? 0 : 1;
        if (is_written(run, i, result)) {
            rows.push_back(i);
        }
    }
    return rows;
}

NetcdfAttributes netcdf_attributes(const RunFile& run, std::string_view program_version) {
    std::string options, inputs, sources;
    for (const Option& option : option_table()) {
        options += fmt::format(
            "{}{} = {}", options.empty() ? "" : ", ", option.key,
            option_toml(option.get(run.spec)));
    }
    for (const InputFile& input : run.inputs) {
        inputs += fmt::format(
            "{}{} (sha256 {})", inputs.empty() ? "" : "; ", one_line(input.path), input.sha256);
    }
    for (const std::string& note : run.source_notes) {
        sources += (sources.empty() ? "" : "; ") + one_line(note);
    }
    NetcdfAttributes attributes{{"Conventions", "CF-1.8"}};
    if (!run.title.empty()) {
        attributes.emplace_back("title", run.title);
    }
    attributes.emplace_back("source", fmt::format("QuasiMC {}", program_version));
    attributes.emplace_back("inputs", inputs);
    attributes.emplace_back("options", options);
    if (!sources.empty() && !run.sweep) {
        attributes.emplace_back("sources", sources);
    }
    return attributes;
}

}  // namespace quasimc
