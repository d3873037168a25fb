#pragma once

#include <string>
#include <vector>

#include "show_values.h"
#include "view/chart.h"

/// What the chart of organs shows of each.
enum class OrganAspect { value, variance };

/// A result, and the file that it was read from, which gives it its name.
struct NamedRun {
    const ShownRun* shown = nullptr;
    std::string path;
};

/// The light of each organ, or its variance between replicates, against its number from the top of
/// the canopy; of each result with the curve A exp(-rate n) of the least squares.
/// @param runs  of scenes with as many organs
/// @throws quasimc::InputError
[[nodiscard]] quasimc::Chart organ_chart(
    const std::vector<NamedRun>& runs, const ValueChoice& choice, OrganAspect aspect);

/// Height of the middle of an organ's surface, over the axes' origin; NaN of one without area.
[[nodiscard]] double height_of(const quasimc::Scene& scene, const quasimc::Organ& organ);
