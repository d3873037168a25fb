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

/// The position of a list of organs or groups in a JSON result.
struct RowsPosition {
    std::size_t point = 0;   ///< of a sweep
    std::string part = {};   ///< "time_steps", "days" or "total"; empty without [time]
    std::size_t index = 0;   ///< of the moment or the day
    std::string label = {};  ///< its time or date, which stands before the list
};

/// Which numbers of a JSON result are wanted.
struct RowsQuery {
    std::string list = "organs";  ///< or "groups"
    /// What leads to each kind of estimates: a quantity and a band, "ratios" and a ratio,
    /// "sunlit_fraction".
    std::vector<std::vector<std::string>> columns = {};
    std::optional<std::string> part = {};   ///< RowsPosition::part; any by default
    std::string label = {};                 ///< how RowsPosition::label begins
    std::optional<std::size_t> point = {};  ///< any by default

    /// What is kept beside the lists: the members of the outermost object but for points, times and
    /// sums; or the names of times alone; or everything but organs.
    enum class Rest { head, labels, all } rest = Rest::labels;
};

/// The estimates of each kind, one for each organ or group; NaN what the result does not know.
/// Those of a kind may be fewer than there are rows: the last ones have none.
using RowColumns = std::vector<std::vector<Estimate>>;

struct PlacedRows {
    RowsPosition position;
    RowColumns columns;
};

/// Goes once through the text of a JSON result.
/// @param take  is told of each list that is wanted and has rows, in the order of the file
/// @param path  for messages
/// @returns  the rest, as the query wants it
/// @throws InputError  if it is not JSON
Node read_rows(
    std::string_view text,
    const std::string& path,
    const RowsQuery& query,
    const std::function<void(PlacedRows)>& take);

/// The same, all at once.
[[nodiscard]] std::vector<PlacedRows> read_rows(
    std::string_view text, const std::string& path, const RowsQuery& query);

/// The rest of a result, all of it; of a sweep as if the point were alone.
/// @throws InputError  if it is no object, or lacks the point
[[nodiscard]] Node only_point(
    Node document, std::optional<std::size_t> point, const std::string& path);

/// A text in a table; "" if there is none of the name.
[[nodiscard]] std::string text_in(const Node& table, std::string_view key);

}  // namespace quasimc
