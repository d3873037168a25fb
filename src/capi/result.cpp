#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "capi/columns.h"
#include "capi/guard.h"
#include "capi/handles.h"

namespace quasimc::capi {
namespace {

const Organ& organ_at(const quasimc_result* result, std::int64_t organ) {
    return item_at(deref(result, "result").scene->organs(), organ, "organ");
}

const OrganGroup& group_at(const quasimc_result* result, std::int64_t group) {
    return item_at(deref(result, "result").result.groups.groups, group, "group");
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

const DetectorResult& detector_of(const quasimc_result* result, const char* name) {
    const std::string wanted = text_of(name, "detector");
    for (const DetectorResult& detector : deref(result, "result").result.detectors) {
        if (detector.name == wanted) {
            return detector;
        }
    }
    throw Misuse(fmt::format("there is no detector '{}'", wanted));
}

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
