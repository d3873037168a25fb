#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runfile/run_file.h"

namespace quasimc {

/// A run and its result in the form that the page in the browser takes
/// (docs/develop/decisions/viewer-server.md).
struct WindowData {
    std::string json;   ///< names, units, times, and what the result says beside its organs
    std::string shape;  ///< window_shape()
    /// Per time and kind of number: means, standard errors, low and high ends of all organs, single
    /// precision.
    std::vector<std::string> values;

    [[nodiscard]] std::size_t bytes() const;
};

/// @param result_text  that of the JSON result
/// @param path         of it, for messages
/// @throws InputError  if there is no light of organs in it
[[nodiscard]] WindowData make_window_data(
    const RunFile& run, const std::string& result_text, const std::string& path);

}  // namespace quasimc
