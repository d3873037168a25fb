#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "width_scenes.h"

namespace quasimc::bench {

/// Kinds of quantities, in the order of the table.
enum class WidthKind {
    leaves,
    dim_leaves,
    sides,
    stems,
    ground,
    groups,
    total,
    ratios,
    sunlit,
    day
};

[[nodiscard]] const char* name_of(WidthKind kind);

/// An estimated quantity.
struct WidthValue {
    WidthKind kind = WidthKind::leaves;
    std::size_t band = 0;
    Estimate estimate = {};
};

/// The quantities of a run, in an order that is the same for all runs of a scene.
struct WidthValues {
    std::vector<WidthValue> values;
    double cpu_seconds = 0;
    std::string method;
};

/// Runs a scene, or the hours of its day.
[[nodiscard]] WidthValues run_width(
    Simulator& simulator, const WidthScene& scene, const RunSpec& spec);

/// The values of a long, unbiased run. They are read from a file of the folder or, if there is none
/// for this scene and these paths, computed and written there.
/// @param folder  empty: none
/// @param paths  per replicate
[[nodiscard]] std::vector<WidthValue> truth_of(
    const WidthScene& scene, const std::string& folder, std::uint64_t paths);

}  // namespace quasimc::bench
