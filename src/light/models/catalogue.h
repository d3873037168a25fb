#pragma once

#include <span>
#include <string_view>

namespace quasimc {

/// One row of the table of kinds of sources.
struct SourceEntry {
    std::string_view name;     ///< as in `type = "..."`
    std::string_view words;    ///< name in the header of a result: "uniform sky"
    std::string_view summary;  ///< one line for the manual
};

/// All kinds, in the order of the manual.
[[nodiscard]] std::span<const SourceEntry> source_catalogue();
/// The row with a name, or null.
[[nodiscard]] const SourceEntry* find_source(std::string_view name);

}  // namespace quasimc
