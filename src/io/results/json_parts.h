#pragma once

// The parts that results in JSON are made of, as text. Included by the write_*json.cpp only.

#include <string>
#include <string_view>
#include <vector>

#include "io/runfile/run_file.h"
#include "results/result.h"
#include "run/series.h"

namespace quasimc {

// Members of the outermost object, each ended by a comma.
/// What is known before anything is traced.
[[nodiscard]] std::string json_head(const RunFile& run);
/// What is known of a result besides its organs.
[[nodiscard]] std::string json_result_head(const RunFile& run, const Result& result);
[[nodiscard]] std::string json_warnings(const RunFile& run);

// Values.
[[nodiscard]] std::string json_quoted(std::string_view text);
[[nodiscard]] std::string json_method(const RunFile& run, const Result& result);
/// null without one.
[[nodiscard]] std::string json_audit(const RunFile& run, const Result& result);
[[nodiscard]] std::string json_done(const Result& result);
[[nodiscard]] std::string json_energy(const RunFile& run, const Result& result);
/// A number; null if it is not finite.
void append_json(std::string& out, double value);
void append_json(std::string& out, const Estimate& e);

/// The names of bands and ratios, quoted.
struct JsonNames {
    std::vector<std::string> bands, ratios;
};
[[nodiscard]] JsonNames json_names(const RunFile& run);
/// An organ on one line; written by hand since there may be millions.
[[nodiscard]] std::string json_organ(
    const Organ& organ, const Result& result, std::size_t index, const JsonNames& names);
/// The same of a sum, whose values are in the units of the sum.
[[nodiscard]] std::string json_organ_sum(
    const Organ& organ, const SeriesSum& sum, std::size_t index, const JsonNames& names);

}  // namespace quasimc
