#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/sums.h"

namespace quasimc {

/// Which numbers of a JSON result are wanted.
struct EstimateQuery {
    std::string list = "organs";            ///< or "groups"
    std::vector<std::string> names = {};    ///< what leads to the estimate: a quantity and a band,
                                            ///< "ratios" and a ratio, "sunlit_fraction"
    std::string part = {};                  ///< of a run with [time]: "moments", "days" or "total"
    std::string label = {};                 ///< of moments and days: how their time or date begins
    std::optional<std::size_t> point = {};  ///< of a sweep
};

/// The estimates of one time, one for each organ or group; NaN what the result does not know.
struct TimedEstimates {
    std::string label = {};  ///< time or date; empty without [time]
    std::vector<Estimate> values;
};

/// What leads to an estimate, as EstimateQuery::names.
using EstimateNames = std::vector<std::string>;

/// Reads several kinds of estimates in one pass over the text of a JSON result.
/// @param query    where they stand; its names are not looked at
/// @param columns  what leads to each kind
/// @returns  of each kind what read_estimates() returns
[[nodiscard]] std::vector<std::vector<TimedEstimates>> read_estimate_columns(
    std::string_view text,
    const std::string& path,
    const EstimateQuery& query,
    const std::vector<EstimateNames>& columns);

/// Reads estimates from the text of a JSON result, without keeping more of it in memory.
/// @returns  in the order of the file; those times that have none of that name are left out
/// @throws InputError  if it is not JSON. @param path  for messages
[[nodiscard]] std::vector<TimedEstimates> read_estimates(
    std::string_view text, const std::string& path, const EstimateQuery& query);

}  // namespace quasimc
