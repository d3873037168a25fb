#pragma once

// The keys of [sweep]: valid ones, and their search in a document.

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runfile/sweep.h"
#include "text/document.h"
#include "text/table_reader.h"

namespace quasimc {

/// Sections whose values can be swept, and sections whose values change triangles.
inline constexpr std::array<std::string_view, 6> kSweptSections{"run",  "source", "material",
                                                                "site", "time",   "control"};
inline constexpr std::array<std::string_view, 4> kSweptGeometry{
    "organ", "geometry", "ground", "cell"};

template <typename Names>
bool is_among(std::string_view name, const Names& names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

[[nodiscard]] std::string_view first_part(std::string_view path);

/// The rest of a path "name.rest"; empty if it does not begin with `name`.
[[nodiscard]] std::optional<std::string_view> rest_after(
    std::string_view path, std::string_view name);

/// Names of a list's tables, for suggestions.
[[nodiscard]] std::vector<std::string> names_of_items(const Node::List& list);

/// Reports a key that does not exist, or that is common to all points.
[[nodiscard]] bool is_refused(const Node& document, const SweptKey& key, Reporter& reporter);

/// Sets the value of a key in a document; reports a missing key.
void set_swept_value(Node& document, const SweptKey& key, const Node& value, Reporter& reporter);

}  // namespace quasimc
