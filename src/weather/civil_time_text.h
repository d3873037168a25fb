#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "quasimc/error.h"
#include "quasimc/source.h"

namespace quasimc {

/// Key that may give the offset to UTC of times without one.
enum class OffsetKey { utc_offset_hours, none };

/// Reads a time in ISO 8601: "2024-06-21T12:30:15+02:00", optionally with a blank for the T,
/// without seconds, with Z, or without an offset. A date alone is its first midnight, "24:00" its
/// last one.
/// @param utc_offset_hours  for texts without an offset; empty: the text must have one
/// @param where  for messages
/// @param key  advice for a missing offset. @returns empty after a fault
[[nodiscard]] std::optional<CivilTime> parse_civil_time(
    std::string_view text,
    std::optional<double> utc_offset_hours,
    std::string_view where,
    Faults& faults,
    OffsetKey key = OffsetKey::utc_offset_hours);

/// "2024-06-21T12:30+02:00"; seconds if there are any.
[[nodiscard]] std::string civil_time_text(const CivilTime& time);
/// "2024-06-21"
[[nodiscard]] std::string date_text(const CivilTime& time);

}  // namespace quasimc
