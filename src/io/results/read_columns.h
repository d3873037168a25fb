#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace quasimc {

/// Numbers of one kind of all organs, in single precision; NaN what the result does not know.
/// Empty: it has none of the kind.
struct OrganColumn {
    std::vector<float> mean, standard_error, low, high;
};

/// What a result says of its organs at one time.
struct ResultTime {
    std::string part = {};   ///< "moments", "days" or "total"; empty without [time]
    std::size_t index = 0;   ///< place in the list of that name
    std::string label = {};  ///< time or date
    std::vector<OrganColumn> columns;
};

/// A JSON result, its organs as columns.
struct ResultColumns {
    std::string head;  ///< the JSON of all but the organs; of a sweep as if the point were alone
    std::vector<ResultTime> times;
};

/// Reads a JSON result once, whatever number of columns is asked for.
/// @param columns  what leads to the estimates: a quantity and a band, "ratios" and a ratio,
///                 "sunlit_fraction"
/// @param organs   how many the scene has: the length of columns
/// @param point    of a sweep
/// @param path     for messages
/// @throws InputError  if it is not JSON, or lacks the point
[[nodiscard]] ResultColumns read_columns(
    const std::string& text,
    const std::string& path,
    const std::vector<std::vector<std::string>>& columns,
    std::size_t organs,
    std::optional<std::size_t> point);

}  // namespace quasimc
