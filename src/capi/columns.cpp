#include "capi/columns.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace quasimc::capi {
namespace {

/// The statistic with a name.
double Estimate::*statistic_of(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, double Estimate::*>, 4> kStatistics{
        {{"mean", &Estimate::mean},
         {"standard_error", &Estimate::standard_error},
         {"ci95_low", &Estimate::ci95_low},
         {"ci95_high", &Estimate::ci95_high}}};
    for (const auto& [of_statistic, member] : kStatistics) {
        if (of_statistic == name) {
            return member;
        }
    }
    throw Misuse(fmt::format(
        "unknown statistic '{}': use mean, standard_error, ci95_low or ci95_high", name));
}

/// The part of a quantity's name that names an origin: "absorbed_flux_from_sun".
constexpr std::string_view kFrom = "_from_";

/// The light of the origin that a quantity names, or null.
const Result* origin_of(const Result& result, std::string_view quantity) {
    const auto names_it = [&](const OriginLight& origin) {
        return quantity.ends_with(std::string(kFrom) + origin.name);
    };
    const auto found = std::ranges::find_if(result.origins, names_it);
    return found == result.origins.end() ? nullptr : &found->light;
}

}  // namespace

std::size_t band_of(const quasimc_result& result, const char* name) try {
    return result.scene->names()->band_index(text_of(name, "band"));
} catch (const InputError& error) {
    throw Misuse(error.what());
}

Rows rows_of_organs(const Result& result) {
    return {
        result.values, result.sunlit_fraction, result.ratio_values, result.sun_shade,
        result.organs()};
}

Rows rows_of_groups(const Result& result) {
    const GroupResults& groups = result.groups;
    return {
        groups.values, groups.sunlit_fraction, groups.ratio_values, groups.sun_shade,
        groups.groups.size()};
}

Column column_of(
    const quasimc_result& result,
    const Result& light,
    Rows (*rows_of)(const Result&),
    const char* quantity,
    const char* band) {
    std::string name = text_of(quantity, "quantity");
    const Result* origin = origin_of(light, name);
    if (origin != nullptr) {
        name.resize(name.find(kFrom));
    }
    const Rows rows = rows_of(origin != nullptr ? *origin : light);
    for (const QuantityEntry& entry : quantity_table()) {
        if (entry.name == name) {
            const std::size_t bands = result.result.bands;
            const auto number = static_cast<std::size_t>(entry.quantity);
            return {
                rows.values.data() + number * bands + band_of(result, band), kQuantities * bands};
        }
    }
    for (const SunShadeEntry& entry : sun_shade_table()) {
        if (entry.name == name && !rows.parts.empty()) {
            const std::size_t of_band = entry.has_bands() ? band_of(result, band) : 0;
            const auto number = static_cast<std::size_t>(entry.quantity);
            return {
                rows.parts.values.data() + number * rows.parts.bands + of_band,
                rows.parts.values_per_row()};
        }
    }
    if (origin == nullptr && name == "sunlit_fraction" && rows.sunlit.size() == rows.count) {
        return {rows.sunlit.data(), 1};
    }
    const auto ratio = std::find(result.ratios.begin(), result.ratios.end(), name);
    if (origin != nullptr || ratio == result.ratios.end()) {
        throw Misuse(fmt::format("the result has no quantity '{}'", name));
    }
    return {rows.ratios.data() + (ratio - result.ratios.begin()), result.ratios.size()};
}

void check_count(std::int64_t count, std::size_t rows) {
    if (count != static_cast<std::int64_t>(rows)) {
        throw Misuse(fmt::format("there is room for {} values: there are {}", count, rows));
    }
}

void copy_rows(
    FunctionRef<Estimate(std::size_t)> estimate_of,
    std::size_t rows,
    const char* statistic,
    double* values,
    std::int64_t count) {
    check_count(count, rows);
    double Estimate::*member = statistic_of(text_of(statistic, "statistic"));
    double* out = &deref(values, "values");
    for (std::size_t i = 0; i < rows; ++i) {
        out[i] = reported(estimate_of(i)).*member;
    }
}

void copy_estimate(const Estimate& estimate, double* values) {
    double* out = &deref(values, "values");
    const Estimate e = reported(estimate);
    const std::array<double, 4> numbers{e.mean, e.standard_error, e.ci95_low, e.ci95_high};
    std::copy(numbers.begin(), numbers.end(), out);
}

const char* label_by_key(const Organ& organ, const std::string& key) {
    const std::string* label = find_label(organ.labels, key);
    return label == nullptr ? nullptr : label->c_str();
}

}  // namespace quasimc::capi
