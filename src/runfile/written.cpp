#include "runfile/written.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/text.h"
#include "light/source_origins.h"
#include "series/trace_spec.h"
#include "text/numbers.h"
#include "text/table_reader.h"

namespace quasimc {
namespace {

constexpr std::string_view kSunlit = "sunlit_fraction";

bool is_named(const std::vector<std::string>& names, std::string_view name) {
    return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

void check_names(
    const std::vector<std::string>& names,
    const std::vector<std::string_view>& known,
    std::string_view where,
    std::string_view what,
    Faults& faults) {
    for (const std::string& name : names) {
        if (std::find(known.begin(), known.end(), name) == known.end()) {
            faults.add(
                {std::string(where), fmt::format("'{}' is not a {}", name, what), "",
                 did_you_mean(name, known)});
        }
    }
}

/// The clock time at which a time step begins: "2024-06-21T12:30+02:00" is 12.5.
double clock_hours(const std::string& time) {
    constexpr double kMinutes = 60;
    const std::size_t clock = time.find('T');
    if (clock == std::string::npos || time.size() < clock + 6) {
        return 0;
    }
    const std::string_view text(time);
    const auto hours = parse_real(text.substr(clock + 1, 2));
    const auto minutes = parse_real(text.substr(clock + 4, 2));
    return hours.value_or(0) + minutes.value_or(0) / kMinutes;
}

/// The names of the origins of a run's light.
std::vector<std::string> origins_of(const RunFile& run) {
    return run.series ? with_origins_of_all(run.spec, run.series->time_steps).origins
                      : complete_origins(run.sources, run.spec.origins);
}

/// The quantities of parts that a run has, of those that are named (none: all).
std::vector<SunShadeEntry> parts_of_run(const RunFile& run, const std::vector<std::string>& names) {
    std::vector<SunShadeEntry> parts;
    for (const SunShadeEntry& entry : sun_shade_table()) {
        if (run.spec.sun_shade == SunShade::apart && is_named(names, entry.name)) {
            parts.push_back(entry);
        }
    }
    return parts;
}

}  // namespace

WrittenColumns written_columns(const RunFile& run) {
    WrittenColumns columns;
    const OutputSpec& output = run.output;
    for (const QuantityEntry& entry : quantity_table()) {
        if (is_named(output.quantities, entry.name)) {
            columns.quantities.push_back(entry);
        }
    }
    const std::vector<Band>& bands = run.scene.bands();
    for (std::size_t b = 0; b < bands.size(); ++b) {
        if (is_named(output.bands, bands[b].name)) {
            columns.bands.push_back(b);
        }
    }
    columns.origins = origins_of(run);
    columns.parts = parts_of_run(run, output.quantities);
    columns.has_sunlit = is_named(output.quantities, kSunlit);
    columns.has_sunlit_hours = columns.has_sunlit && run.spec.sun_shade == SunShade::apart;
    columns.is_all = columns.has_sunlit && columns.quantities.size() == kQuantities &&
                     columns.bands.size() == bands.size() &&
                     columns.parts.size() == parts_of_run(run, {}).size();
    return columns;
}

WrittenColumns all_columns(const RunFile& run) {
    WrittenColumns columns;
    columns.quantities.assign(quantity_table().begin(), quantity_table().end());
    for (std::size_t b = 0; b < run.scene.bands().size(); ++b) {
        columns.bands.push_back(b);
    }
    columns.origins = origins_of(run);
    columns.parts = parts_of_run(run, {});
    return columns;
}

bool needs_parts(std::string_view quantity) {
    return quantity == kSunlitHours || quantity == kSunlitAreaHours ||
           std::ranges::any_of(sun_shade_table(), [&](const SunShadeEntry& entry) {
               return entry.name == quantity || entry.of_sums == quantity;
           });
}

bool needs_parts(const OutputSpec& output) {
    const auto names_one = [](const auto& choice) {
        return std::ranges::any_of(
            choice.quantities, [](const std::string& name) { return needs_parts(name); });
    };
    return names_one(output) || std::ranges::any_of(output.tables, names_one);
}

std::vector<std::string> light_columns_of(const RunFile& run, const WrittenColumns& columns) {
    std::vector<std::string> names;
    for (const std::size_t b : columns.bands) {
        for (const QuantityEntry& entry : columns.quantities) {
            names.push_back(fmt::format("{}_{}", entry.name, run.scene.bands()[b].name));
        }
    }
    const std::vector<std::string> all = names;
    for (const std::string& origin : columns.origins) {
        for (const std::string& name : all) {
            names.push_back(fmt::format("{}_from_{}", name, origin));
        }
    }
    return names;
}

bool is_selected(const RunFile& run, std::size_t time_step) {
    const double clock = clock_hours(run.series->notes[time_step].time);
    const auto& hours = run.output.time_of_day;
    return !hours || ((*hours)[0] <= clock && clock < (*hours)[1]);
}

bool is_written(const RunFile& run, std::size_t time_step, const Result& result) {
    const bool is_dark = result.paths == 0;
    return !run.series || ((run.output.include_night || !is_dark) && is_selected(run, time_step));
}

std::string describe_point(const SweepPoint& point) {
    std::string text;
    for (const SweptValue& value : point.values) {
        text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", value.key, value.text);
    }
    return text;
}

void check_written(const OutputSpec& output, const std::vector<Band>& bands, Faults& faults) {
    std::vector<std::string_view> quantities = names_in(quantity_table());
    quantities.push_back(kSunlit);
    for (const SunShadeEntry& entry : sun_shade_table()) {
        quantities.push_back(entry.name);
    }
    check_names(output.quantities, quantities, "quantities", "quantity", faults);
    check_names(output.bands, names_in(bands), "bands", "band", faults);
}

}  // namespace quasimc
