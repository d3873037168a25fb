#pragma once

#include <string>

#include "organ_chart.h"
#include "show_values.h"
#include "view/chart.h"

/// The charts that `show --chart` draws: light against height, how often it is how much, its course
/// in time, organ by organ, and how errors fell round by round.
enum class ChartKind { profile, histogram, course, organs, convergence };

/// "profile", "histogram", "course", "organs" or "convergence".
[[nodiscard]] ChartKind chart_kind(const std::string& name);

/// Which chart, and of organs what.
struct ChartChoice {
    ChartKind kind = ChartKind::profile;
    OrganAspect aspect = OrganAspect::value;
    std::string with;  ///< of organs: another result beside it
    std::string note;  ///< words instead of those under the title
};

/// @throws quasimc::InputError  if the result has not what it shows
[[nodiscard]] quasimc::Chart make_chart(
    const ChartChoice& kind,
    const ShownRun& shown,
    const std::string& path,
    const ValueChoice& choice);
