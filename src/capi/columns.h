#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/function_ref.h"
#include "capi/guard.h"
#include "capi/handles.h"

// Numbers of results by their names.

namespace quasimc::capi {

/// An item of a list, counted from 0. @throws Misuse  if there is none
template <typename List>
const auto& item_at(const List& list, std::int64_t index, const char* what) {
    if (index < 0 || index >= static_cast<std::int64_t>(list.size())) {
        throw Misuse(fmt::format("there is no {} {}: there are {}", what, index, list.size()));
    }
    return list[static_cast<std::size_t>(index)];
}

/// Returned where a text does not exist.
inline constexpr const char* kNoText = nullptr;

/// The index of a band. @throws Misuse  if there is none
[[nodiscard]] std::size_t band_of(const quasimc_result& result, const char* name);

/// Estimates of organs or of groups, one row each.
struct Rows {
    const std::vector<Estimate>& values;
    const std::vector<Estimate>& sunlit;
    const std::vector<Estimate>& ratios;
    const SunShadeLight& parts;
    std::size_t count;
};
[[nodiscard]] Rows rows_of_organs(const Result& result);
[[nodiscard]] Rows rows_of_groups(const Result& result);

/// One number of every row: offset of the first, and stride.
struct Column {
    const Estimate* first;
    std::size_t stride;

    const Estimate& operator()(std::size_t row) const { return first[row * stride]; }
};

/// A quantity of every row, with the names of quasimc_result_get().
/// @param light  the light of a result: that on organs, or on sensors
/// @param rows_of  the rows of a Result
/// @throws Misuse  if there is no such quantity or band
[[nodiscard]] Column column_of(
    const quasimc_result& result,
    const Result& light,
    Rows (*rows_of)(const Result&),
    const char* quantity,
    const char* band);

/// @throws Misuse  if an array has not room for a number of every row
void check_count(std::int64_t count, std::size_t rows);

/// Copies a statistic of every row. @param estimate_of  a row: a Column
/// @param count  capacity of `values`
/// @throws Misuse  if that is not the number of rows
void copy_rows(
    FunctionRef<Estimate(std::size_t)> estimate_of,
    std::size_t rows,
    const char* statistic,
    double* values,
    std::int64_t count);

/// Copies mean, standard error and the ends of the interval.
void copy_estimate(const Estimate& estimate, double* values);

/// The value of a label, or null.
[[nodiscard]] const char* label_by_key(const Organ& organ, const std::string& key);

}  // namespace quasimc::capi
