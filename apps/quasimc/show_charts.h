#pragma once

#include <string>

#include "show_values.h"
#include "view/chart.h"

/// The charts that `show --chart` draws: light against height, how often it is how much, and its
/// course in time.
enum class ChartKind { profile, histogram, course };

/// "profile", "histogram" or "course".
[[nodiscard]] ChartKind chart_kind(const std::string& name);

/// @throws quasimc::InputError  if the result has not what it shows
[[nodiscard]] quasimc::Chart make_chart(
    ChartKind kind, const ShownRun& shown, const std::string& path, const ValueChoice& choice);
