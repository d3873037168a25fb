#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runfile/run_file.h"

namespace quasimc {

/// A run and its result in the form that the page in the browser takes
/// (docs/develop/decisions/viewer-server.md).
struct WindowData {
    std::string json;   ///< names, units, times, and the result without its organs
    std::string shape;  ///< window_shape()
    /// For each time and kind of number: means, standard errors, low and high ends of all organs,
    /// single precision.
    std::vector<std::string> values;
    /// [time][column]: the index of the values, -1 where there are none.
    std::vector<std::vector<int>> value_index = {};

    /// Mean, standard error, low and high end of an organ in a column at every time, single
    /// precision; zeros where there are no values. Empty for unknown columns and organs.
    [[nodiscard]] std::string course(std::size_t column, std::size_t organ) const;
    [[nodiscard]] std::size_t bytes() const;
};

/// A result, as it was read.
struct ReadResult {
    const RunFile& run;
    const std::string& text;  ///< JSON
    const std::string& path;  ///< for messages
};

/// @param minus  a result that is subtracted in the mode "difference" of the page; null: none.
///     Times are matched by their labels, organs by their ids.
/// @throws InputError  if a result has no light of organs, or the results have no time and no organ
///     in common
[[nodiscard]] WindowData make_window_data(
    const ReadResult& result, const ReadResult* minus = nullptr);
/// The data of all points of a sweep, or of the only run, for a page that has all of them. The text
/// is read once.
/// @param runs  of all points
/// @throws InputError  if a point has no light of organs
[[nodiscard]] std::vector<WindowData> make_window_data(
    const std::vector<RunFile>& runs, const std::string& text, const std::string& path);

}  // namespace quasimc
