#pragma once

#include <span>
#include <string>
#include <vector>

#include "quasimc/error.h"
#include "quasimc/sums.h"
#include "scene/scene.h"

namespace quasimc {

/// A number of each organ, with its error.
struct OrganColumn {
    std::string name;              ///< "absorbed_flux_PAR"
    std::string unit;              ///< "W m-2"; "" for none
    std::vector<Estimate> values;  ///< in the order of the scene's organs; NaN where it is unknown
};

/// Writes a table in CSV: a line for each organ of a scene, with its labels, its area and numbers,
/// in columns as those of a run's table.
/// @param comments  lines about the scene, each "# ...\n"
void write_organ_table(
    const Scene& scene,
    std::span<const OrganColumn> columns,
    const std::string& comments,
    const TextSink& sink);

}  // namespace quasimc
