#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/sums.h"
#include "text/document.h"

namespace quasimc {

/// The position of a list of organs, groups or sensors in a JSON result.
struct RowsPosition {
    std::size_t point = 0;   ///< point of a sweep
    std::string part = {};   ///< "time_steps", "days" or "total"; empty without [time]
    std::size_t index = 0;   ///< index of the time step or the day
    std::string label = {};  ///< its time or date, which precedes the list

    friend bool operator==(const RowsPosition&, const RowsPosition&) = default;
};

/// The numbers of a JSON result to read.
struct RowsQuery {
    std::vector<std::string> lists = {"organs"};  ///< also "groups", "sensors"
    /// Path of keys to each kind of estimate: a quantity and a band, "ratios" and a ratio,
    /// "sunlit_fraction".
    std::vector<std::vector<std::string>> columns = {};
    std::optional<std::string> part = {};   ///< RowsPosition::part; any by default
    std::string label = {};                 ///< how RowsPosition::label begins
    std::optional<std::size_t> point = {};  ///< any by default

    /// The part of the result that is kept beside the lists: the members of the outermost object
    /// but for points, times and sums; or the names of times alone; or everything but organs and
    /// sensors.
    enum class Rest { head, labels, all } rest = Rest::labels;
};

/// The estimates of each kind, one for each organ, group or sensor; NaN where the result has none.
/// A kind may have fewer estimates than there are rows: the last rows have none.
using RowColumns = std::vector<std::vector<Estimate>>;

struct PlacedRows {
    RowsPosition position;
    std::string list;  ///< one of RowsQuery::lists
    RowColumns columns;
};

/// Goes once through the text of a JSON result.
/// @param take  called with each requested list that has rows, in the order of the file
/// @param path  for messages
/// @returns  the part chosen by RowsQuery::rest
/// @throws InputError  if it is not JSON
Node read_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const std::function<void(PlacedRows)>& take);

/// All requested lists of a JSON result.
[[nodiscard]] std::vector<PlacedRows> read_rows(
    std::string_view text, const std::string& path, const RowsQuery& query);

/// The numbers of the lists at a position; empty where it has none.
struct LightRows {
    RowsPosition position;
    RowColumns organs, groups, sensors;
};
/// Like read_rows(), of the lists of a position together.
Node read_light_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const std::function<void(LightRows)>& take);

/// A result without its rows; for a point of a sweep, as if it were the only one.
/// @throws InputError  if it is no object, or lacks the point
[[nodiscard]] Node only_point(
    const Node& document, std::optional<std::size_t> point, const std::string& path);

/// A text in a table; "" if there is none of the name.
[[nodiscard]] std::string text_in(const Node& table, std::string_view key);

}  // namespace quasimc
