#pragma once

// Values in the nodes of a JSON result.

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "quasimc/sums.h"
#include "text/document.h"

namespace quasimc {

/// A number in a table; NaN if there is none of the name.
[[nodiscard]] double number_in(const Node& table, std::string_view key);

/// A whole number in a table, 0 or more; 0 if there is none of the name.
[[nodiscard]] std::uint64_t count_in(const Node& table, std::string_view key);

/// A flag in a table; false if there is none of the name.
[[nodiscard]] bool flag_in(const Node& table, std::string_view key);

/// An estimate in a table; kUnknownEstimate if there is none of the name, or no table.
[[nodiscard]] Estimate estimate_in(const Node* table, std::string_view key);

/// An item of a list; null if it is too short, or no list.
[[nodiscard]] const Node* item_at(const Node* list, std::size_t index);

}  // namespace quasimc
