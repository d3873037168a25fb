#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "capi/guard.h"
#include "capi/handles.h"

namespace quasimc::capi {
namespace {

/// An item of a list, counted from 0. @throws Misuse  if there is none
template <typename List>
const auto& item_at(const List& list, std::int64_t index, const char* what) {
    if (index < 0 || index >= static_cast<std::int64_t>(list.size())) {
        throw Misuse(fmt::format("there is no {} {}: there are {}", what, index, list.size()));
    }
    return list[static_cast<std::size_t>(index)];
}

const Organ& organ_at(const quasimc_result* result, std::int64_t organ) {
    return item_at(deref(result, "result").scene->organs(), organ, "organ");
}

const OrganGroup& group_at(const quasimc_result* result, std::int64_t group) {
    return item_at(deref(result, "result").result.groups.groups, group, "group");
}

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

std::size_t band_of(const quasimc_result& result, const char* name) try {
    return result.scene->names()->band_index(text_of(name, "band"));
} catch (const InputError& error) {
    throw Misuse(error.what());
}

/// Estimates of organs or of groups, one row each.
struct Rows {
    const std::vector<Estimate>& values;
    const std::vector<Estimate>& sunlit;
    const std::vector<Estimate>& ratios;
    const SunShadeLight& parts;
    std::size_t count;
};

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

/// One number of every row: offset of the first, and stride.
struct Column {
    const Estimate* first;
    std::size_t stride;
};

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

/// @param light  the light of a result: that on organs, or on sensors
/// @param rows_of  the rows of a Result
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

/// Copies a number of every row. @param count  capacity
void copy_rows(
    const Column& column,
    std::size_t rows,
    const char* statistic,
    double* values,
    std::int64_t count) {
    if (count != static_cast<std::int64_t>(rows)) {
        throw Misuse(fmt::format("there is room for {} values: there are {}", count, rows));
    }
    double Estimate::*member = statistic_of(text_of(statistic, "statistic"));
    double* out = &deref(values, "values");
    for (std::size_t i = 0; i < rows; ++i) {
        out[i] = reported(column.first[i * column.stride]).*member;
    }
}

void copy_estimate(const Estimate& estimate, double* values) {
    double* out = &deref(values, "values");
    const Estimate e = reported(estimate);
    const std::array<double, 4> numbers{e.mean, e.standard_error, e.ci95_low, e.ci95_high};
    std::copy(numbers.begin(), numbers.end(), out);
}

const Estimate& budget_item(const BandBudget& budget, std::string_view item) {
    constexpr std::array<std::pair<std::string_view, Estimate BandBudget::*>, 6> kItems{
        {{"emitted", &BandBudget::emitted},
         {"absorbed_by_organs", &BandBudget::absorbed_by_organs},
         {"absorbed_by_ground", &BandBudget::absorbed_by_ground},
         {"escaped", &BandBudget::escaped},
         {"cut_off", &BandBudget::cut_off},
         {"imbalance", &BandBudget::imbalance}}};
    for (const auto& [name, member] : kItems) {
        if (name == item) {
            return budget.*member;
        }
    }
    throw Misuse(fmt::format("the budget has no item '{}'", item));
}

/// The index of a name. @param what  owner of the names, for messages
template <std::size_t Count>
double number_named(
    const std::array<std::pair<std::string_view, double>, Count>& numbers,
    std::string_view key,
    std::string_view what) {
    for (const auto& [name, number] : numbers) {
        if (name == key) {
            return number;
        }
    }
    throw Misuse(fmt::format("a {} has no number '{}'", what, key));
}

double number_of(const Result& result, std::string_view key) {
    const std::array<std::pair<std::string_view, double>, 7> numbers{
        {{"paths", static_cast<double>(result.paths)},
         {"replicates", static_cast<double>(result.replicates)},
         {"rays", static_cast<double>(result.rays)},
         {"fraction_at_target", result.fraction_at_target},
         {"preparation_seconds", result.preparation_seconds},
         {"solve_seconds", result.solve_seconds},
         {"solve_cpu_seconds", result.solve_cpu_seconds}}};
    return number_named(numbers, key, "result");
}

double number_of(const RoundErrors& round, std::string_view key) {
    const std::array<std::pair<std::string_view, double>, 5> numbers{
        {{"paths", static_cast<double>(round.paths)},
         {"seconds", round.seconds},
         {"median_error", round.median},
         {"worst_error", round.worst},
         {"fraction_at_target", round.fraction_at_target}}};
    return number_named(numbers, key, "round");
}

const char* text_by_key(const quasimc_result& result, std::string_view key) {
    if (key == "method") {
        return result.method.c_str();
    }
    if (key == "reason") {
        return result.result.chosen.reason.c_str();
    }
    if (key == "stop") {
        return result.stop.c_str();
    }
    throw Misuse(fmt::format("a result has no text '{}'", key));
}

const char* label_by_key(const Organ& organ, const std::string& key) {
    const std::string* label = find_label(organ.labels, key);
    return label == nullptr ? nullptr : label->c_str();
}

const DetectorResult& detector_of(const quasimc_result* result, const char* name) {
    const std::string wanted = text_of(name, "detector");
    for (const DetectorResult& detector : deref(result, "result").result.detectors) {
        if (detector.name == wanted) {
            return detector;
        }
    }
    throw Misuse(fmt::format("there is no detector '{}'", wanted));
}

const Result& sensors_of(const quasimc_result* result) {
    const auto& sensors = deref(result, "result").result.sensors;
    if (!sensors) {
        throw Misuse(
            "the result has no sensors: the scene has none, or the run was stopped before their "
            "light was computed");
    }
    return *sensors;
}

constexpr const char* kNoText = nullptr;

}  // namespace
}  // namespace quasimc::capi

using namespace quasimc::capi;  // NOLINT(google-build-using-namespace): this file defines its own

void quasimc_result_free(quasimc_result* result) {
    delete result;  // NOLINT: a handle
}

int64_t quasimc_result_organ_count(const quasimc_result* result) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(deref(result, "result").scene->organs().size()); });
}

int64_t quasimc_result_organ_id(const quasimc_result* result, int64_t organ) {
    return guarded_or<int64_t>(-1, [&] { return organ_at(result, organ).id; });
}

int64_t quasimc_result_find_organ(const quasimc_result* result, int64_t id) {
    return guarded_or<int64_t>(-1, [&] {
        const auto found = deref(result, "result").scene->names()->find_organ(id);
        return found ? static_cast<int64_t>(*found) : -1;
    });
}

const char* quasimc_result_organ_name(const quasimc_result* result, int64_t organ) {
    return guarded_or(kNoText, [&] { return organ_at(result, organ).name.c_str(); });
}

const char* quasimc_result_organ_label(
    const quasimc_result* result, int64_t organ, const char* key) {
    return guarded_or(
        kNoText, [&] { return label_by_key(organ_at(result, organ), text_of(key, "key")); });
}

double quasimc_result_organ_area(const quasimc_result* result, int64_t organ) {
    return guarded_or(-1.0, [&] { return organ_at(result, organ).area; });
}

int64_t quasimc_result_band_count(const quasimc_result* result) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(deref(result, "result").scene->bands().size()); });
}

const char* quasimc_result_band_name(const quasimc_result* result, int64_t band) {
    return guarded_or(kNoText, [&] {
        return item_at(deref(result, "result").scene->bands(), band, "band").name.c_str();
    });
}

const char* quasimc_result_band_unit(const quasimc_result* result, int64_t band) {
    return guarded_or(kNoText, [&] {
        return item_at(deref(result, "result").scene->bands(), band, "band").unit.c_str();
    });
}

int64_t quasimc_quantity_count(void) {
    return quasimc::kQuantities;
}

const char* quasimc_quantity_name(int64_t quantity) {
    return guarded_or(kNoText, [&] {
        // Names are literals, terminated by zero.
        return item_at(quasimc::quantity_table(), quantity, "quantity").name.data();
    });
}

int quasimc_result_get(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count) {
    return guarded([&] {
        const quasimc_result& all = deref(result, "result");
        const std::size_t rows = rows_of_organs(all.result).count;
        copy_rows(
            column_of(all, all.result, rows_of_organs, quantity, band), rows, statistic, values,
            count);
    });
}

int quasimc_result_get_organ(
    const quasimc_result* result,
    int64_t id,
    const char* quantity,
    const char* band,
    double* values) {
    return guarded([&] {
        const quasimc_result& all = deref(result, "result");
        const auto organ = all.scene->names()->find_organ(id);
        if (!organ) {
            throw Misuse(fmt::format("no organ has the id {}", id));
        }
        const Column column = column_of(all, all.result, rows_of_organs, quantity, band);
        copy_estimate(column.first[*organ * column.stride], values);
    });
}

int quasimc_result_get_total(
    const quasimc_result* result, const char* quantity, const char* band, double* values) {
    return guarded([&] {
        const quasimc_result& all = deref(result, "result");
        copy_estimate(*column_of(all, all.result, rows_of_groups, quantity, band).first, values);
    });
}

int quasimc_result_get_budget(
    const quasimc_result* result, const char* item, const char* band, double* values) {
    return guarded([&] {
        const quasimc_result& all = deref(result, "result");
        const quasimc::BandBudget& budget = all.result.budget[band_of(all, band)];
        copy_estimate(budget_item(budget, text_of(item, "item")), values);
    });
}

int64_t quasimc_result_group_count(const quasimc_result* result) {
    return guarded_or<int64_t>(-1, [&] {
        return static_cast<int64_t>(deref(result, "result").result.groups.groups.size());
    });
}

const char* quasimc_result_group_by(const quasimc_result* result, int64_t group) {
    return guarded_or(kNoText, [&] { return group_at(result, group).by.c_str(); });
}

const char* quasimc_result_group_value(const quasimc_result* result, int64_t group) {
    return guarded_or(kNoText, [&] { return group_at(result, group).value.c_str(); });
}

int quasimc_result_get_groups(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count) {
    return guarded([&] {
        const quasimc_result& all = deref(result, "result");
        const std::size_t rows = rows_of_groups(all.result).count;
        copy_rows(
            column_of(all, all.result, rows_of_groups, quantity, band), rows, statistic, values,
            count);
    });
}

int quasimc_result_get_number(const quasimc_result* result, const char* key, double* value) {
    return guarded([&] {
        deref(value, "value") = number_of(deref(result, "result").result, text_of(key, "key"));
    });
}

int64_t quasimc_result_round_count(const quasimc_result* result) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(deref(result, "result").result.rounds.size()); });
}

int quasimc_result_get_round(
    const quasimc_result* result, int64_t round, const char* key, double* value) {
    return guarded([&] {
        const auto& rounds = deref(result, "result").result.rounds;
        deref(value, "value") = number_of(item_at(rounds, round, "round"), text_of(key, "key"));
    });
}

const char* quasimc_result_text(const quasimc_result* result, const char* key) {
    return guarded_or(
        kNoText, [&] { return text_by_key(deref(result, "result"), text_of(key, "key")); });
}

int64_t quasimc_result_warning_count(const quasimc_result* result) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(deref(result, "result").warnings.size()); });
}

const char* quasimc_result_warning(const quasimc_result* result, int64_t warning) {
    return guarded_or(kNoText, [&] {
        return item_at(deref(result, "result").warnings, warning, "warning").c_str();
    });
}

int64_t quasimc_result_sensor_count(const quasimc_result* result) {
    return guarded_or<int64_t>(-1, [&] {
        const auto& sensors = deref(result, "result").result.sensors;
        return sensors ? static_cast<int64_t>(sensors->organs()) : 0;
    });
}

const char* quasimc_result_sensor_name(const quasimc_result* result, int64_t sensor) {
    return guarded_or(kNoText, [&] {
        return item_at(sensors_of(result).names->organs(), sensor, "sensor").name.c_str();
    });
}

int quasimc_result_get_sensors(
    const quasimc_result* result,
    const char* quantity,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count) {
    return guarded([&] {
        const quasimc::Result& sensors = sensors_of(result);
        copy_rows(
            column_of(*result, sensors, rows_of_organs, quantity, band), sensors.organs(),
            statistic, values, count);
    });
}

int64_t quasimc_result_detector_count(const quasimc_result* result) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(deref(result, "result").result.detectors.size()); });
}

const char* quasimc_result_detector_name(const quasimc_result* result, int64_t detector) {
    return guarded_or(kNoText, [&] {
        return item_at(deref(result, "result").result.detectors, detector, "detector").name.c_str();
    });
}

int64_t quasimc_result_detector_bin_count(const quasimc_result* result, const char* detector) {
    return guarded_or<int64_t>(
        -1, [&] { return static_cast<int64_t>(detector_of(result, detector).bins.size()); });
}

const char* quasimc_result_detector_bin(
    const quasimc_result* result, const char* detector, int64_t bin) {
    return guarded_or(
        kNoText, [&] { return item_at(detector_of(result, detector).bins, bin, "bin").c_str(); });
}

int quasimc_result_get_detector(
    const quasimc_result* result,
    const char* detector,
    const char* band,
    const char* statistic,
    double* values,
    int64_t count) {
    return guarded([&] {
        const quasimc::DetectorResult& seen = detector_of(result, detector);
        const Column column{seen.values.data() + band_of(*result, band), result->result.bands};
        copy_rows(column, seen.bins.size(), statistic, values, count);
    });
}
