#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/source.h"

namespace quasimc {

/// The origin of sources that fit no entry of RunSpec::origins.
inline constexpr std::string_view kOtherOrigin = "other";

/// Whether a text is that of a pattern, in which `*` means any characters.
[[nodiscard]] bool fits_pattern(std::string_view text, std::string_view pattern);

/// The origins of light, and the origin of each source.
struct SourceOrigins {
    std::vector<std::string> names;  ///< empty: light is not kept apart
    std::vector<std::size_t> of_source;

    /// Number of parts that light is kept in: 1 without origins.
    [[nodiscard]] std::size_t count() const { return names.empty() ? 1 : names.size(); }
};

/// The origins of sources. A source belongs to the first entry that fits it: "sun" (suns and
/// parallel light), "sky", "lamps", or a pattern of its name, in which `*` means any
/// characters. Those that fit none are of kOtherOrigin, which is listed last, if there are any.
/// @param entries  as RunSpec::origins; empty: light is not kept apart
[[nodiscard]] SourceOrigins source_origins(
    const Sources& sources, std::span<const std::string> entries);

/// The entries, and kOtherOrigin if some source fits none of them: so each time of a series has the
/// same origins.
[[nodiscard]] std::vector<std::string> complete_origins(
    const Sources& sources, std::span<const std::string> entries);

/// The sources of each origin, in the order of SourceOrigins::names.
[[nodiscard]] std::vector<Sources> sources_by_origin(
    const Sources& sources, std::span<const std::string> entries);

/// Adds a fault for entries that are empty or given twice, for patterns that fit no source, and for
/// a kind that is also the name of a source of another kind.
/// @param sources  of all times
void check_origins(const Sources& sources, std::span<const std::string> entries, Faults& faults);

}  // namespace quasimc
