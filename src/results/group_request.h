#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "results/where_expression.h"

namespace quasimc {

/// An item of RunSpec::groups: "plant+kind", "plant where height > 1.2",
/// "top: plant where height > 1.2", "top: where height > 1.2".
struct GroupRequest {
    std::string by;                 ///< the column `by` of its groups: the name, or the text
    std::vector<std::string> keys;  ///< whose values are joined; none: one group
    std::optional<WhereExpression> where = {};
};

/// Reads an item. A text that is itself a known key is that key.
/// @throws InputError  if the condition has an error; its location is "where"
[[nodiscard]] GroupRequest parse_group(
    std::string_view text, std::span<const std::string_view> known);

/// The text of an item: the inverse of parse_group(). @param name, where  "": none
[[nodiscard]] std::string group_text(
    std::string_view name, std::string_view by, std::string_view where);

}  // namespace quasimc
