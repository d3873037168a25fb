#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "quasimc/error.h"
#include "quasimc/source.h"

namespace quasimc {

/// Where else than in the text of a time its offset to UTC may be stated.
enum class OffsetKey { utc_offset_hours, none };

/// Reads a time as ISO 8601 writes it: "2024-06-21T12:30:15+02:00", with a blank for the T, without
/// seconds, with Z, without an offset. A date alone is its midnight. "24:00" is the midnight after.
/// @param utc_offset_hours  where the text has no offset; nothing: it must have one
/// @param where  for messages. Nothing after a fault.
/// @param key  what is advised where the text has none
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
