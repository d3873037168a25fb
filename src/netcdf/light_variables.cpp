#include "netcdf/light_variables.h"

#include <utility>

#include "results/units.h"

namespace quasimc {

LightVariables::LightVariables(const RunFile& run, NetcdfAxes& axes, NetcdfRows rows)
    : axes_(axes), rows_(std::move(rows)) {
    define(run);
    define_traits(run.series.has_value());
}

NetcdfEstimates LightVariables::add(
    const std::string& name,
    const std::string& unit,
    const std::string& summary,
    std::vector<Axis> axes) {
    axes.insert(axes.end(), rows_.axes.begin(), rows_.axes.end());
    return axes_.add_estimates({rows_.prefix + name, unit, summary, rows_.coordinates}, axes);
}

void LightVariables::define(const RunFile& run) {
    constexpr const char *kByOrigin = "_by_origin", *kOfOrigin = ", of an origin";
    const Axis &time = axes_.time(), &band = axes_.band(), &day = axes_.day();
    const Axis& origin = axes_.origin();
    for (const NetcdfBands& list : axes_.bands) {
        const Band& first = run.scene.bands()[list.bands.front()];
        for (const QuantityEntry& entry : rows_.quantities) {
            const std::string unit = unit_of(entry, first, run.scene.length_unit());
            const std::string name = std::string(entry.name) + list.suffix;
            const std::string summary(entry.summary);
            light_.push_back(add(name, unit, summary, {time, band}));
            if (origin.first) {
                light_by_origin_.push_back(
                    add(name + kByOrigin, unit, summary + kOfOrigin, {time, origin, band}));
            }
            if (!run.series) {
                continue;
            }
            const std::string summed = summed_unit(unit).name, of_day = name + "_day_sum";
            days_.push_back(add(of_day, summed, summary + ", summed", {day, band}));
            if (origin.first) {
                days_by_origin_.push_back(
                    add(of_day + kByOrigin, summed, summary + kOfOrigin + ", summed",
                        {day, origin, band}));
            }
        }
    }
}

void LightVariables::define_traits(bool has_days) {
    if (axes_.columns.has_sunlit) {
        sunlit_ = add(
            "sunlit_fraction", "1", "fraction lit directly by directional sources", {axes_.time()});
    }
    if (axes_.columns.has_sunlit_hours && has_days) {
        sunlit_hours_ =
            add("sunlit_hours", "h", "sunlit fraction of the area x time", {axes_.day()});
    }
    if (axes_.ratio().first) {
        ratios_ =
            add("light_ratio", "1", "ratio of incident light, both sides",
                {axes_.time(), axes_.ratio()});
    }
}

std::vector<NetcdfEstimates> LightVariables::add_fractions(
    const std::string& name, const std::string& summary, CsvTimes times) {
    const bool is_daily = times == CsvTimes::days;
    const Axis& axis = is_daily ? axes_.day() : axes_.time();
    const char* ending = is_daily ? "_day_mean" : "";
    std::vector<NetcdfEstimates> variables;
    for (const NetcdfBands& list : axes_.bands) {
        variables.push_back(add(name + list.suffix + ending, "1", summary, {axis, axes_.band()}));
    }
    return variables;
}

std::vector<std::size_t> LightVariables::sizes(std::size_t bands) const {
    std::vector<std::size_t> all;
    if (bands > 0) {
        all.push_back(bands);
    }
    for (const Axis& axis : rows_.axes) {
        all.push_back(axis.second);
    }
    return all;
}

/// @param light  a Result or a SeriesSum
template <typename Light>
void LightVariables::put_light(
    const std::vector<NetcdfEstimates>& variables,
    const std::vector<std::size_t>& start,
    const Light& light) {
    std::size_t number = 0;
    for (const NetcdfBands& list : axes_.bands) {
        for (const QuantityEntry& entry : rows_.quantities) {
            axes_.put(variables[number++], start, sizes_in(list), [&](std::size_t i) {
                return light.at(
                    rows_.first + i % rows_.count, entry.quantity, list.bands[i / rows_.count]);
            });
        }
    }
}

/// @param light  a Result or a SeriesSum
template <typename Light>
void LightVariables::put_origins(
    const std::vector<NetcdfEstimates>& variables,
    const std::vector<std::size_t>& start,
    const Light& light) {
    for (std::size_t i = 0; i < light.origins.size(); ++i) {
        std::vector<std::size_t> own = start;
        own.push_back(i);
        put_light(variables, own, light.origins[i].light);
    }
}

void LightVariables::put(const std::vector<std::size_t>& start, const Result& result) {
    put_light(light_, start, result);
    put_origins(light_by_origin_, start, result);
    if (sunlit_ && !result.sunlit_fraction.empty()) {
        axes_.put(*sunlit_, start, sizes(), [&](std::size_t i) {
            return result.sunlit_fraction[rows_.first + i];
        });
    }
    if (ratios_) {
        axes_.put(*ratios_, start, sizes(result.ratios), [&](std::size_t i) {
            return result.ratio(rows_.first + i % rows_.count, i / rows_.count);
        });
    }
}

void LightVariables::put_day(const std::vector<std::size_t>& start, const SeriesSum& sum) {
    put_light(days_, start, sum);
    put_origins(days_by_origin_, start, sum);
    if (sunlit_hours_ && !sum.sunlit_hours.empty()) {
        axes_.put(*sunlit_hours_, start, sizes(), [&](std::size_t i) {
            return sum.sunlit_hours[rows_.first + i];
        });
    }
}

}  // namespace quasimc
