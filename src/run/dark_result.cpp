#include <limits>

#include "quasimc/run.h"
#include "results/evaluate.h"
#include "results/flows.h"
#include "results/groups.h"

namespace quasimc {

Result dark_result(const Scene& scene, const RunSpec& spec) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    Result dark;
    dark.names = scene.names();
    dark.bands = scene.bands().size();
    dark.ratios = spec.ratios.size();
    dark.values.resize(scene.organs().size() * kQuantities * dark.bands);
    dark.ratio_values.resize(scene.organs().size() * dark.ratios, {kNan, kNan, kNan, kNan});
    dark.groups = dark_groups(scene, group_spec(spec), dark.ratios);
    dark.budget.resize(dark.bands);
    dark.canopy = dark_canopy(scene);
    dark.detectors = dark_detectors(scene);
    dark.replicates = spec.replicates;
    dark.chosen.reason = "it is dark, nothing was traced";
    return dark;
}

}  // namespace quasimc
