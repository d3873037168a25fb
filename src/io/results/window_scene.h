#pragma once

#include <string>
#include <vector>

#include "io/results/json.h"
#include "quasimc/result.h"
#include "scene/scene.h"

namespace quasimc {

/// A kind of number that the page in the browser shows of every organ.
struct WindowColumn {
    /// Where it stands in a result: a quantity and a band, "ratios" and a ratio, "sunlit_fraction".
    std::vector<std::string> path;
    std::string quantity, name, band, unit, sum_unit;
};

/// Light absorbed per area first, the sunlit fraction and ratios last.
[[nodiscard]] std::vector<WindowColumn> window_columns(
    const std::vector<Band>& bands,
    const std::string& length_unit,
    const std::vector<std::string>& ratios);

/// Members of the outermost object: program, unit, axes, place, organs and columns
/// (docs/develop/decisions/window-server.md).
[[nodiscard]] Json json_window_scene(const Scene& scene, const std::vector<WindowColumn>& columns);

}  // namespace quasimc
